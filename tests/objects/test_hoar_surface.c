// Hoar frost on boxes, whose areas, thickness and sides are known.
#include "making.h"
#include "mesh/mesh_rays.h"
#include "objects/common/hoar.h"
#include "testing.h"

#include <math.h>

// A box about the origin, each side divided into cells * cells quads.
static Mesh *box_of(Vec3 half, int cells)
{
    Mesh *mesh =
        mesh_new(4, (int64_t)6 * (cells + 1) * (cells + 1), (int64_t)6 * cells * cells, 0, NULL);
    assert_non_null(mesh);
    static const Vec3 NORMAL[6] = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                   {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
    int64_t vertex = 0, corner = 0;
    for (int side = 0; side < 6; side++) {
        Vec3 n = NORMAL[side], u = vec3(n.y, n.z, n.x), v = vec3_cross(n, u);
        int64_t first = vertex;
        for (int k = 0; k < (cells + 1) * (cells + 1); k++) {
            float a = 2.0f * (float)(k % (cells + 1)) / (float)cells - 1.0f;
            float b = 2.0f * (float)(k / (cells + 1)) / (float)cells - 1.0f;
            mesh->position[vertex++] = vec3_mul(half, vec3_madd(vec3_madd(n, a, u), b, v));
        }
        for (int k = 0; k < cells * cells; k++) {
            int64_t at = first + k / cells * (cells + 1) + k % cells;
            mesh->index[corner++] = (uint32_t)at;
            mesh->index[corner++] = (uint32_t)(at + 1);
            mesh->index[corner++] = (uint32_t)(at + cells + 2);
            mesh->index[corner++] = (uint32_t)(at + cells + 1);
        }
    }
    return mesh;
}

static HoarParams still_air(void)
{
    HoarParams params = hoar_params_default();
    params.length = 0.02f;
    params.bias = 0.0f;
    params.thickest = 1.0f;
    return params;
}

static Geometry frost_on(const HoarParams *params, Vec3 half, int cells)
{
    Mesh *mesh = box_of(half, cells);
    Run run = run_default();
    Recipe recipe = {.seed = 5, .label = "box", .run = &run};
    Geometry geometry = {0};
    Placing placing = placing_in(&geometry, &recipe);
    Error e = {0};
    if (!hoar_add_on_mesh(mesh, params, &placing, 1, &e)) {
        fail_msg("%s", e.message);
    }
    mesh_free(mesh);
    return geometry;
}

// Tufts whose feet lie on the side with this normal, at least `margin` from its edges.
typedef struct Side {
    double count;
    double length; // m, mean
    Vec3 along;    // mean direction
} Side;

static bool lies_on(Vec3 foot, Vec3 half, Vec3 n, float margin)
{
    Vec3 off = vec3(fabsf(foot.x) - half.x, fabsf(foot.y) - half.y, fabsf(foot.z) - half.z);
    Vec3 flat = vec3(1.0f - fabsf(n.x), 1.0f - fabsf(n.y), 1.0f - fabsf(n.z));
    bool inner = (flat.x == 0.0f || off.x < -margin) && (flat.y == 0.0f || off.y < -margin) &&
                 (flat.z == 0.0f || off.z < -margin);
    return inner && fabsf(vec3_dot(n, vec3_sub(foot, vec3_mul(half, n)))) < 1e-5f;
}

static Side side_of(const Geometry *geometry, Vec3 half, Vec3 n, float margin)
{
    Side side = {0};
    for (int64_t i = 0; i < geometry->count; i++) {
        assert_int_equal(geometry->part[i].material, 1);
        for (int64_t k = 0; k < geometry->part[i].instance_count; k++) {
            const Transform *t = &geometry->part[i].instance[k];
            Vec3 foot = transform_point(t, vec3(0, 0, 0)), y = transform_vector(t, vec3(0, 1, 0));
            if (lies_on(foot, half, n, margin)) {
                assert_true(vec3_dot(y, n) > 0.0f);
                side.count += 1.0;
                side.length += (double)vec3_length(y);
                side.along = vec3_add(side.along, vec3_normalize(y));
            }
        }
    }
    side.length /= fmax(side.count, 1.0);
    side.along = vec3_normalize(side.along);
    return side;
}

static void assert_near(double value, double wanted, double share)
{
    if (fabs(value - wanted) > share * fabs(wanted)) {
        fail_msg("%g, not %g", value, wanted);
    }
}

static void density_does_not_depend_on_the_faces(void **state)
{
    (void)state;
    const Vec3 half = {0.5f, 0.2f, 0.4f}, up = {0, 1, 0};
    HoarParams params = still_air();
    Geometry coarse = frost_on(&params, half, 1), fine = frost_on(&params, half, 70);
    // Inside the margin the largest ball is as thick as the box is high.
    double area = 0.6 * 0.4, wanted = area * (double)hoar_tufts_per_area(&params, 0.2f);
    double law = area * (1.0 + 1.5 * 0.2 / 0.02) / (0.22 * 0.02 * 2.0 * 3.14159265 * 0.2);
    assert_near(wanted, law, 1e-4);
    assert_near(side_of(&coarse, half, up, 0.2f).count, law, 0.06);
    assert_near(side_of(&fine, half, up, 0.2f).count, law, 0.06);
    // with the edges, too
    double once = side_of(&coarse, half, up, 0.0f).count;
    assert_near(side_of(&fine, half, up, 0.0f).count, once, 0.05);
    geometry_clear(&coarse);
    geometry_clear(&fine);
}

static void thin_parts_and_edges_bear_more(void **state)
{
    (void)state;
    const Vec3 plate = {0.3f, 0.002f, 0.3f}, block = {0.3f, 0.3f, 0.3f}, up = {0, 1, 0};
    HoarParams params = still_air();
    params.thickest = 0.01f;
    Geometry thin = frost_on(&params, plate, 1), thick = frost_on(&params, block, 1);
    Side sheet = side_of(&thin, plate, up, 0.05f), middle = side_of(&thick, block, up, 0.25f);
    double mean = 0.5 * (0.35 + 1.2) * 0.02; // m, before it is thinned
    assert_near(sheet.count, 0.25 * (double)hoar_tufts_per_area(&params, 0.002f), 0.04);
    assert_near(sheet.length, mean * 0.01 / 0.012, 0.03);
    assert_near(middle.length, mean * 0.01 / 0.31, 0.15);
    Side all = side_of(&thick, block, up, 0.0f), inner = side_of(&thick, block, up, 0.01f);
    double edge = (all.count - inner.count) / (0.36 - 0.58 * 0.58),
           within = inner.count / (0.58 * 0.58);
    assert_true(edge > 1.5 * within);
    geometry_clear(&thin);
    geometry_clear(&thick);
}

static void frost_follows_the_wind(void **state)
{
    (void)state;
    const Vec3 half = {0.2f, 0.2f, 0.2f}, front = {0, 0, 1}, back = {0, 0, -1}, side = {1, 0, 0};
    HoarParams params = still_air();
    params.wind = 180.0f; // toward -Z
    params.bias = 0.3f;
    Geometry windy = frost_on(&params, half, 3);
    Side luff = side_of(&windy, half, front, 0), lee = side_of(&windy, half, back, 0);
    Side beside = side_of(&windy, half, side, 0);
    // A sphere about 3/7: seen along and against its offset, and across.
    double k = 3.0 / 7.0, ahead = 1.0 + k, behind = 1.0 - k, across = sqrt(1.0 - k * k);
    assert_near(luff.count / lee.count, ahead / behind, 0.08);
    assert_near(luff.length / lee.length, ahead / behind, 0.08);
    assert_near(luff.count / beside.count, ahead / sqrt(across), 0.08);
    assert_near((double)(beside.along.z / beside.along.x), k, 0.1); // lerp(x, z, 0.3)
    params.bias = 1.0f;
    Geometry rime = frost_on(&params, half, 3);
    assert_true(side_of(&rime, half, back, 0).count == 0.0);
    assert_true(side_of(&rime, half, side, 0).count == 0.0);
    assert_true(side_of(&rime, half, front, 0).count > 1.8 * luff.count / ahead);
    geometry_clear(&windy);
    geometry_clear(&rime);
}

// The mean of the law over all directions is 1.
static void wind_moves_frost_and_makes_none(void **state)
{
    (void)state;
    enum { STEPS = 20000 };
    for (int b = 0; b <= 10; b++) {
        HoarParams params = still_air();
        params.bias = 0.1f * (float)b;
        double sum = 0.0;
        for (int i = 0; i < STEPS; i++) {
            sum += (double)hoar_wind_share(&params, 2.0f * ((float)i + 0.5f) / STEPS - 1.0f);
        }
        assert_near(sum / STEPS, 1.0, 0.002);
    }
}

static void radiation_leaves_the_lower_side_bare(void **state)
{
    (void)state;
    const Vec3 half = {0.2f, 0.2f, 0.2f}, up = {0, 1, 0}, down = {0, -1, 0}, wall = {1, 0, 0};
    HoarParams params = still_air();
    Geometry fog = frost_on(&params, half, 2);
    params.sky = 1.0f;
    Geometry night = frost_on(&params, half, 2);
    Side top = side_of(&night, half, up, 0), side = side_of(&night, half, wall, 0);
    assert_near(top.count, side_of(&fog, half, up, 0).count, 0.06);
    assert_true(side_of(&fog, half, down, 0).count > 0.9 * top.count);
    assert_true(side_of(&night, half, down, 0).count == 0.0);
    assert_near(side.length / top.length, sqrt(0.5), 0.06); // sees half of the sky
    assert_near(side.count / top.count, sqrt(0.5), 0.06);
    geometry_clear(&fog);
    geometry_clear(&night);
}

static void max_count_bounds_the_tufts(void **state)
{
    (void)state;
    const Vec3 half = {0.2f, 0.2f, 0.2f};
    HoarParams params = still_air();
    params.max_count = 500;
    Geometry few = frost_on(&params, half, 2);
    double count = 0.0;
    for (int64_t i = 0; i < few.count; i++) {
        count += (double)few.part[i].instance_count;
    }
    assert_near(count, 500.0, 0.1);
    geometry_clear(&few);
}

// Against all triangles one by one: a box is met where its planes are.
// If max_count is above what edges everywhere would bear, cells that bear none in any case are left
// out; below, all are judged, since the sum decides. The frost is the same.
static void leaving_cells_out_changes_nothing(void **state)
{
    (void)state;
    const Vec3 half = {0.5f, 0.2f, 0.4f};
    const double area = 3.04, few = 15500.0; // so many cells are as long as the needles still
    HoarParams params = still_air();
    params.sky = 0.5f;
    params.density *= (float)(24000.0 / (area * (double)hoar_tufts_per_area(&params, 0.0f)));
    params.max_count = 10000000;
    Geometry some = frost_on(&params, half, 1);
    params.max_count = (int64_t)few;
    Geometry all = frost_on(&params, half, 1);
    assert_int_equal(some.count, all.count);
    int64_t tufts = 0;
    for (int64_t i = 0; i < some.count; i++) {
        assert_int_equal(some.part[i].instance_count, all.part[i].instance_count);
        size_t size = (size_t)some.part[i].instance_count * sizeof(Transform);
        assert_memory_equal(some.part[i].instance, all.part[i].instance, size);
        tufts += some.part[i].instance_count;
    }
    assert_true(tufts > 500 && (double)tufts < few);
    geometry_clear(&some);
    geometry_clear(&all);
}

static void rays_meet_the_box(void **state)
{
    (void)state;
    const Vec3 half = {0.3f, 0.2f, 0.1f};
    Mesh *mesh = box_of(half, 9);
    MeshRays *rays = mesh_rays_new(mesh, NULL);
    assert_non_null(rays);
    for (uint64_t i = 0; i < 500; i++) {
        Vec3 d = random_direction(random_key(1, i));
        Vec3 p = vec3_mul(half, vec3_scale(random_direction(random_key(2, i)), 0.57f));
        float x = (half.x - copysignf(1.0f, d.x) * p.x) / fabsf(d.x);
        float y = (half.y - copysignf(1.0f, d.y) * p.y) / fabsf(d.y);
        float z = (half.z - copysignf(1.0f, d.z) * p.z) / fabsf(d.z);
        float wanted = fminf(x, fminf(y, z));
        assert_near((double)mesh_rays_way(rays, p, d, true, 10.0f), (double)wanted, 1e-4);
        assert_near((double)mesh_rays_way(rays, p, d, false, 10.0f), (double)wanted, 1e-4);
        Vec3 outside = vec3_madd(p, -5.0f, d);
        assert_true(mesh_rays_way(rays, outside, vec3_neg(d), false, 10.0f) == INFINITY);
    }
    mesh_rays_free(rays);
    mesh_free(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(density_does_not_depend_on_the_faces),
        cmocka_unit_test(thin_parts_and_edges_bear_more),
        cmocka_unit_test(frost_follows_the_wind),
        cmocka_unit_test(wind_moves_frost_and_makes_none),
        cmocka_unit_test(radiation_leaves_the_lower_side_bare),
        cmocka_unit_test(max_count_bounds_the_tufts),
        cmocka_unit_test(leaving_cells_out_changes_nothing),
        cmocka_unit_test(rays_meet_the_box),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
