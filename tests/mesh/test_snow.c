// Settled snow: as deep as it should be on a level branch, none on steep or bare ones, closed
// cushions that face outward, less of it below what catches it.
#include "base/exact_math.h"
#include "mesh/snow/snow.h"
#include "objects/common/snow_fall.h"
#include "testing.h"

#include <math.h>
#include <stdlib.h>

enum { POINTS = 41 };

#define LENGTH 1.2f
#define RADIUS 0.03f
#define DEPTH 0.05f

static float everywhere(const void *user, Vec3 p)
{
    (void)p;
    return user ? *(const float *)user : 1.0f;
}

static const SnowReach OPEN = {everywhere, NULL};

// A straight branch from the origin.
static CurveSet *branch(Vec3 direction, float radius)
{
    CurveSet *curves = curves_new(POINTS, 1, NULL);
    assert_non_null(curves);
    for (int i = 0; i < POINTS; i++) {
        curves->position[i] = vec3_scale(direction, LENGTH * (float)i / (POINTS - 1));
        curves->radius[i] = radius;
        curves->birth[i] = curves->along[i] = 0.0f;
    }
    curves->id[0] = 7;
    curves->first[0] = 0;
    curves->first[1] = POINTS;
    return curves;
}

static Mesh *snow_on(Vec3 direction, float radius, SnowParams params, const bool *bare)
{
    Run run = run_default();
    CurveSet *curves = branch(direction, radius);
    Mesh *mesh = snow_on_curves(curves, bare, &params, &OPEN, &run, NULL);
    assert_non_null(mesh);
    curves_free(curves);
    return mesh;
}

static double mean_top(const Mesh *mesh)
{
    double sum = 0.0;
    int count = 0;
    for (int64_t i = 3; i < mesh->vertex_count; i += 8) { // beside the top of each ring
        sum += (double)mesh->position[i].y;
        count++;
    }
    return sum / count;
}

// Lumps have a mean of nearly 0, so the mean depth is that of the formula.
static void a_level_branch_bears_its_depth(void **state)
{
    (void)state;
    SnowParams params = {.depth = DEPTH, .steepest = 55.0f};
    Mesh *mesh = snow_on(vec3(1, 0, 0), RADIUS, params, NULL);
    double width = 2.0 * (double)RADIUS + 0.003;
    double depth = (double)DEPTH * (1.0 - exp(-1.7 * width / (double)DEPTH));
    double low = 0.2 * (double)RADIUS, top = (double)RADIUS + depth;
    assert_true(fabs(mean_top(mesh) - (low + 0.97 * (top - low))) < 0.15 * depth);
    Aabb box = mesh_bounds(mesh);
    assert_true(fabsf(box.low.z + box.high.z) < 1e-5f); // as far to one side as to the other
    mesh_free(mesh);
}

static void thin_twigs_bear_less(void **state)
{
    (void)state;
    SnowParams params = {.depth = DEPTH, .steepest = 55.0f};
    double before = 0.0;
    for (float radius = 0.002f; radius < 0.03f; radius *= 3.0f) {
        Mesh *mesh = snow_on(vec3(0, 0, 1), radius, params, NULL);
        double depth = mean_top(mesh) - (double)radius;
        assert_true(depth > before && depth < 1.4 * (double)DEPTH);
        before = depth;
        mesh_free(mesh);
    }
}

static void steep_and_bare_branches_bear_none(void **state)
{
    (void)state;
    SnowParams params = {.depth = DEPTH, .steepest = 50.0f};
    const bool bare = true;
    for (int degrees = 0; degrees <= 90; degrees += 10) {
        float sine, cosine;
        exact_sincos((float)degrees * RADIANS_PER_DEGREE, &sine, &cosine);
        Vec3 direction = vec3(cosine, sine, 0);
        Mesh *mesh = snow_on(direction, RADIUS, params, NULL);
        assert_int_equal(mesh->face_count > 0, degrees < 50);
        mesh_free(mesh);
        mesh = snow_on(direction, RADIUS, params, &bare);
        assert_int_equal(mesh->face_count, 0);
        mesh_free(mesh);
    }
    assert_true(snow_stays(&params, 1.0f) == 1.0f && snow_stays(&params, 0.0f) == 0.0f);
}

// With gaps, cushions end inside the branch: every open edge is below its surface.
static void cushions_end_inside_the_branch(void **state)
{
    (void)state;
    SnowParams params = {.depth = DEPTH, .steepest = 50.0f, .gaps = 0.5f};
    Mesh *mesh = snow_on(vec3(1, 0, 0), RADIUS, params, NULL);
    Mesh *whole = snow_on(vec3(1, 0, 0), RADIUS, (SnowParams){DEPTH, 50.0f, 0.0f}, NULL);
    assert_true(mesh->face_count > 0 && mesh->face_count < whole->face_count);
    int used[4096] = {0};
    assert_true(mesh->vertex_count < 4096);
    for (int64_t i = 0; i < 4 * mesh->face_count; i++) {
        used[mesh->index[i]]++;
    }
    for (int64_t i = 0; i < mesh->vertex_count; i++) {
        Vec3 p = mesh->position[i];
        bool at_branch_end = p.x < 0.05f || p.x > LENGTH - 0.05f;
        if (used[i] == 2 && !at_branch_end) { // of the first or last ring of a cushion
            assert_true(sqrtf(p.y * p.y + p.z * p.z) < RADIUS);
        }
    }
    mesh_free(mesh);
    mesh_free(whole);
}

// A sheet of squares in the plane z = 0.
static Mesh *sheet(int across, int along, float size)
{
    Mesh *mesh = mesh_new(4, (int64_t)(across + 1) * (along + 1), (int64_t)across * along, 0, NULL);
    assert_non_null(mesh);
    for (int y = 0; y <= along; y++) {
        for (int x = 0; x <= across; x++) {
            mesh->position[y * (across + 1) + x] = vec3((float)x * size, (float)y * size, 0.0f);
        }
    }
    uint32_t *corner = mesh->index;
    for (int y = 0; y < along; y++) {
        for (int x = 0; x < across; x++) {
            uint32_t low = (uint32_t)(y * (across + 1) + x), high = low + (uint32_t)across + 1;
            *corner++ = low;
            *corner++ = low + 1;
            *corner++ = high + 1;
            *corner++ = high;
        }
    }
    return mesh;
}

static void a_cushion_is_closed_and_faces_outward(void **state)
{
    (void)state;
    Mesh *spray = sheet(40, 80, 0.005f);
    for (int turned = 0; turned < 2; turned++) {
        Mesh *mesh = snow_on_spray(spray, DEPTH, turned, 9, NULL);
        assert_non_null(mesh);
        MeshTopology topology;
        assert_true(mesh_topology(mesh, &topology, NULL));
        assert_int_equal(topology.open_edges, 0);
        assert_int_equal(topology.misoriented_edges, 0);
        assert_int_equal(topology.overused_edges, 0);
        uint8_t *closed = malloc((size_t)mesh->face_count);
        assert_non_null(closed);
        assert_true(mesh_closed_faces(mesh, closed, NULL));
        assert_true(closed[0]); // outward: its volume is positive
        Aabb box = mesh_bounds(mesh);
        float top = turned ? -box.low.z : box.high.z;
        assert_true(top > 0.7f * DEPTH && top < 1.35f * DEPTH);
        for (int64_t i = 0; i < mesh->vertex_count; i++) {
            assert_true(vec3_finite(mesh->normal[i]));
        }
        free(closed);
        mesh_free(mesh);
    }
    mesh_free(spray);
}

static void no_spray_no_snow(void **state)
{
    (void)state;
    Mesh *none = mesh_new(4, 0, 0, 0, NULL), *mesh = snow_on_spray(none, DEPTH, false, 9, NULL);
    assert_non_null(mesh);
    assert_int_equal(mesh->face_count, 0);
    mesh_free(mesh);
    mesh_free(none);
}

// Three layers that catch half of what they cover, above a place and beside it.
static void layers_above_keep_snow_off(void **state)
{
    (void)state;
    SnowFall fall;
    Aabb bounds = {vec3(0, 0, 0), vec3(8, 8, 8)};
    assert_true(snow_fall_init(&fall, bounds, NULL));
    float cell = fall.cell, area = cell * cell;
    Vec3 low = vec3(2.1f, 1.0f, 3.1f), beside = vec3(5.0f, 1.0f, 3.1f);
    for (int i = 0; i < 3; i++) {
        snow_fall_add(&fall, vec3(low.x, 3.0f + (float)i, low.z), area);
    }
    snow_fall_finish(&fall);
    assert_true(fabs((double)snow_fall_share(&fall, low) - (0.2 + 0.8 * exp(-1.5))) < 1e-5);
    assert_true(fabs((double)snow_fall_share(&fall, vec3(low.x, 7.0f, low.z)) - (1.0)) < 1e-6);
    assert_true(fabs((double)snow_fall_share(&fall, beside) - (1.0)) < 1e-6);
    assert_true(snow_fall_share(&fall, vec3(-50, 90, 50)) <= 1.0f); // beyond the bounds
    snow_fall_free(&fall);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_level_branch_bears_its_depth),
        cmocka_unit_test(thin_twigs_bear_less),
        cmocka_unit_test(steep_and_bare_branches_bear_none),
        cmocka_unit_test(cushions_end_inside_the_branch),
        cmocka_unit_test(a_cushion_is_closed_and_faces_outward),
        cmocka_unit_test(no_spray_no_snow),
        cmocka_unit_test(layers_above_keep_snow_off),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
