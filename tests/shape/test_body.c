// The standing human body as an envelope.
#include "base/random.h"
#include "shape/body.h"
#include "shape/envelope.h"
#include "testing.h"

#include <math.h>

static Shape body_shape(float height)
{
    return (Shape){
        .kind = SHAPE_BODY, .size = vec3(height, 1, 1), .transform = transform_identity()};
}

static void the_body_is_one_closed_surface_of_its_height(void **state)
{
    (void)state;
    Shape shape = body_shape(1.75f);
    EnvelopeParams params = {.shapes = &shape, .shape_count = 1, .voxel = 0.01f};
    Run run = run_default();
    Envelope *envelope = envelope_new(&params, &run, NULL);
    assert_non_null(envelope);
    MeshTopology topology;
    assert_true(mesh_topology(envelope_surface(envelope), &topology, NULL));
    assert_true(topology.open_edges == 0 && topology.overused_edges == 0 &&
                topology.misoriented_edges == 0);
    assert_int_equal(topology.component_count, 1);
    Aabb box = mesh_bounds(envelope_surface(envelope));
    assert_true(fabsf(box.high.y - box.low.y - 1.75f) < 0.03f);
    assert_true(fabsf(box.low.y) < 0.015f);
    // a man of 1.75 m has some 70 litres
    assert_true(envelope_volume(envelope) > 0.05 && envelope_volume(envelope) < 0.09);
    envelope_free(envelope);
}

static void head_hands_and_feet_are_where_they_should_be(void **state)
{
    (void)state;
    Shape shape = body_shape(2.0f);
    Body body;
    assert_true(body_new(&shape, &body, NULL));
    const Vec3 inside[] = {{0, 1.9f, 0},
                           {0, 1.4f, 0},
                           {0, 1.1f, 0},
                           {0.462f, 0.93f, 0.02f},
                           {-0.462f, 0.93f, 0.02f},
                           {0.12f, 0.6f, 0},
                           {-0.14f, 0.03f, 0.1f}};
    const Vec3 outside[] = {{0, 2.02f, 0}, {0, 0.5f, 0}, {0.22f, 1.2f, 0}, {0, 1.4f, 0.3f}};
    for (size_t i = 0; i < sizeof inside / sizeof inside[0]; i++) {
        assert_true(body_distance(&body, inside[i], NULL) < 0.0);
    }
    for (size_t i = 0; i < sizeof outside / sizeof outside[0]; i++) {
        assert_true(body_distance(&body, outside[i], NULL) > 0.0);
    }
    // seven and a half heads: the chin 1/7.5 of the height below the top
    assert_true(body_distance(&body, vec3(0, 2.0f - 2.0f / 7.5f + 0.01f, 0.06f), NULL) < 0.0);
    assert_true(body_distance(&body, vec3(0, 2.0f - 2.0f / 7.5f - 0.06f, 0.09f), NULL) > 0.0);
}

// What lets level sets skip what is far: within |distance| of a point the sign never changes.
static void distances_are_never_too_long(void **state)
{
    (void)state;
    Shape shape = body_shape(1.0f);
    shape.transform = transform_compose(vec3(1, 2, 3), vec3(20, 30, 40), vec3(1, 1.2f, 0.9f));
    Body body;
    assert_true(body_new(&shape, &body, NULL));
    Vec3 size = vec3_sub(body.bounds.high, body.bounds.low);
    for (uint64_t i = 0; i < 3000; i++) {
        uint64_t key = random_key(5, i);
        Vec3 u = vec3(random_unit(random_key(key, 1)), random_unit(random_key(key, 2)),
                      random_unit(random_key(key, 3)));
        Vec3 p = vec3_add(body.bounds.low, vec3_mul(size, u));
        double bound, distance = body_distance(&body, p, &bound);
        Vec3 q = vec3_madd(p, 0.999f * (float)bound, random_direction(random_key(key, 4)));
        double there = body_distance(&body, q, NULL);
        assert_true(bound > 0.0 && (there < 0.0) == (distance < 0.0));
    }
}

static void bodies_of_no_height_are_refused(void **state)
{
    (void)state;
    Shape shape = body_shape(0.0f);
    Body body;
    Error e = {0};
    assert_false(body_new(&shape, &body, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    shape = body_shape(1.0f);
    shape.transform.m[0][0] = 0.0f;
    assert_false(body_new(&shape, &body, &e));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_body_is_one_closed_surface_of_its_height),
        cmocka_unit_test(head_hands_and_feet_are_where_they_should_be),
        cmocka_unit_test(distances_are_never_too_long),
        cmocka_unit_test(bodies_of_no_height_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
