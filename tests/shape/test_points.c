// Scattered points: where they lie, how many, how dense, and that they are always the same.
#include "shape/points.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static Envelope *make_shape(ShapeKind kind, Vec3 size, Transform transform)
{
    Shape shape = {.kind = kind, .size = size, .transform = transform};
    EnvelopeParams params = {.shapes = &shape, .shape_count = 1};
    Run run = run_default();
    Envelope *envelope = envelope_new(&params, &run, NULL);
    assert_non_null(envelope);
    return envelope;
}

// A box with a ball taken out of its corner: a level set.
static Envelope *make_bitten_box(int threads)
{
    Shape shapes[2] = {
        {.kind = SHAPE_BOX, .size = vec3(1, 1, 1), .transform = transform_identity()},
        {.kind = SHAPE_SPHERE,
         .op = SHAPE_DIFFERENCE,
         .transform = transform_compose(vec3(1, 1, 1), vec3(0, 0, 0), vec3(1, 1, 1))}};
    EnvelopeParams params = {.shapes = shapes, .shape_count = 2, .voxel = 0.04f};
    Run run = run_default();
    run.threads = threads;
    Envelope *envelope = envelope_new(&params, &run, NULL);
    assert_non_null(envelope);
    return envelope;
}

static PointSet *scatter(const Envelope *envelope, const ScatterParams *params, int threads)
{
    Run run = run_default();
    Error e = {0};
    run.threads = threads;
    PointSet *points = points_scatter(envelope, params, &run, &e);
    assert_string_equal(e.message, "");
    assert_non_null(points);
    return points;
}

static void surface_is_uniform_by_area(void **state)
{
    (void)state;
    // a stretched, turned ellipsoid: equal bands of its triangles hold points by their area
    Envelope *envelope =
        make_shape(SHAPE_ELLIPSOID, vec3(2, 1, 0.5f),
                   transform_compose(vec3(3, 1, 2), vec3(20, 30, 40), vec3(1, 1.5f, 1)));
    ScatterParams params = scatter_params_default();
    params.place = SCATTER_SURFACE;
    params.count = 40000;
    PointSet *points = scatter(envelope, &params, 2);
    assert_int_equal(points->count, params.count);
    assert_int_equal(points->dimension, 2);
    enum { BINS = 64 };
    double area[BINS] = {0}, total = 0.0, chi2 = 0.0;
    int64_t hits[BINS] = {0};
    Aabb box = envelope_bounds(envelope);
    Vec3 size = vec3_sub(box.high, box.low);
    const Mesh *mesh = envelope_surface(envelope);
    for (int pass = 0; pass < 2; pass++) {
        int64_t n = pass ? points->count : mesh->face_count;
        for (int64_t i = 0; i < n; i++) {
            Vec3 p = pass ? points->position[i] : vec3(0, 0, 0);
            double weight = 1.0;
            if (!pass) {
                const uint32_t *c = mesh->index + 3 * i;
                Vec3 a = mesh->position[c[0]], b = mesh->position[c[1]], d = mesh->position[c[2]];
                p = vec3_scale(vec3_add(a, vec3_add(b, d)), 1.0f / 3.0f);
                weight = 0.5 * (double)vec3_length(vec3_cross(vec3_sub(b, a), vec3_sub(d, a)));
                total += weight;
            }
            Vec3 u = vec3_sub(p, box.low);
            int bin = (int)fminf(4.0f * u.x / size.x, 3.0f) * 16 +
                      (int)fminf(4.0f * u.y / size.y, 3.0f) * 4 +
                      (int)fminf(4.0f * u.z / size.z, 3.0f);
            area[bin] += pass ? 0.0 : weight;
            hits[bin] += pass;
        }
    }
    int freedom = -1;
    for (int i = 0; i < BINS; i++) {
        double expected = area[i] / total * (double)points->count;
        if (expected > 30.0) { // smaller bins are too coarse for whole triangles
            chi2 += ((double)hits[i] - expected) * ((double)hits[i] - expected) / expected;
            freedom++;
        }
    }
    assert_true(freedom > 15);
    // mean f, standard deviation sqrt(2 f): five of them, and some for triangles across bins
    assert_true(chi2 < freedom + 5.0 * sqrt(2.0 * freedom) + 20.0);
    for (int64_t i = 0; i < points->count; i++) {
        assert_true(fabsf(envelope_distance(envelope, points->position[i])) < 1e-5f);
        assert_true(fabsf(vec3_length(points->normal[i]) - 1.0f) < 1e-5f);
    }
    points_free(points);
    envelope_free(envelope);
}

static void volume_is_filled_exactly(void **state)
{
    (void)state;
    Envelope *envelope = make_bitten_box(2);
    ScatterParams params = scatter_params_default();
    params.count = 20011;
    PointSet *points = scatter(envelope, &params, 2);
    assert_int_equal(points->count, params.count);
    int64_t low = 0;
    for (int64_t i = 0; i < points->count; i++) {
        Vec3 p = points->position[i];
        assert_true(envelope_contains(envelope, p));
        low += p.x < 0.0f;
    }
    // the bite is an eighth of a ball, all of it at x > 0
    double share = 4.0 / (8.0 - 4.0 / 3.0 * 3.14159265 / 8.0);
    assert_true(fabs((double)low / (double)points->count - share) < 0.015);
    assert_true(fabs(points->measure - envelope_volume(envelope)) < 1e-12);
    points_free(points);
    envelope_free(envelope);
}

static void poisson_keeps_its_distance(void **state)
{
    (void)state;
    Envelope *envelope = make_shape(SHAPE_SPHERE, vec3(0, 0, 0), transform_identity());
    for (int place = 0; place < 2; place++) {
        ScatterParams params = scatter_params_default();
        params.pattern = SCATTER_POISSON;
        params.place = place ? SCATTER_SURFACE : SCATTER_VOLUME;
        params.count = 2000;
        PointSet *points = scatter(envelope, &params, 2);
        assert_in_range(points->count, 1900, 2000);
        float nearest = INFINITY;
        for (int64_t i = 0; i < points->count; i++) {
            for (int64_t j = 0; j < i; j++) {
                nearest = fminf(nearest, vec3_distance(points->position[i], points->position[j]));
            }
        }
        // random points would have some pair about a hundredth of the spacing apart
        assert_true(nearest > 0.7f * (float)points_spacing(points));
        points_free(points);
    }
    envelope_free(envelope);
}

static void same_for_any_threads(void **state)
{
    (void)state;
    Envelope *again = make_bitten_box(3);
    Envelope *envelopes[2] = {make_bitten_box(1),
                              make_shape(SHAPE_CONE, vec3(1, 2, 0.2f), transform_identity())};
    for (int k = 0; k < 8; k++) {
        ScatterParams params = scatter_params_default();
        params.place = k & 1 ? SCATTER_SURFACE : SCATTER_VOLUME;
        params.pattern = k & 2 ? SCATTER_POISSON : SCATTER_RANDOM;
        params.count = 3000;
        params.shell = 0.3f;
        params.gradient = 0.4f;
        PointSet *one = scatter(envelopes[k / 4], &params, 1);
        PointSet *three = scatter(k < 4 ? again : envelopes[1], &params, 3);
        assert_int_equal(one->count, three->count);
        size_t n = (size_t)one->count;
        assert_memory_equal(one->position, three->position, n * sizeof(Vec3));
        assert_memory_equal(one->normal, three->normal, n * sizeof(Vec3));
        assert_memory_equal(one->id, three->id, n * sizeof(uint64_t));
        points_free(one);
        points_free(three);
    }
    envelope_free(again);
    envelope_free(envelopes[0]);
    envelope_free(envelopes[1]);
}

static int compare_ids(const void *a, const void *b)
{
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return x < y ? -1 : x > y;
}

static void moved_envelope_keeps_ids(void **state)
{
    (void)state;
    Transform moved = transform_compose(vec3(0.1f, 0, 0.02f), vec3(3, 0, 0), vec3(1, 1.02f, 1));
    Envelope *a = make_shape(SHAPE_CAPSULE, vec3(1, 2, 0), transform_identity());
    Envelope *b = make_shape(SHAPE_CAPSULE, vec3(1, 2, 0), moved);
    ScatterParams params = scatter_params_default();
    params.count = 5000;
    PointSet *p = scatter(a, &params, 1), *q = scatter(b, &params, 1);
    qsort(p->id, (size_t)p->count, sizeof *p->id, compare_ids);
    int64_t kept = 0;
    for (int64_t i = 0; i < q->count; i++) {
        kept += bsearch(&q->id[i], p->id, (size_t)p->count, sizeof *p->id, compare_ids) != NULL;
    }
    assert_true(kept > 4800);
    for (int64_t i = 1; i < p->count; i++) {
        assert_true(p->id[i] != p->id[i - 1]);
    }
    points_free(p);
    points_free(q);
    envelope_free(a);
    envelope_free(b);
}

// Mean of the distance from the origin (height = false) or of y over scattered points.
static double mean_of(const Envelope *envelope, ScatterParams params, bool height)
{
    params.count = 40000;
    PointSet *points = scatter(envelope, &params, 2);
    double sum = 0.0, n = (double)points->count;
    for (int64_t i = 0; i < points->count; i++) {
        Vec3 p = points->position[i];
        sum += height ? (double)p.y : (double)vec3_length(p);
    }
    points_free(points);
    return sum / n;
}

static void densities_follow_gradients(void **state)
{
    (void)state;
    Envelope *ball = make_shape(SHAPE_SPHERE, vec3(0, 0, 0), transform_identity());
    Envelope *box = make_shape(SHAPE_BOX, vec3(1, 1, 1), transform_identity());
    ScatterParams even = scatter_params_default(), p = even;
    // radii in a ball: density r^2 has mean 3/4; times r^4 (the shell) 7/8; times 2 r 4/5
    assert_true(fabs(mean_of(ball, even, false) - 0.75) < 0.004);
    p.shell = 1.0f;
    assert_true(fabs(mean_of(ball, p, false) - 0.875) < 0.004);
    p.shell = 0.3f;
    assert_true(fabs(mean_of(ball, p, false) - (0.7 * 0.75 + 0.3 * 0.875)) < 0.004);
    p.pattern = SCATTER_POISSON;
    assert_true(fabs(mean_of(ball, p, false) - (0.7 * 0.75 + 0.3 * 0.875)) < 0.01);
    p = even;
    p.depth_gradient = 1.0f;
    assert_true(fabs(mean_of(ball, p, false) - 0.8) < 0.004);
    // heights -1..1 with density 1 + g y have mean g / 3
    p = even;
    assert_true(fabs(mean_of(box, p, true)) < 0.01);
    p.gradient = 1.0f;
    assert_true(fabs(mean_of(box, p, true) - 1.0 / 3.0) < 0.01);
    p.gradient = -0.5f;
    assert_true(fabs(mean_of(box, p, true) + 0.5 / 3.0) < 0.01);
    envelope_free(ball);
    envelope_free(box);
}

// A box of 2 x 2 x 0.2 faces +z with 4 m^2 of its 9.6.
static void points_lie_where_the_surface_faces(void **state)
{
    (void)state;
    Envelope *box = make_shape(SHAPE_BOX, vec3(1, 1, 0.1f), transform_identity());
    ScatterParams params = scatter_params_default();
    params.place = SCATTER_SURFACE;
    params.facing = vec3(0, 0.5f, 3);
    for (int way = 0; way < 3; way++) { // random, evenly spaced, anchored
        params.pattern = way == 1 ? SCATTER_POISSON : SCATTER_RANDOM;
        params.anchored = way == 2;
        PointSet *points = scatter(box, &params, 1 + way);
        assert_true(points->count > 850 && points->count < 1150);
        for (int64_t i = 0; i < points->count; i++) {
            assert_float_equal(points->position[i].z, 0.1f, way == 2 ? 0.01f : 1e-5f);
            assert_true(points->normal[i].z > 0.5f);
        }
        if (way < 2) { // that of anchored points follows from their lattice
            assert_true(fabs(points->measure - 4.0) < 0.08);
        }
        points_free(points);
    }
    params = scatter_params_default(); // a volume has no sides
    params.facing = vec3(0, 0, 1);
    PointSet *inside = scatter(box, &params, 1);
    assert_true(fabs(inside->measure - 0.8) < 1e-4);
    points_free(inside);
    envelope_free(box);
}

// The depth of a level set is solved for: the same ball, made of two, must act like a ball.
static void depth_is_known_beyond_the_band(void **state)
{
    (void)state;
    Shape shapes[2] = {{.kind = SHAPE_SPHERE, .transform = transform_identity()},
                       {.kind = SHAPE_SPHERE, .transform = transform_identity()}};
    EnvelopeParams list = {.shapes = shapes, .shape_count = 2, .voxel = 0.03f};
    Run run = run_default();
    Envelope *ball = envelope_new(&list, &run, NULL);
    assert_non_null(ball);
    assert_true(isfinite(envelope_band(ball)));
    ScatterParams p = scatter_params_default();
    p.depth_gradient = 1.0f;
    assert_true(fabs(mean_of(ball, p, false) - 0.8) < 0.01);
    p.depth_gradient = -1.0f; // density 2 - 2 r
    assert_true(fabs(mean_of(ball, p, false) - 0.6) < 0.01);
    envelope_free(ball);
}

static void scale_shrinks_the_region(void **state)
{
    (void)state;
    Transform moved = transform_compose(vec3(5, 0, 0), vec3(0, 0, 0), vec3(1, 1, 1));
    Envelope *ball = make_shape(SHAPE_SPHERE, vec3(0, 0, 0), moved);
    ScatterParams params = scatter_params_default();
    params.scale = 0.5f;
    PointSet *points = scatter(ball, &params, 1);
    for (int64_t i = 0; i < points->count; i++) {
        assert_true(vec3_distance(points->position[i], vec3(5, 0, 0)) < 0.5001f);
    }
    assert_true(fabs(points->measure - 4.18879 / 8.0) < 1e-4);
    points_free(points);
    params.scale_about_center = true;
    params.scale_center = vec3(0, 0, 0);
    points = scatter(ball, &params, 1);
    for (int64_t i = 0; i < points->count; i++) {
        assert_true(vec3_distance(points->position[i], vec3(2.5f, 0, 0)) < 0.5001f);
    }
    points_free(points);
    envelope_free(ball);
}

static void refuses_absurd_params(void **state)
{
    (void)state;
    Envelope *ball = make_shape(SHAPE_SPHERE, vec3(0, 0, 0), transform_identity());
    ScatterParams d = scatter_params_default(), list[7] = {d, d, d, d, d, d, d};
    list[0].count = 1000000000000;
    list[1].count = 0;
    list[2].scale = -1.0f;
    list[3].shell = 1.5f;
    list[4].gradient = NAN;
    list[5].depth_gradient = -2.0f;
    list[6].count = (int64_t)INT32_MAX + 1;
    static const char *const messages[7] = {"1000000000000 points; at most 2147483647 are possible",
                                            "0 points; at least one is needed",
                                            "scale is -1; it must be positive",
                                            "shell is 1.5; it must lie between 0 and 1",
                                            "gradient is nan; it must lie between -1 and 1",
                                            "depth_gradient is -2; it must lie between -1 and 1",
                                            "2147483648 points; at most 2147483647 are possible"};
    for (int i = 0; i < 7; i++) {
        Error e = {0};
        Run run = run_default();
        assert_null(points_scatter(ball, &list[i], &run, &e));
        assert_int_equal(e.code, ERROR_INPUT);
        assert_string_equal(e.message, messages[i]);
    }
    envelope_free(ball);
}

static void can_be_cancelled(void **state)
{
    (void)state;
    Envelope *ball = make_shape(SHAPE_SPHERE, vec3(0, 0, 0), transform_identity());
    ScatterParams params = scatter_params_default();
    const volatile int yes = 1;
    Run run = {.threads = 1, .cancelled = &yes};
    Error e = {0};
    params.count = 100000000;
    assert_null(points_scatter(ball, &params, &run, &e));
    assert_int_equal(e.code, ERROR_CANCELLED);
    envelope_free(ball);
}

static void adds_by_hand(void **state)
{
    (void)state;
    PointSet *points = points_new(NULL);
    assert_non_null(points);
    assert_true(points_spacing(points) == 0.0);
    for (int i = 0; i < 1000; i++) {
        assert_true(points_add(points, vec3((float)i, 0, 0), vec3(0, 1, 0), (uint64_t)i, NULL));
    }
    points->measure = 8000.0;
    assert_true(fabs(points_spacing(points) - 2.0) < 1e-12);
    points->dimension = 2;
    assert_true(fabs(points_spacing(points) - sqrt(8.0)) < 1e-12);
    assert_true(points->position[999].x == 999.0f && points->id[999] == 999);
    points_free(points);
    points_free(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(surface_is_uniform_by_area),
        cmocka_unit_test(volume_is_filled_exactly),
        cmocka_unit_test(poisson_keeps_its_distance),
        cmocka_unit_test(same_for_any_threads),
        cmocka_unit_test(moved_envelope_keeps_ids),
        cmocka_unit_test(densities_follow_gradients),
        cmocka_unit_test(scale_shrinks_the_region),
        cmocka_unit_test(refuses_absurd_params),
        cmocka_unit_test(adds_by_hand),
        cmocka_unit_test(can_be_cancelled),
        cmocka_unit_test(points_lie_where_the_surface_faces),
        cmocka_unit_test(depth_is_known_beyond_the_band),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
