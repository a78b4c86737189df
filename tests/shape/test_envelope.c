// Envelopes against closed forms, each other and brute force.
#include "base/memory.h"
#include "base/random.h"
#include "shape/depth_field.h"
#include "shape/envelope.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define PI_D 3.14159265358979323846

static Envelope *make_voxels(const Shape *shapes, int count, float voxel)
{
    EnvelopeParams params = {.shapes = shapes, .shape_count = count, .voxel = voxel};
    Run run = run_default();
    Error e = {0};
    Envelope *envelope = envelope_new(&params, &run, &e);
    assert_string_equal(e.message, "");
    assert_non_null(envelope);
    return envelope;
}

static Envelope *make(const Shape *shapes, int count)
{
    return make_voxels(shapes, count, 0.0f);
}

static Shape shape_of(ShapeKind kind, ShapeOp op, Vec3 size, Vec3 at)
{
    return (Shape){.kind = kind,
                   .op = op,
                   .size = size,
                   .transform = transform_compose(at, vec3(0, 0, 0), vec3(1, 1, 1))};
}

static bool near_to(double a, double b, double relative)
{
    return fabs(a - b) <= relative * fabs(b);
}

static Vec3 random_point(Aabb box, uint64_t n)
{
    Vec3 size = vec3_sub(box.high, box.low), low = vec3_madd(box.low, -0.2f, size);
    uint64_t key = random_key(7, n);
    return vec3_add(low, vec3(1.4f * size.x * random_unit(random_key(key, 1)),
                              1.4f * size.y * random_unit(random_key(key, 2)),
                              1.4f * size.z * random_unit(random_key(key, 3))));
}

static float triangle_distance(Vec3 p, Vec3 a, Vec3 b, Vec3 c)
{
    // the plane where the foot lies within, else the nearest of the edges
    Vec3 n = vec3_cross(vec3_sub(b, a), vec3_sub(c, a)), corner[4] = {a, b, c, a};
    float best = INFINITY, sides = 0.0f;
    for (int i = 0; i < 3; i++) {
        Vec3 edge = vec3_sub(corner[i + 1], corner[i]), to = vec3_sub(p, corner[i]);
        float t = clampf(vec3_dot(edge, to) / vec3_dot(edge, edge), 0.0f, 1.0f);
        best = fminf(best, vec3_distance(to, vec3_scale(edge, t)));
        sides += vec3_dot(vec3_cross(edge, to), n) >= 0.0f ? 1.0f : 0.0f;
    }
    return sides == 3.0f ? fabsf(vec3_dot(vec3_sub(p, a), vec3_normalize(n))) : best;
}

// Distance to a surface and winding number (van Oosterom & Strackee 1983), by brute force.
static float brute_distance(const Mesh *mesh, Vec3 p, double *winding)
{
    float best = INFINITY;
    double angle = 0.0;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        Vec3 v[3];
        for (int k = 0; k < 3; k++) {
            v[k] = mesh->position[mesh->index[3 * f + k]];
        }
        best = fminf(best, triangle_distance(p, v[0], v[1], v[2]));
        Vec3 a = vec3_sub(v[0], p), b = vec3_sub(v[1], p), c = vec3_sub(v[2], p);
        double la = (double)vec3_length(a), lb = (double)vec3_length(b),
               lc = (double)vec3_length(c);
        angle += 2.0 * atan2((double)vec3_dot(a, vec3_cross(b, c)),
                             la * lb * lc + (double)vec3_dot(a, b) * lc +
                                 (double)vec3_dot(b, c) * la + (double)vec3_dot(c, a) * lb);
    }
    *winding = angle / (4.0 * PI_D);
    return best;
}

static void primitives_have_closed_forms(void **state)
{
    (void)state;
    Transform id = transform_identity();
    Transform turned = transform_compose(vec3(1, 2, 3), vec3(20, 30, 40), vec3(2, 2, 2));
    const struct {
        ShapeKind kind;
        Vec3 size;
        Transform transform;
        double volume, area;
    } cases[] = {
        {SHAPE_SPHERE, {0, 0, 0}, id, 4.0 / 3.0 * PI_D, 4.0 * PI_D},
        {SHAPE_SPHERE, {0, 0, 0}, turned, 32.0 / 3.0 * PI_D, 16.0 * PI_D},
        {SHAPE_BOX, {1, 2, 3}, turned, 8.0 * 48.0, 4.0 * 88.0},
        {SHAPE_CONE, {3, 4, 0}, id, 12.0 * PI_D, 24.0 * PI_D},
        {SHAPE_CONE, {4, 4, 1}, id, 28.0 * PI_D, (16.0 + 1.0 + 25.0) * PI_D},
        {SHAPE_CAPSULE, {1, 2, 0}, id, 10.0 / 3.0 * PI_D, 8.0 * PI_D},
        // an oblate spheroid: 2 pi a^2 (1 + (1 - e^2) / e artanh e), e^2 = 1 - 1 / 4
        {SHAPE_ELLIPSOID, {2, 1, 2}, id, 16.0 / 3.0 * PI_D, 34.6875288},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        Shape shape = {
            .kind = cases[i].kind, .size = cases[i].size, .transform = cases[i].transform};
        Envelope *envelope = make(&shape, 1);
        assert_true(near_to(envelope_volume(envelope), cases[i].volume, 1e-6));
        assert_true(near_to(envelope_area(envelope), cases[i].area, 1e-6));
        assert_true(isinf(envelope_band(envelope)));
        envelope_free(envelope);
    }
}

// Distances of turned and stretched primitives against their own fine surface.
static void distances_match_the_surface(void **state)
{
    (void)state;
    Transform rigid = transform_compose(vec3(1, 2, 3), vec3(20, 30, 40), vec3(1.5f, 1.5f, 1.5f));
    Transform stretch = transform_compose(vec3(1, 2, 3), vec3(20, 30, 40), vec3(1, 2, 0.5f));
    for (int k = 0; k < 10; k++) {
        static const ShapeKind kinds[5] = {SHAPE_SPHERE, SHAPE_ELLIPSOID, SHAPE_BOX, SHAPE_CONE,
                                           SHAPE_CAPSULE};
        Shape shape = {.kind = kinds[k % 5],
                       .size = vec3(1, 1.5f, 0.4f),
                       .transform = k < 5 ? rigid : stretch};
        bool exact = k < 8; // stretched spheres, ellipsoids and boxes are exact too
        Envelope *envelope = make(&shape, 1);
        const Mesh *mesh = envelope_surface(envelope);
        for (uint64_t i = 0; i < 60; i++) {
            Vec3 p = random_point(envelope_bounds(envelope), i);
            double winding;
            float expected = brute_distance(mesh, p, &winding);
            float distance = envelope_distance(envelope, p);
            assert_true(envelope_contains(envelope, p) == (distance < 0.0f));
            if (expected > 0.01f) {
                assert_true((winding > 0.5) == (distance < 0.0f));
            }
            if (exact) {
                assert_true(fabsf(fabsf(distance) - expected) < 0.003f);
            } else {
                assert_true(fabsf(distance) > 0.3f * expected - 0.01f);
                assert_true(fabsf(distance) < 3.0f * expected + 0.01f);
            }
        }
        envelope_free(envelope);
    }
}

static void surfaces_face_outward(void **state)
{
    (void)state;
    static const ShapeKind kinds[5] = {SHAPE_SPHERE, SHAPE_ELLIPSOID, SHAPE_BOX, SHAPE_CONE,
                                       SHAPE_CAPSULE};
    for (int k = 0; k < 6; k++) {
        Shape shape = shape_of(kinds[k % 5], SHAPE_UNION, vec3(1, 1.5f, 0.4f), vec3(0, 0, 0));
        shape.transform.m[0][0] = k & 1 ? -1.0f : 1.0f; // mirrored too
        Shape list[2] = {shape, shape};
        Envelope *envelope = make(list, k == 5 ? 2 : 1); // the last one a level set
        const Mesh *mesh = envelope_surface(envelope);
        double volume = 0.0;
        for (int64_t f = 0; f < mesh->face_count; f++) {
            const uint32_t *c = mesh->index + 3 * f;
            Vec3 a = mesh->position[c[0]], b = mesh->position[c[1]], d = mesh->position[c[2]];
            Vec3 across = vec3_cross(vec3_sub(b, a), vec3_sub(d, a));
            volume += (double)vec3_dot(a, across) / 6.0;
            Vec3 mean =
                vec3_add(mesh->normal[c[0]], vec3_add(mesh->normal[c[1]], mesh->normal[c[2]]));
            assert_true(vec3_dot(across, mean) > 0.0f || vec3_length(across) < 1e-7f);
        }
        assert_true(near_to(volume, envelope_volume(envelope), 0.002));
        envelope_free(envelope);
    }
}

// Every operation agrees with the same operation on the single shapes, away from the surface.
static void operations_mean_what_they_say(void **state)
{
    (void)state;
    for (int op = 0; op < 6; op++) {
        Shape shapes[2] = {shape_of(SHAPE_BOX, SHAPE_UNION, vec3(1, 1, 1), vec3(0, 0, 0)),
                           shape_of(op < 3 ? SHAPE_SPHERE : SHAPE_CONE, (ShapeOp)(op % 3),
                                    vec3(0.8f, 1.5f, 0.2f), vec3(0.7f, 0.3f, 0.2f))};
        Shape alone = shapes[1];
        alone.op = SHAPE_UNION;
        Envelope *all = make_voxels(shapes, 2, 0.03f);
        Envelope *a = make(&shapes[0], 1), *b = make(&alone, 1);
        int tested = 0;
        for (uint64_t i = 0; i < 20000; i++) {
            Vec3 p = random_point(envelope_bounds(a), i);
            float da = envelope_distance(a, p), db = envelope_distance(b, p);
            if (fminf(fabsf(da), fabsf(db)) > 0.03f) { // a voxel
                bool in = op % 3 == 0 ? da < 0 || db < 0 : (da < 0 && (db < 0) == (op % 3 == 2));
                assert_true(envelope_contains(all, p) == in);
                tested++;
            }
        }
        assert_true(tested > 10000);
        envelope_free(all);
        envelope_free(a);
        envelope_free(b);
    }
}

static void level_sets_measure_well(void **state)
{
    (void)state;
    Shape apart[2] = {shape_of(SHAPE_SPHERE, SHAPE_UNION, vec3(0, 0, 0), vec3(-1.2f, 0, 0)),
                      shape_of(SHAPE_SPHERE, SHAPE_UNION, vec3(0, 0, 0), vec3(1.2f, 0, 0))};
    Envelope *two = make(apart, 2);
    assert_true(near_to(envelope_volume(two), 8.0 / 3.0 * PI_D, 0.01));
    assert_true(near_to(envelope_area(two), 8.0 * PI_D, 0.02));
    envelope_free(two);
    // half a ball is left whichever way the half space is said to cut
    for (int k = 0; k < 2; k++) {
        Shape cut[2] = {shape_of(SHAPE_SPHERE, SHAPE_UNION, vec3(0, 0, 0), vec3(0, 0, 0)),
                        shape_of(SHAPE_HALF_SPACE, k ? SHAPE_INTERSECTION : SHAPE_DIFFERENCE,
                                 vec3(0, 0, 0), vec3(0, 0.5f, 0))};
        Envelope *ball = make(cut, 2);
        double cap = PI_D * 0.25 * (3.0 - 0.5) / 3.0; // of height 1/2
        double volume = k ? 4.0 / 3.0 * PI_D - cap : cap;
        assert_true(near_to(envelope_volume(ball), volume, 0.02));
        assert_true(envelope_contains(ball, vec3(0, 0.7f, 0)) == !k);
        assert_true(envelope_contains(ball, vec3(0, 0.3f, 0)) == (k == 1));
        Aabb box = envelope_bounds(ball);
        assert_true(fabsf((k ? box.high.y : box.low.y) - 0.5f) < 0.03f);
        envelope_free(ball);
    }
}

// A star of eight spikes: reentrant edges, and thin tips. Written as OBJ.
static void write_star(const char *path)
{
    FILE *stream = fopen(path, "w");
    assert_non_null(stream);
    for (int i = 0; i < 16; i++) {
        double r = i & 1 ? 0.5 : 1.5, a = 2.0 * PI_D * i / 16;
        fprintf(stream, "v %.9g %.9g 0\n", r * cos(a), r * sin(a));
    }
    fprintf(stream, "v 0 0 0.4\nv 0 0 -0.4\n");
    for (int i = 0; i < 16; i++) {
        int next = (i + 1) % 16 + 1;
        fprintf(stream, "f %d %d 17\nf %d %d 18\n", i + 1, next, next, i + 1);
    }
    fclose(stream);
}

static void mesh_level_set_lies_in_the_mesh(void **state)
{
    (void)state;
    char path[] = "/tmp/ramify_star_XXXXXX.obj";
    int file = mkstemps(path, 4);
    assert_true(file >= 0);
    write_star(path);
    Shape shape = {.kind = SHAPE_MESH,
                   .file = path,
                   .transform = transform_compose(vec3(9, 0, 0), vec3(10, 20, 30), vec3(1, 1, 2))};
    Envelope *star = make(&shape, 1);
    remove(path);
    const Mesh *mesh = envelope_surface(star);
    assert_int_equal(mesh->face_count, 32);
    double base = 16.0 * 0.5 * 1.5 * 0.5 * sin(PI_D / 8.0);
    assert_true(near_to(envelope_volume(star), 2.0 * base * 0.8 / 3.0, 1e-5));
    float voxel = envelope_band(star) / 3.0f;
    int inside = 0, strays = 0;
    for (uint64_t i = 0; i < 30000; i++) {
        double winding;
        Vec3 p = random_point(envelope_bounds(star), i);
        float d = envelope_distance(star, p), expected = brute_distance(mesh, p, &winding);
        inside += d < 0.0f;
        if ((d < 0.0f) != (winding > 0.5)) {
            assert_true(expected < 0.5f * voxel);
            strays++;
        }
        if (expected < 2.0f * voxel) {
            assert_true(fabsf(fabsf(d) - expected) < 0.5f * voxel);
        }
    }
    assert_true(inside > 1000 && strays < inside / 40);
    envelope_free(star);
}

static void refuses_what_is_no_envelope(void **state)
{
    (void)state;
    Vec3 o = vec3(0, 0, 0), one = vec3(1, 1, 1);
    Shape half = shape_of(SHAPE_HALF_SPACE, SHAPE_UNION, o, o);
    Shape box = shape_of(SHAPE_BOX, SHAPE_UNION, one, o);
    Shape ball = shape_of(SHAPE_SPHERE, SHAPE_DIFFERENCE, o, o);
    Shape thin = shape_of(SHAPE_BOX, SHAPE_UNION, vec3(1, -1, 1), o);
    Shape cone = shape_of(SHAPE_CONE, SHAPE_UNION, vec3(0, 1, 0), o);
    Shape capsule = shape_of(SHAPE_CAPSULE, SHAPE_UNION, vec3(NAN, 1, 0), o);
    Shape flat = box, all = shape_of(SHAPE_BOX, SHAPE_DIFFERENCE, vec3(2, 2, 2), o);
    flat.transform.m[1][1] = 0.0f;
    const struct {
        Shape shapes[2];
        int count;
        float voxel;
        const char *message;
    } cases[] = {
        {{box}, 0, 0, "the envelope has no shapes; it needs at least one"},
        {{half},
         1,
         0,
         "shape 1: a half space is unbounded and can only cut; put it after another shape, as an "
         "intersection or a difference"},
        {{box, half},
         2,
         0,
         "shape 2: a half space is unbounded and can only cut; put it after another shape, as an "
         "intersection or a difference"},
        {{ball, box},
         2,
         0,
         "shape 1: there is no shape to cut yet; the first shape of the list must be a union"},
        {{thin}, 1, 0, "shape 1 (box): box of half-axes 1, -1, 1 m; all must be positive"},
        {{cone},
         1,
         0,
         "shape 1 (cone): cone of radii 0 and 0 m and height 1 m; the height and at least one "
         "radius must be positive, none negative"},
        {{box, capsule},
         2,
         0,
         "shape 2 (capsule): capsule of radius nan m and length 1 m; the radius must be positive, "
         "the length not negative"},
        {{flat},
         1,
         0,
         "shape 1 (box): the transform flattens the shape or is not finite; every scale must be a "
         "number other than 0"},
        {{box, ball},
         2,
         -1,
         "voxel is -1 m; it must be positive, or 0 for 1/128 of the largest "
         "extent"},
        {{box, ball},
         2,
         1e-6f,
         "shape 1 (box): voxel 1e-06 m makes a level set of 2000000 voxels across; at most 1024 "
         "are possible: set voxel to 0.00195313 or more"},
        {{box, ball},
         2,
         1,
         "voxel 1 m is too coarse for an envelope of 2 m; set voxel to 0.25 or less, or to 0 for "
         "1/128 of the extent"},
        {{box, all},
         2,
         0,
         "the envelope is empty: its cuts leave nothing of it; make the cutting shapes smaller or "
         "move them"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        EnvelopeParams params = {
            .shapes = cases[i].shapes, .shape_count = cases[i].count, .voxel = cases[i].voxel};
        Run run = run_default();
        Error e = {0};
        assert_null(envelope_new(&params, &run, &e));
        assert_int_equal(e.code, ERROR_INPUT);
        assert_string_equal(e.message, cases[i].message);
    }
}

// In the corner between two planes at right angles a blend of k fills up to k / 4 from either, and
// takes as much away where one is cut off the other; k away from it nothing changes.
static void edges_flow_over_a_blend(void **state)
{
    (void)state;
    const float k = 0.4f;
    Shape floor = shape_of(SHAPE_BOX, SHAPE_UNION, vec3(2, 0.5f, 2), vec3(0, -0.5f, 0));
    Shape wall = shape_of(SHAPE_BOX, SHAPE_UNION, vec3(0.5f, 1, 2), vec3(-0.5f, 0, 0));
    Shape sharp[2] = {floor, wall}, round[2] = {floor, wall}, cut[2] = {floor, wall};
    round[1].blend = cut[1].blend = k;
    cut[1].op = SHAPE_DIFFERENCE; // leaves the edge at x = 0, y = 0
    Envelope *plain = make_voxels(sharp, 2, 0.01f), *filled = make_voxels(round, 2, 0.01f);
    Envelope *worn = make_voxels(cut, 2, 0.01f);
    const Vec3 corner = vec3(0.25f * k, 0.25f * k, 0), edge = vec3(0.25f * k, -0.25f * k, 0);
    assert_true(fabsf(envelope_distance(filled, corner)) < 1e-4f);
    assert_true(fabsf(envelope_distance(worn, edge)) < 1e-4f);
    assert_true(envelope_distance(plain, corner) >= 0.029f);
    for (float way = k; way < 0.9f; way += 0.1f) {
        assert_true(fabsf(envelope_distance(filled, vec3(0, way, 0.3f))) < 1e-5f);
        assert_true(fabsf(envelope_distance(filled, vec3(way, 0, 0.3f))) < 1e-5f);
        assert_true(fabsf(envelope_distance(worn, vec3(way, 0, 0.3f))) < 1e-5f);
    }
    envelope_free(plain);
    envelope_free(filled);
    envelope_free(worn);

    // what lies upon each other swells, and still fits into the level set
    Shape same[2] = {shape_of(SHAPE_SPHERE, SHAPE_UNION, vec3(1, 1, 1), vec3(0, 0, 0))};
    same[1] = same[0];
    same[1].blend = k;
    Envelope *swollen = make_voxels(same, 2, 0.02f);
    double radius = 1.0 + 0.25 * (double)k;
    assert_true(near_to(envelope_volume(swollen), 4.0 / 3.0 * PI_D * pow(radius, 3.0), 2e-3));
    envelope_free(swollen);
}

static void refuses_blends_that_it_cannot_make(void **state)
{
    (void)state;
    Shape shapes[2] = {shape_of(SHAPE_SPHERE, SHAPE_UNION, vec3(1, 1, 1), vec3(0, 0, 0)),
                       shape_of(SHAPE_SPHERE, SHAPE_UNION, vec3(1, 1, 1), vec3(1, 0, 0))};
    EnvelopeParams params = {.shapes = shapes, .shape_count = 2};
    Run run = run_default();
    Error e = {0};
    shapes[0].blend = 0.1f;
    assert_null(envelope_new(&params, &run, &e));
    assert_non_null(strstr(e.message, "no shape comes before it"));
}

// Of two boxes that overlap and make one: a level set, whose own distances end a few voxels deep.
static void depth_is_known_everywhere_and_made_once(void **state)
{
    (void)state;
    Shape halves[2] = {
        shape_of(SHAPE_BOX, SHAPE_UNION, vec3(0.75f, 0.6f, 0.7f), vec3(-0.25f, 0, 0)),
        shape_of(SHAPE_BOX, SHAPE_UNION, vec3(0.75f, 0.6f, 0.7f), vec3(0.25f, 0, 0))};
    Envelope *box = make(halves, 2);
    const DepthField *made[8] = {NULL};
#pragma omp parallel for num_threads(4)
    for (int i = 0; i < 8; i++) {
        made[i] = envelope_depth(box, NULL);
    }
    for (int i = 0; i < 8; i++) {
        assert_non_null(made[i]);
        assert_ptr_equal(made[i], made[0]);
    }
    float cell = made[0]->spacing;
    assert_true(fabsf(made[0]->deepest - 0.6f) < 1.5f * cell);
    for (uint64_t n = 0; n < 200; n++) {
        Vec3 p = random_point((Aabb){vec3(-1, -0.6f, -0.7f), vec3(1, 0.6f, 0.7f)}, n);
        float depth = fminf(1.0f - fabsf(p.x), fminf(0.6f - fabsf(p.y), 0.7f - fabsf(p.z)));
        float found = made[0]->deepest * depth_field_at(made[0], p);
        assert_true(fabsf(found - fmaxf(depth, 0.0f)) < 1.5f * cell);
    }
    envelope_free(box);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(primitives_have_closed_forms),
        cmocka_unit_test(distances_match_the_surface),
        cmocka_unit_test(surfaces_face_outward),
        cmocka_unit_test(operations_mean_what_they_say),
        cmocka_unit_test(level_sets_measure_well),
        cmocka_unit_test(mesh_level_set_lies_in_the_mesh),
        cmocka_unit_test(refuses_what_is_no_envelope),
        cmocka_unit_test(edges_flow_over_a_blend),
        cmocka_unit_test(refuses_blends_that_it_cannot_make),
        cmocka_unit_test(depth_is_known_everywhere_and_made_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
