// The light that plants of a stand share: it does not depend on their order, and each takes the
// others' light.
#include "grow/light/stand.h"

#include "base/random.h"
#include "testing.h"

enum { LEAVES = 400, PLANTS = 3 };

#define CELL 0.4f
#define AREA 0.05f

// Leaves in a ball of radius 1 m about (x, 3, 0).
static void ball_of_leaves(Vec3 leaf[LEAVES], float x, uint64_t seed)
{
    for (uint64_t i = 0; i < LEAVES; i++) {
        uint64_t key = random_key(seed, i);
        float out = random_unit(random_key(key, 1));
        leaf[i] = vec3_madd(vec3(x, 3, 0), out, random_direction(random_key(key, 2)));
    }
}

// A stand of balls in a row, 1.5 m apart, given in this order.
static LightStand *row(const int order[PLANTS], int threads)
{
    LightStand *stand = light_stand_new(PLANTS, NULL);
    assert_non_null(stand);
    for (int i = 0; i < PLANTS; i++) {
        Vec3 leaf[LEAVES];
        ball_of_leaves(leaf, 1.5f * (float)order[i], (uint64_t)order[i]);
        assert_true(light_stand_give(stand, i, leaf, LEAVES, AREA, CELL, NULL));
    }
    assert_true(light_stand_solve(stand, threads, NULL));
    return stand;
}

static void neither_order_nor_threads_change_a_bit(void **state)
{
    (void)state;
    LightStand *one = row((const int[]){0, 1, 2}, 1), *other = row((const int[]){2, 0, 1}, 4);
    Vec3 leaf[LEAVES];
    for (int plant = 0; plant < PLANTS; plant++) {
        ball_of_leaves(leaf, 1.5f * (float)plant, (uint64_t)plant);
        for (int i = 0; i < LEAVES; i++) {
            float a = light_stand_light(one, leaf[i]), b = light_stand_light(other, leaf[i]);
            Vec3 p = light_stand_brightest(one, leaf[i]);
            Vec3 q = light_stand_brightest(other, leaf[i]);
            assert_memory_equal(&a, &b, sizeof a);
            assert_memory_equal(&p, &q, sizeof p);
        }
    }
    light_stand_free(one);
    light_stand_free(other);
}

static float mean_light(const LightStand *stand, int plant)
{
    Vec3 leaf[LEAVES];
    float sum = 0.0f;
    ball_of_leaves(leaf, 1.5f * (float)plant, (uint64_t)plant);
    for (int i = 0; i < LEAVES; i++) {
        sum += light_stand_light(stand, leaf[i]) / LEAVES;
    }
    return sum;
}

// The middle one of a row gets less than those at its ends, and more once they have lost their
// leaves.
static void each_takes_the_others_light(void **state)
{
    (void)state;
    LightStand *stand = row((const int[]){0, 1, 2}, 2);
    float end = mean_light(stand, 0), middle = mean_light(stand, 1);
    assert_true(middle < 0.95f * end);
    assert_true(light_stand_give(stand, 0, NULL, 0, AREA, CELL, NULL));
    assert_true(light_stand_give(stand, 2, NULL, 0, AREA, CELL, NULL));
    assert_true(light_stand_solve(stand, 2, NULL));
    assert_true(mean_light(stand, 1) > 1.05f * middle);
    light_stand_free(stand);
}

static void without_leaves_all_light_is_left(void **state)
{
    (void)state;
    LightStand *stand = light_stand_new(1, NULL);
    assert_true(light_stand_solve(stand, 1, NULL));
    assert_float_equal(light_stand_light(stand, vec3(0, 0, 0)), 1.0f, 1e-5f);
    light_stand_free(stand);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(neither_order_nor_threads_change_a_bit),
        cmocka_unit_test(each_takes_the_others_light),
        cmocka_unit_test(without_leaves_all_light_is_left),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
