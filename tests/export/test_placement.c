#include "testing.h"

#include "base/random.h"
#include "export/placement.h"

static Vec3 turned(const float q[4], Vec3 v)
{
    Vec3 axis = vec3(q[0], q[1], q[2]);
    Vec3 t = vec3_scale(vec3_cross(axis, v), 2.0f);
    return vec3_add(vec3_madd(v, q[3], t), vec3_cross(axis, t));
}

// The transform that a placement stands for.
static Vec3 place(const Placement *placement, Vec3 p)
{
    Vec3 v = turned(placement->rotation, vec3_mul(placement->scale, p));
    return vec3_add(v, placement->position);
}

static float draw(int i, int k)
{
    return 2.0f * random_unit(random_key((uint64_t)i, (uint64_t)k)) - 1.0f;
}

static void a_placement_moves_points_as_its_transform_does(void **state)
{
    (void)state;
    const Vec3 points[3] = {{1, 0, 0}, {0.3f, -2, 1}, {-1, 1, 4}};
    for (int i = 0; i < 20000; i++) {
        // many of them by half turns, where quaternions lose their last part
        float coarse = i % 3 == 0 ? 90.0f : 180.0f;
        Vec3 turn = i % 2 ? vec3(180 * draw(i, 0), 180 * draw(i, 1), 180 * draw(i, 2))
                          : vec3(coarse * roundf(2 * draw(i, 0)), coarse * roundf(2 * draw(i, 1)),
                                 coarse * roundf(2 * draw(i, 2)));
        Vec3 scale = vec3(expf(draw(i, 3)), expf(3 * draw(i, 4)), expf(draw(i, 5)));
        scale.z = i % 5 == 0 ? -scale.z : scale.z;
        scale.y = i % 7 == 0 ? -scale.y : scale.y;
        Transform t = transform_compose(vec3(draw(i, 6), 10 * draw(i, 7), draw(i, 8)), turn, scale);
        Placement placement;
        assert_true(placement_from_transform(&t, &placement));
        assert_true(placement.rotation[3] >= 0.0f);
        for (int k = 0; k < 3; k++) {
            Vec3 want = transform_point(&t, points[k]);
            assert_true(vec3_distance(place(&placement, points[k]), want) <
                        2e-5f * (1.0f + vec3_length(want)));
        }
    }
}

static void sheared_and_flat_transforms_have_none(void **state)
{
    (void)state;
    Placement placement;
    Transform sheared = {{{1, 0.01f, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    Transform flat = {{{1, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 1, 0}}};
    assert_false(placement_from_transform(&sheared, &placement));
    assert_false(placement_from_transform(&flat, &placement));
}

static void any_transform_is_a_placement_of_a_turned_thing(void **state)
{
    (void)state;
    const Vec3 points[3] = {{1, 0, 0}, {0.3f, -2, 1}, {-1, 1, 4}};
    for (int i = 0; i < 20000; i++) {
        Transform t = transform_identity();
        for (int k = 0; k < 12; k++) {
            t.m[k / 4][k % 4] = i % 3 == 0 ? roundf(2 * draw(i, k)) : draw(i, k);
        }
        Vec3 x = vec3(t.m[0][0], t.m[1][0], t.m[2][0]), y = vec3(t.m[0][1], t.m[1][1], t.m[2][1]);
        Vec3 z = vec3(t.m[0][2], t.m[1][2], t.m[2][2]);
        Placement placement;
        float turn[4];
        if (fabsf(vec3_dot(x, vec3_cross(y, z))) < 1e-3f) {
            continue;
        }
        assert_true(placement_of_turned(&t, turn, &placement));
        for (int k = 0; k < 3; k++) {
            Vec3 want = transform_point(&t, points[k]);
            assert_true(vec3_distance(place(&placement, turned(turn, points[k])), want) <
                        2e-5f * (1.0f + vec3_length(want)));
        }
    }
    Transform flat = {{{1, 1, 0, 0}, {1, 1, 0, 0}, {0, 0, 1, 0}}};
    Placement placement;
    float turn[4];
    assert_false(placement_of_turned(&flat, turn, &placement));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_placement_moves_points_as_its_transform_does),
        cmocka_unit_test(sheared_and_flat_transforms_have_none),
        cmocka_unit_test(any_transform_is_a_placement_of_a_turned_thing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
