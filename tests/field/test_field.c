// Guide fields: unit length, the swept spiral, the literal quaternion, the voxel grid, curl noise.
#include "testing.h"

#include "base/exact_math.h"
#include "base/random.h"
#include "field/curl.h"
#include "field/guide_field.h"
#include "field/point_tree.h"

#include <string.h>

static GuideField *field_new(const FieldParams *params, int count, Vec3 nucleus, Vec3 normal,
                             float half)
{
    Run run = run_default();
    run.threads = 2;
    Error e = {0};
    FieldSite site = {&nucleus, &normal, 1, {vec3_splat(-half), vec3_splat(half)}, NULL};
    GuideField *field = guide_field_new(params, count, &site, &run, &e);
    if (!field) {
        fail_msg("%s", e.message);
    }
    return field;
}

static void assert_vec3(Vec3 a, Vec3 b, float tolerance)
{
    assert_float_equal(a.x, b.x, tolerance);
    assert_float_equal(a.y, b.y, tolerance);
    assert_float_equal(a.z, b.z, tolerance);
}

static Vec3 random_point(uint64_t seed, uint64_t i)
{
    uint64_t key = random_key(seed, i);
    return vec3(random_range(random_key(key, 0), -1, 1), random_range(random_key(key, 1), -1, 1),
                random_range(random_key(key, 2), -1, 1));
}

static void every_kind_is_unit(void **state)
{
    (void)state;
    for (int kind = FIELD_UNIFORM; kind <= FIELD_CURL; kind++) {
        FieldParams params = field_params_default((FieldKind)kind);
        params.vector = vec3(0, 2, 0);
        params.turn = 200.0f;
        params.scale = kind == FIELD_CURL ? 0.4f : 0.0f;
        GuideField *field = field_new(&params, 1, vec3(0.1f, -1, 0), vec3(0, 1, 0), 1.0f);
        for (uint64_t i = 0; i < 500; i++) {
            Vec3 x = guide_field_at(field, random_point(5, i), vec3(0, 1, 0));
            assert_float_equal(vec3_length(x), 1.0f, 1e-4f);
        }
        guide_field_free(field);
    }
}

static void simple_kinds_point_where_they_should(void **state)
{
    (void)state;
    FieldParams params[4] = {field_params_default(FIELD_UNIFORM),
                             field_params_default(FIELD_RADIAL), field_params_default(FIELD_VORTEX),
                             field_params_default(FIELD_POINT)};
    params[3].scale = 4.0f;
    const Vec3 expected[4] = {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}, {0, 0.5f, 0}};
    for (int i = 0; i < 4; i++) {
        GuideField *field = field_new(&params[i], 1, vec3(0, 0, 0), vec3(0, 1, 0), 3.0f);
        assert_vec3(guide_field_at(field, vec3(2, 0, 0), vec3(0, 1, 0)), expected[i], 1e-6f);
        guide_field_free(field);
    }
    params[0].weight = 2.0f;
    params[1].weight = -1.0f;
    GuideField *sum = field_new(params, 2, vec3(0, 0, 0), vec3(0, 1, 0), 3.0f);
    assert_vec3(guide_field_at(sum, vec3(0, 0, 5), vec3(0, 1, 0)), vec3(0, 2, -1), 1e-6f);
    guide_field_free(sum);
}

// The angle about +Y by which v stands ahead of u.
static float azimuth_between(Vec3 u, Vec3 v)
{
    return exact_atan2(u.z * v.x - u.x * v.z, u.x * v.x + u.z * v.z) / RADIANS_PER_DEGREE;
}

// Follows the field from near the nucleus of a unit sphere (the south pole) to near the north pole;
// returns the azimuth swept, degrees.
static float swept_on_sphere(float turn, float start, float stop)
{
    FieldParams params = field_params_default(FIELD_NUCLEI);
    params.turn = turn;
    params.spherical = params.surface = true;
    GuideField *field = field_new(&params, 1, vec3(0, -1, 0), vec3(0, -1, 0), 1.0f);
    float s, c, swept = 0.0f;
    exact_sincos(start, &s, &c);
    Vec3 p = vec3(s, -c, 0);
    exact_sincos(stop, &s, &c);
    for (int i = 0; i < 100000 && p.y < -c; i++) {
        Vec3 x = guide_field_at(field, p, p);
        assert_float_equal(vec3_dot(x, p), 0.0f, 1e-4f);
        Vec3 middle = vec3_normalize(vec3_madd(p, 0.0005f, x));
        Vec3 q = vec3_normalize(vec3_madd(p, 0.001f, guide_field_at(field, middle, middle)));
        swept += azimuth_between(p, q);
        p = q;
    }
    guide_field_free(field);
    assert_true(p.y >= -c);
    return swept;
}

static void a_streamline_on_a_sphere_sweeps_the_turn(void **state)
{
    (void)state;
    const float turns[] = {0.0f, 120.0f, 360.0f, 720.0f};
    float start = 0.02f, stop = PI_F - 0.02f;
    for (int i = 0; i < 4; i++) {
        float swept = swept_on_sphere(turns[i], start, stop);
        float share = (stop - start) / PI_F; // of the way from pole to pole
        assert_float_equal(fabsf(swept), turns[i] * share, 0.01f * turns[i] + 0.05f);
    }
}

// In the plane, from the middle of the bounds to their side.
static void a_streamline_in_the_plane_sweeps_the_turn(void **state)
{
    (void)state;
    const float turns[] = {120.0f, 360.0f, 720.0f};
    for (int i = 0; i < 3; i++) {
        for (int surface = 0; surface < 2; surface++) {
            FieldParams params = field_params_default(FIELD_NUCLEI);
            params.turn = turns[i];
            params.surface = surface;
            GuideField *field = field_new(&params, 1, vec3(0, 0, 0), vec3(0, 1, 0), 2.0f);
            Vec3 p = vec3(0.01f, 0, 0);
            float swept = 0.0f;
            while (vec3_length(p) < 2.0f) {
                Vec3 x = guide_field_at(field, p, vec3(0, 1, 0));
                Vec3 middle = vec3_madd(p, 0.0005f, x);
                Vec3 q = vec3_madd(p, 0.001f, guide_field_at(field, middle, vec3(0, 1, 0)));
                assert_true(vec3_length(q) > vec3_length(p)); // never runs backwards
                swept += azimuth_between(p, q);
                p = q;
            }
            assert_float_equal(fabsf(swept), turns[i] * 0.995f, 0.01f * turns[i]);
            guide_field_free(field);
        }
    }
}

static void constant_profile_is_the_literal_quaternion(void **state)
{
    (void)state;
    FieldParams params = field_params_default(FIELD_NUCLEI);
    params.profile = PROFILE_CONSTANT;
    const float turns[] = {0.0f, 90.0f, 180.0f, 360.0f};
    const Vec3 expected[] = {{1, 0, 0}, {0, 0, -1}, {-1, 0, 0}, {1, 0, 0}};
    for (int i = 0; i < 4; i++) {
        params.turn = turns[i];
        GuideField *field = field_new(&params, 1, vec3(0, 0, 0), vec3(0, 1, 0), 1.0f);
        assert_vec3(guide_field_at(field, vec3(0.7f, 0, 0), vec3(0, 1, 0)), expected[i], 1e-5f);
        guide_field_free(field);
    }
    // a longer normal turns further: tan(half the angle) grows by its length
    params.turn = 60.0f;
    params.vector = vec3(0, 1.7320508f, 0);
    GuideField *field = field_new(&params, 1, vec3(0, 0, 0), vec3(0, 1, 0), 1.0f);
    assert_vec3(guide_field_at(field, vec3(0.7f, 0, 0), vec3(0, 1, 0)), vec3(0, 0, -1), 1e-5f);
    guide_field_free(field);
}

static void the_grid_is_close_to_the_field_it_samples(void **state)
{
    (void)state;
    FieldParams params = field_params_default(FIELD_NUCLEI);
    params.turn = 360.0f;
    GuideField *exact = field_new(&params, 1, vec3(0, -1.2f, 0), vec3(0, 1, 0), 1.0f);
    params.kind = FIELD_GRID;
    params.resolution = 96;
    GuideField *grid = field_new(&params, 1, vec3(0, -1.2f, 0), vec3(0, 1, 0), 1.0f);
    for (uint64_t i = 0; i < 2000; i++) {
        Vec3 p = random_point(3, i), n = vec3(0, 1, 0);
        assert_vec3(guide_field_at(grid, p, n), guide_field_at(exact, p, n), 0.025f);
    }
    guide_field_free(exact);
    guide_field_free(grid);
}

static void curl_noise_has_no_divergence(void **state)
{
    (void)state;
    float largest = 0.0f;
    for (uint64_t i = 0; i < 300; i++) {
        Vec3 p = vec3_scale(random_point(8, i), 5.0f);
        float h = 0.01f, divergence = 0.0f;
        divergence += curl_noise(vec3_add(p, vec3(h, 0, 0)), 4).x;
        divergence -= curl_noise(vec3_sub(p, vec3(h, 0, 0)), 4).x;
        divergence += curl_noise(vec3_add(p, vec3(0, h, 0)), 4).y;
        divergence -= curl_noise(vec3_sub(p, vec3(0, h, 0)), 4).y;
        divergence += curl_noise(vec3_add(p, vec3(0, 0, h)), 4).z;
        divergence -= curl_noise(vec3_sub(p, vec3(0, 0, h)), 4).z;
        assert_float_equal(divergence / (2.0f * h), 0.0f, 0.02f);
        float length = vec3_length(curl_noise(p, 4));
        largest = length > largest ? length : largest;
    }
    assert_true(largest > 0.5f);
}

// Equally near points are frequent on a lattice, and some points are the same.
static void the_nearest_point_is_that_of_a_search_through_all(void **state)
{
    (void)state;
    enum { COUNT = 700 };
    static const float lattice[] = {0.0f, 0.25f, 0.03125f}; // 0: no lattice
    for (int k = 0; k < 3; k++) {
        Vec3 point[COUNT];
        for (uint64_t i = 0; i < COUNT; i++) {
            Vec3 p = random_point(17, i);
            float s = lattice[k];
            point[i] = s == 0.0f ? p : vec3(s * floorf(p.x / s), s * floorf(p.y / s), 0.5f);
        }
        PointTree tree;
        assert_true(point_tree_init(&tree, point, COUNT, NULL));
        for (uint64_t i = 0; i < 1000; i++) {
            Vec3 p = i % 2 ? random_point(18, i) : point[i % COUNT];
            int32_t skip = i % 3 ? (int32_t)(i % COUNT) : -1, nearest = 0;
            float best = INFINITY;
            for (int32_t j = 0; j < COUNT; j++) {
                Vec3 v = vec3_sub(p, point[j]);
                if (j != skip && vec3_dot(v, v) < best) {
                    nearest = j;
                    best = vec3_dot(v, v);
                }
            }
            assert_int_equal(point_tree_nearest(&tree, p, skip)->index, nearest);
        }
        point_tree_free(&tree);
    }
    PointTree one, empty;
    assert_true(point_tree_init(&one, &(Vec3){1, 2, 3}, 1, NULL));
    assert_non_null(point_tree_nearest(&one, vec3(0, 0, 0), -1));
    assert_null(point_tree_nearest(&one, vec3(0, 0, 0), 0));
    point_tree_free(&one);
    assert_true(point_tree_init(&empty, NULL, 0, NULL));
    assert_null(point_tree_nearest(&empty, vec3(0, 0, 0), -1));
    point_tree_free(&empty);
}

// Of two points and a column, each governs what is nearest to it, with its own normal.
static void the_nearest_of_the_named_nuclei_counts(void **state)
{
    (void)state;
    Nucleus nucleus[3] = {{.kind = NUCLEUS_POINT, .position = {4, 0, 0}},
                          {.kind = NUCLEUS_POINT, .position = {-4, 0, 0}, .normal = {0, 0, 1}},
                          {.kind = NUCLEUS_LINE, .position = {0, 0, -3}, .end = {0, 0, 3}}};
    FieldParams params = field_params_default(FIELD_NUCLEI);
    params.profile = PROFILE_CONSTANT;
    params.turn = 90.0f;
    params.nucleus = nucleus;
    params.nucleus_count = 3;
    GuideField *field = field_new(&params, 1, vec3(9, 9, 9), vec3(1, 0, 0), 5.0f);
    const Vec3 at[] = {{5, 0, 0}, {-5, 0, 0}, {1, 0, 2}, {0, -1, -3}, {0, 0, 4}};
    const Vec3 expected[] = {{0, 0, -1}, {0, -1, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}};
    for (int i = 0; i < 5; i++) {
        assert_vec3(guide_field_at(field, at[i], vec3(1, 0, 0)), expected[i], 1e-5f);
    }
    guide_field_free(field);
    params.vector = vec3(0, 1, 0); // of the field: it counts for all nuclei
    field = field_new(&params, 1, vec3(9, 9, 9), vec3(1, 0, 0), 5.0f);
    assert_vec3(guide_field_at(field, at[1], vec3(1, 0, 0)), vec3(0, 0, 1), 1e-5f);
    guide_field_free(field);
}

static void a_surface_of_nuclei_is_left_on_both_sides(void **state)
{
    (void)state;
    Shape ball = {.kind = SHAPE_SPHERE, .transform = transform_identity()};
    Nucleus nucleus = {.kind = NUCLEUS_SURFACE, .shapes = &ball, .shape_count = 1};
    FieldParams params = field_params_default(FIELD_NUCLEI);
    params.nucleus = &nucleus;
    params.nucleus_count = 1;
    GuideField *field = field_new(&params, 1, vec3(0, 0, 0), vec3(0, 1, 0), 2.0f);
    for (uint64_t i = 0; i < 200; i++) {
        Vec3 d = random_direction(random_key(6, i));
        Vec3 out = guide_field_at(field, vec3_scale(d, 1.5f), d);
        Vec3 in = guide_field_at(field, vec3_scale(d, 0.5f), d);
        assert_true(vec3_dot(out, d) > 0.998f && vec3_dot(in, d) < -0.998f);
    }
    guide_field_free(field);
}

// What growth with this weight does whose attractors pull straight outward.
static void growth_under_the_grown_profile_sweeps_the_turn(void **state)
{
    (void)state;
    const float turns[] = {120.0f, 360.0f, -720.0f}, weights[] = {1.2f, 3.0f};
    for (int i = 0; i < 6; i++) {
        float turn = turns[i / 2], weight = weights[i % 2], swept = 0.0f;
        FieldParams params = field_params_default(FIELD_NUCLEI);
        params.turn = turn;
        params.profile = PROFILE_GROWN;
        params.pull = 1.0f / weight;
        GuideField *field = field_new(&params, 1, vec3(0, 0, 0), vec3(0, 1, 0), 2.0f);
        Vec3 p = vec3(0.01f, 0, 0);
        while (vec3_length(p) < 2.0f) {
            Vec3 x = guide_field_at(field, p, vec3(0, 1, 0));
            Vec3 d = vec3_normalize(vec3_madd(vec3_normalize(p), weight, x));
            Vec3 q = vec3_madd(p, 0.001f, d);
            assert_true(vec3_length(q) > vec3_length(p));
            swept += azimuth_between(p, q);
            p = q;
        }
        assert_float_equal(swept, turn, 0.02f * fabsf(turn));
        guide_field_free(field);
    }
}

// A weak field turns growth as far as it can, and not backwards.
static void a_weak_field_under_the_grown_profile_does_its_best(void **state)
{
    (void)state;
    float sine[2];
    for (int i = 0; i < 2; i++) {
        FieldParams params = field_params_default(FIELD_NUCLEI);
        params.turn = i == 0 ? 360.0f : 3600.0f;
        params.profile = PROFILE_GROWN;
        params.pull = 4.0f;
        GuideField *field = field_new(&params, 1, vec3(0, 0, 0), vec3(0, 1, 0), 2.0f);
        Vec3 x = guide_field_at(field, vec3(1, 0, 0), vec3(0, 1, 0));
        sine[i] = -vec3_normalize(vec3_madd(vec3(1, 0, 0), 0.25f, x)).z;
        guide_field_free(field);
    }
    assert_float_equal(sine[0], 0.25f, 1e-4f);
    assert_float_equal(sine[1], 0.25f, 1e-4f);
}

static void wrong_fields_are_errors(void **state)
{
    (void)state;
    Run run = run_default();
    Vec3 at = vec3(0, 0, 0), up = vec3(0, 1, 0);
    FieldSite site = {&at, &up, 1, {vec3_splat(-1), vec3_splat(1)}, NULL};
    FieldSite nowhere = {.bounds = site.bounds};
    Error e = {0};
    FieldParams params = field_params_default(FIELD_NUCLEI);
    assert_null(guide_field_new(&params, 1, &nowhere, &run, &e));
    assert_string_equal(e.message, "a nuclei field needs at least one root to lead away from");
    params = field_params_default(FIELD_CURL);
    params.scale = -1.0f;
    assert_null(guide_field_new(&params, 1, &site, &run, &e));
    assert_string_equal(e.message, "field scale -1 m; it must be positive");
    params = field_params_default(FIELD_GRID);
    params.resolution = 5000;
    assert_null(guide_field_new(&params, 1, &site, &run, &e));
    assert_string_equal(e.message, "field resolution 5000; it must be 1 to 2048");
    params = field_params_default(FIELD_NUCLEI);
    params.turn = NAN;
    assert_null(guide_field_new(&params, 1, &site, &run, &e));
    assert_string_equal(e.message, "a field's numbers must be finite");
    params = field_params_default(FIELD_CURVATURE);
    assert_null(guide_field_new(&params, 1, &site, &run, &e));
    assert_string_equal(e.message,
                        "a curvature field needs an envelope with a surface; use another kind");
}

// Around and along the middle of a capsule and of a prolate ellipsoid; nowhere on a sphere.
static void curvature_leads_around_or_along(void **state)
{
    (void)state;
    Run run = run_default();
    Error e = {0};
    const Shape shapes[3] = {
        {.kind = SHAPE_CAPSULE, .size = {0.5f, 2, 0}, .transform = transform_identity()},
        {.kind = SHAPE_ELLIPSOID, .size = {0.5f, 1.5f, 0.5f}, .transform = transform_identity()},
        {.kind = SHAPE_SPHERE, .size = {1, 1, 1}, .transform = transform_identity()}};
    for (int i = 0; i < 6; i++) {
        EnvelopeParams envelope_params = {.shapes = &shapes[i / 2], .shape_count = 1};
        Envelope *envelope = envelope_new(&envelope_params, &run, &e);
        FieldParams params = field_params_default(FIELD_CURVATURE);
        params.vector = vec3(0.1f, 1, 0.2f);
        params.least = i % 2;
        FieldSite site = {.bounds = envelope_bounds(envelope), .envelope = envelope};
        GuideField *field = guide_field_new(&params, 1, &site, &run, &e);
        assert_non_null(field);
        for (int k = 0; k < 32; k++) {
            float s, c, y = (i / 2 == 0 ? 1.0f : 0.0f) + 0.3f * sinf((float)k);
            exact_sincos(0.19635f * (float)k, &s, &c);
            Vec3 normal = vec3(c, 0, s);
            Vec3 x = guide_field_at(field, vec3(0.5f * c, y, 0.5f * s), normal);
            if (i / 2 == 2) {
                assert_true(vec3_length(x) < 1e-3f);
                continue;
            }
            float up = fabsf(x.y);
            assert_float_equal(vec3_length(x), 1.0f, 1e-4f);
            assert_true(i % 2 ? up > 0.9f : up < 0.2f);
            assert_true(vec3_dot(x, params.vector) >= 0.0f);
        }
        guide_field_free(field);
        envelope_free(envelope);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_is_unit),
        cmocka_unit_test(simple_kinds_point_where_they_should),
        cmocka_unit_test(a_streamline_on_a_sphere_sweeps_the_turn),
        cmocka_unit_test(a_streamline_in_the_plane_sweeps_the_turn),
        cmocka_unit_test(constant_profile_is_the_literal_quaternion),
        cmocka_unit_test(the_grid_is_close_to_the_field_it_samples),
        cmocka_unit_test(curl_noise_has_no_divergence),
        cmocka_unit_test(the_nearest_point_is_that_of_a_search_through_all),
        cmocka_unit_test(the_nearest_of_the_named_nuclei_counts),
        cmocka_unit_test(a_surface_of_nuclei_is_left_on_both_sides),
        cmocka_unit_test(growth_under_the_grown_profile_sweeps_the_turn),
        cmocka_unit_test(a_weak_field_under_the_grown_profile_does_its_best),
        cmocka_unit_test(wrong_fields_are_errors),
        cmocka_unit_test(curvature_leads_around_or_along),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
