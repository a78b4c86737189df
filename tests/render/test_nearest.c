// The nearest surface, against brute force and closed forms.
#include "base/memory.h"
#include "base/random.h"
#include "render/accel/nearest.h"

#include "testing.h"

// A box of quads about the origin, half extents h, outward.
static Mesh *box(Vec3 h)
{
    static const uint32_t index[24] = {0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1,
                                       2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3};
    Mesh *mesh = mesh_new(4, 8, 6, 0, NULL);
    for (int i = 0; i < 8; i++) {
        mesh->position[i] = vec3(i & 4 ? h.x : -h.x, i & 2 ? h.y : -h.y, i & 1 ? h.z : -h.z);
    }
    memcpy(mesh->index, index, sizeof index);
    return mesh;
}

static Nearest *nearest_of(Part part)
{
    Geometry geometry = {0};
    Error e = {0};
    assert_true(geometry_add(&geometry, part, &e));
    Run run = run_default();
    Nearest *nearest = nearest_new(&geometry, &run, &e);
    assert_non_null(nearest);
    geometry_clear(&geometry);
    return nearest;
}

static Vec3 random_point(uint64_t i, float size)
{
    uint64_t key = random_key(5, i);
    return vec3(random_range(random_key(key, 0), -size, size),
                random_range(random_key(key, 1), -size, size),
                random_range(random_key(key, 2), -size, size));
}

static float box_distance(Vec3 p, Vec3 h)
{
    Vec3 d = vec3(fabsf(p.x) - h.x, fabsf(p.y) - h.y, fabsf(p.z) - h.z);
    Vec3 out = vec3(fmaxf(d.x, 0), fmaxf(d.y, 0), fmaxf(d.z, 0));
    return vec3_length(out) + fminf(fmaxf(d.x, fmaxf(d.y, d.z)), 0.0f);
}

static void box_as_in_closed_form(void **state)
{
    (void)state;
    Vec3 h = vec3(1.0f, 0.5f, 0.75f);
    Nearest *nearest = nearest_of((Part){.kind = PART_MESH, .mesh = box(h)});
    for (uint64_t i = 0; i < 5000; i++) {
        Vec3 p = random_point(i, 2.0f), away;
        float wanted = box_distance(p, h);
        float d = nearest_distance(nearest, p, 10.0f, &away);
        assert_float_equal(d, wanted, 1e-5f);
        Vec3 on = p, normal;
        nearest_point(nearest, &on, &normal);
        assert_float_equal(vec3_distance(on, p), fabsf(wanted), 1e-5f);
        assert_float_equal(box_distance(on, h), 0.0f, 1e-6f);
        assert_float_equal(box_distance(vec3_madd(on, 0.1f, normal), h), 0.1f, 1e-5f);
        if (fabsf(wanted) > 0.01f) { // `away` is the way the distance grows
            float further = nearest_distance(nearest, vec3_madd(p, 0.005f, away), 10.0f, &away);
            assert_true(further > d + 0.003f || wanted < 0.0f);
        }
        float near = nearest_distance(nearest, p, 0.25f, &away);
        assert_float_equal(near, clampf(wanted, -0.25f, 0.25f), 1e-5f);
    }
    nearest_free(nearest);
}

static void curves_as_by_brute_force(void **state)
{
    (void)state;
    enum { CURVES = 200, POINTS = 3 };
    CurveSet *curves = curves_new(CURVES * POINTS, CURVES, NULL);
    for (int i = 0; i < CURVES * POINTS; i++) {
        curves->position[i] = random_point((uint64_t)(7000 + i), 1.0f);
        curves->radius[i] = random_range(random_key(9, (uint64_t)i), 0.001f, 0.05f);
    }
    for (int c = 0; c <= CURVES; c++) {
        curves->first[c] = c * POINTS;
    }
    CurveSet kept = *curves;
    Vec3 position[CURVES * POINTS];
    float radius[CURVES * POINTS];
    memcpy(position, kept.position, sizeof position);
    memcpy(radius, kept.radius, sizeof radius);
    Nearest *nearest = nearest_of((Part){.kind = PART_CURVES, .curves = curves});
    for (uint64_t q = 0; q < 1000; q++) {
        Vec3 p = random_point(q, 1.2f), away;
        float least = INFINITY;
        for (int i = 0; i < CURVES * POINTS; i++) {
            for (int k = 0; i % POINTS > 0 && k <= 400; k++) {
                float t = (float)k / 400.0f;
                Vec3 on = vec3_lerp(position[i - 1], position[i], t);
                least = fminf(least, vec3_distance(on, p) - lerpf(radius[i - 1], radius[i], t));
            }
        }
        assert_float_equal(nearest_distance(nearest, p, 10.0f, &away), least, 2e-3f);
        Vec3 on = p, normal;
        nearest_point(nearest, &on, &normal);
        assert_float_equal(vec3_distance(on, p), fabsf(least), 2e-3f);
        assert_float_equal(vec3_length(normal), 1.0f, 1e-5f);
    }
    nearest_free(nearest);
}

static void instances_and_nothing_are_no_surface(void **state)
{
    (void)state;
    Transform *one = memory_alloc(1, sizeof *one, NULL);
    *one = transform_identity();
    Nearest *nearest = nearest_of((Part){
        .kind = PART_MESH, .mesh = box(vec3(1, 1, 1)), .instance = one, .instance_count = 1});
    Vec3 away;
    assert_float_equal(nearest_distance(nearest, vec3(0, 2, 0), 5.0f, &away), 5.0f, 0);
    Vec3 p = vec3(0, 2, 0);
    nearest_point(nearest, &p, &away);
    assert_float_equal(p.y, 2.0f, 0);
    nearest_free(nearest);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(box_as_in_closed_form),
        cmocka_unit_test(curves_as_by_brute_force),
        cmocka_unit_test(instances_and_nothing_are_no_surface),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
