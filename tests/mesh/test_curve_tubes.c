// Tubes from curves: closed, outward, as long and as thick as what the ray tracer sees.
#include "testing.h"

#include "base/random.h"
#include "mesh/curve_tubes.h"

#include <string.h>

static CurveSet *curve_of(const Vec3 *position, const float *radius, int64_t count)
{
    CurveSet *curves = curves_new(count, 1, NULL);
    assert_non_null(curves);
    memcpy(curves->position, position, sizeof *position * (size_t)count);
    memcpy(curves->radius, radius, sizeof *radius * (size_t)count);
    curves->first[1] = count;
    for (int64_t i = 1; i < count; i++) {
        curves->along[i] = curves->along[i - 1] + vec3_distance(position[i - 1], position[i]);
        curves->birth[i] = (float)i / (float)count;
    }
    return curves;
}

static double signed_volume(const Mesh *mesh)
{
    double volume = 0.0;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *c = mesh->index + 3 * f;
        volume += (double)vec3_dot(mesh->position[c[0]],
                                   vec3_cross(mesh->position[c[1]], mesh->position[c[2]])) /
                  6.0;
    }
    return volume;
}

static void assert_closed(const Mesh *mesh, int64_t tubes)
{
    MeshTopology topology;
    assert_true(mesh_topology(mesh, &topology, NULL));
    assert_int_equal(topology.open_edges, 0);
    assert_int_equal(topology.overused_edges, 0);
    assert_int_equal(topology.misoriented_edges, 0);
    assert_int_equal(topology.degenerate_faces, 0);
    assert_int_equal(topology.component_count, tubes);
    assert_int_equal(topology.euler_number, 2 * tubes);
}

static float distance_to_segment(Vec3 p, Vec3 a, Vec3 b)
{
    Vec3 ab = vec3_sub(b, a);
    float t = vec3_dot(vec3_sub(p, a), ab) / fmaxf(vec3_dot(ab, ab), 1e-20f);
    return vec3_distance(p, vec3_madd(a, clampf(t, 0.0f, 1.0f), ab));
}

static void a_straight_tube_has_the_volume_of_its_prism(void **state)
{
    (void)state;
    const Vec3 position[3] = {{1, 2, 3}, {1, 3, 3}, {1, 5, 3}};
    const float radius[3] = {0.2f, 0.2f, 0.2f};
    CurveSet *curves = curve_of(position, radius, 3);
    for (int sides = 3; sides <= CURVE_TUBE_SIDES_MOST; sides += 7) {
        Mesh *mesh = curve_tubes(curves, 0, 1, sides, NULL);
        assert_non_null(mesh);
        assert_closed(mesh, 1);
        double polygon = 0.5 * sides * 0.04 * sin(2.0 * M_PI / sides);
        double wanted = polygon * 3.0 + 2.0 * polygon * 0.2 / 3.0; // and two pyramids
        assert_true(fabs(signed_volume(mesh) - wanted) < 1e-4 * wanted);
        Aabb box = mesh_bounds(mesh);
        assert_float_equal(box.low.y, 1.8f, 1e-5f);
        assert_float_equal(box.high.y, 5.2f, 1e-5f);
        mesh_free(mesh);
    }
    curves_free(curves);
}

static void random_curves_are_closed_and_within_the_round_ones(void **state)
{
    (void)state;
    enum { POINTS = 9 };
    for (uint64_t number = 0; number < 300; number++) {
        uint64_t key = random_key(31, number);
        Vec3 position[POINTS];
        float radius[POINTS];
        Vec3 at = vec3_scale(random_direction(random_key(key, 1)), 3.0f), heading = {0, 1, 0};
        for (uint64_t i = 0; i < POINTS; i++) {
            heading = vec3_madd(heading, 0.7f, random_direction(random_key(key, 10 + i)));
            position[i] = at;
            radius[i] = random_range(random_key(key, 40 + i), 0.01f, 0.03f);
            at = vec3_madd(at, 0.2f, vec3_normalize(heading));
        }
        CurveSet *curves = curve_of(position, radius, POINTS);
        Mesh *mesh = curve_tubes(curves, 0, 1, 6, NULL);
        assert_non_null(mesh);
        assert_closed(mesh, 1);
        assert_true(signed_volume(mesh) > 0.0);
        for (int64_t v = 0; v < mesh->vertex_count; v++) {
            float nearest = INFINITY;
            for (int i = 0; i + 1 < POINTS; i++) {
                nearest = fminf(
                    nearest, distance_to_segment(mesh->position[v], position[i], position[i + 1]));
            }
            assert_true(nearest < 0.03f * 1.0001f + 1e-5f);
            assert_float_equal(vec3_length(mesh->normal[v]), 1.0f, 1e-5f);
        }
        mesh_free(mesh);
        curves_free(curves);
    }
}

static void assert_sound(const Mesh *mesh)
{
    assert_closed(mesh, 1);
    for (int64_t v = 0; v < mesh->vertex_count; v++) {
        assert_true(vec3_finite(mesh->position[v]) && vec3_finite(mesh->normal[v]));
    }
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *c = mesh->index + 3 * f;
        Vec3 a = mesh->position[c[0]];
        assert_true(vec3_length(vec3_cross(vec3_sub(mesh->position[c[1]], a),
                                           vec3_sub(mesh->position[c[2]], a))) > 0.0f);
    }
}

static void curves_that_turn_back_or_thin_out_stay_sound(void **state)
{
    (void)state;
    const Vec3 hairpin[4] = {{0, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 1, 0}};
    const float radius[4] = {0.1f, 0.1f, 0.05f, 0.0f}, none[4] = {0};
    const Vec3 twice[4] = {{0, 0, 0}, {0, 0, 0}, {0, 1, 0}, {0, 2, 0}};
    CurveSet *curves = curve_of(hairpin, radius, 4);
    Mesh *mesh = curve_tubes(curves, 0, 1, 5, NULL);
    assert_sound(mesh);
    mesh_free(mesh);
    curves_free(curves);
    curves = curve_of(twice, none, 4);
    mesh = curve_tubes(curves, 0, 1, 5, NULL);
    MeshTopology topology;
    assert_true(mesh_topology(mesh, &topology, NULL));
    assert_int_equal(topology.open_edges, 0);
    mesh_free(mesh);
    curves_free(curves);
    const Vec3 one_place[2] = {{1, 1, 1}, {1, 1, 1}};
    curves = curve_of(one_place, radius, 2);
    mesh = curve_tubes(curves, 0, 1, 5, NULL);
    assert_closed(mesh, 1);
    mesh_free(mesh);
    curves_free(curves);
}

static void texture_runs_around_without_a_seam(void **state)
{
    (void)state;
    const Vec3 position[2] = {{0, 0, 0}, {0, 4, 0}};
    const float radius[2] = {0.5f, 0.5f};
    CurveSet *curves = curve_of(position, radius, 2);
    Mesh *mesh = curve_tubes(curves, 0, 1, 8, NULL);
    float side = 2.0f * PI_F * 0.5f / 8.0f;
    for (int64_t f = 0; f < 16; f++) { // those between the rings
        const uint32_t *c = mesh->index + 3 * f;
        for (int k = 0; k < 3; k++) {
            float step = fabsf(mesh->uv[c[k]].x - mesh->uv[c[(k + 1) % 3]].x);
            assert_true(step < 1.001f * side);
        }
    }
    assert_float_equal(mesh->uv[mesh->vertex_count - 1].y, 4.0f, 1e-6f);
    assert_float_equal(mesh->birth[mesh->vertex_count - 1], 0.5f, 1e-6f);
    mesh_free(mesh);
    curves_free(curves);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_straight_tube_has_the_volume_of_its_prism),
        cmocka_unit_test(random_curves_are_closed_and_within_the_round_ones),
        cmocka_unit_test(curves_that_turn_back_or_thin_out_stay_sound),
        cmocka_unit_test(texture_runs_around_without_a_seam),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
