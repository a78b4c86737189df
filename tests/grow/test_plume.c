// Plumes: barbs at their spacing and angle along a rib, two plumes that meet without growing into
// each other.
#include "testing.h"

#include "base/random.h"
#include "grow/plume/plume.h"

#include <math.h>
#include <stdlib.h>

static void on_plane(const void *surface, Vec3 *p, Vec3 *normal)
{
    (void)surface;
    p->z = 0.0f;
    *normal = vec3(0, 0, 1);
}

// One attractor a square millimetre, with a little noise.
static PointSet *fill(int width, int height)
{
    PointSet *points = points_new(NULL);
    points->dimension = 2;
    points->measure = 1e-6 * width * height;
    for (int i = 0; i < width * height; i++) {
        uint64_t key = random_key(5, (uint64_t)i);
        float x = (float)(i % width) + random_range(random_key(key, 0), 0.1f, 0.9f);
        float y = (float)(i / width) + random_range(random_key(key, 1), 0.1f, 0.9f);
        Vec3 p = vec3(0.001f * x, 0.001f * (y - 0.5f * (float)height), 0);
        assert_true(points_add(points, p, vec3(0, 0, 1), key, NULL));
    }
    return points;
}

static PlumeParams barbs_alone(void)
{
    return (PlumeParams){.step = 0.0008f,
                         .kill = 0.00075f,
                         .influence = 0.0035f,
                         .order = {{.spacing = 0.004f, .angle = 50, .length = 0.03f, .period = 1}},
                         .orders = 1,
                         .field_weight = 1e6f,
                         .project = on_plane,
                         .seed = 3};
}

static bool is_foot(const OutTree *tree, int64_t i)
{
    int32_t parent = tree->parent[i];
    return parent >= 0 && tree->id[i] != out_tree_child_id(tree->id[parent], 0);
}

// A straight rib of 0.2 m bears a barb every 4 mm on each side, at 50 degrees, that go straight on.
static void barbs_leave_at_their_spacing_and_angle(void **state)
{
    (void)state;
    PointSet *points = fill(200, 100);
    PlumeStart start = {.position = vec3(0, 0, 0), .heading = vec3(1, 0, 0)};
    PlumeParams params = barbs_alone();
    Run run = run_default();
    OutTree *tree = out_tree_new(NULL);
    assert_true(plume_grow(tree, &start, 1, points, &params, &run, NULL));
    assert_true(out_tree_check(tree, NULL));
    int feet[2] = {0};
    double reach = 0.0, aside = 0.0;
    for (int64_t i = 0; i < tree->count; i++) {
        reach = fmax(reach, (double)tree->position[i].x);
        aside = fmax(aside, fabs((double)tree->position[i].y));
        if (is_foot(tree, i)) {
            Vec3 d = vec3_sub(tree->position[i], tree->position[tree->parent[i]]);
            assert_float_equal(atan2f(fabsf(d.y), d.x), 50.0f * RADIANS_PER_DEGREE, 1e-3f);
            feet[d.y > 0.0f]++;
        }
    }
    assert_true(reach > 0.19);
    assert_true(abs(feet[0] - 50) <= 5 && abs(feet[1] - 50) <= 5);
    double longest = 0.03 * sin(50.0 * 3.14159265 / 180);
    assert_true(aside <= longest + 1e-5 && aside > 0.9 * longest);
    out_tree_free(tree);
    points_free(points);
}

// Two ribs side by side: no barb comes nearer to the other's rib than to where its own barbs end.
static void plumes_end_where_they_meet(void **state)
{
    (void)state;
    PointSet *points = fill(160, 60);
    PlumeStart start[2] = {{.position = vec3(0, -0.01f, 0), .heading = vec3(1, 0, 0)},
                           {.position = vec3(0, 0.01f, 0), .heading = vec3(1, 0, 0), .number = 1}};
    PlumeParams params = barbs_alone();
    Run run = run_default();
    OutTree *tree = out_tree_new(NULL);
    assert_true(plume_grow(tree, start, 2, points, &params, &run, NULL));
    int64_t count[2] = {0}, across = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        int colony = tree->colony[i];
        float beyond = colony == 0 ? tree->position[i].y : -tree->position[i].y;
        count[colony]++;
        across += beyond > 0.004f; // a barb's spacing
    }
    assert_true(count[0] > 2000 && count[1] > 2000);
    assert_true(across < 0.01 * (double)tree->count);
    out_tree_free(tree);
    points_free(points);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(barbs_leave_at_their_spacing_and_angle),
        cmocka_unit_test(plumes_end_where_they_meet),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
