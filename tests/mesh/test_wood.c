// Weathered wood: what its relief and its fibres are.
#include "mesh/wood.h"

#include "base/random.h"
#include "testing.h"

#include <math.h>

enum { PLACES = 20000 };

// On a round stem of this radius, m, about the pith.
static Vec3 on_stem(uint64_t i, float radius)
{
    float angle = random_range(random_key(31, i), -PI_F, PI_F);
    float y = random_range(random_key(32, i), 0.0f, 1.5f);
    return vec3(radius * sinf(angle), y, radius * cosf(angle));
}

static void checks_are_few_and_cut_inward(void **state)
{
    (void)state;
    const float depth = 0.02f;
    const Vec3 side = {0, 0, 1};
    int cut = 0, deep = 0;
    for (uint64_t i = 0; i < PLACES; i++) {
        Vec3 p = on_stem(i, 0.05f);
        WoodPlace place = wood_place(p);
        float whole = wood_relief(p, side, 0.002f, 0.0f);
        float carved = wood_relief(p, side, 0.002f, depth);
        assert_true(carved <= whole && carved >= whole - depth);
        assert_true(fabsf(whole) < 0.02f);
        assert_true((place.check > 0.0f) == (carved < whole));
        cut += place.check > 0.0f;
        deep += whole - carved > 0.5f * depth;
    }
    assert_in_range(cut, PLACES / 50, PLACES / 4);
    assert_in_range(deep, PLACES / 200, cut / 2);
}

// Fine across the fibres, even along them.
static void grain_runs_along_the_stem(void **state)
{
    (void)state;
    const float step = 0.004f; // m
    double across = 0.0, along = 0.0;
    for (uint64_t i = 0; i < PLACES; i++) {
        Vec3 p = on_stem(i, 0.05f), u = vec3_normalize(vec3(p.z, 0.0f, -p.x));
        WoodPlace here = wood_place(p), beside = wood_place(vec3_madd(p, step, u));
        WoodPlace above = wood_place(vec3_add(p, vec3(0.0f, step, 0.0f)));
        float height = wood_grain_height(&here, 0.0f, 0.002f);
        across += fabs((double)(wood_grain_height(&beside, 0.0f, 0.002f) - height));
        along += fabs((double)(wood_grain_height(&above, 0.0f, 0.002f) - height));
    }
    assert_true(across > 4.0 * along);
}

// The potential flow has no source: fibres are pushed apart by a knot, never across each other.
static void fibres_flow_around_knots(void **state)
{
    (void)state;
    const float step = 0.0005f; // m
    int beside = 0, turned_back = 0;
    float bend = 0.0f;
    for (uint64_t i = 0; i < PLACES; i++) {
        Vec3 p = on_stem(i, 0.05f), u = vec3_normalize(vec3(p.z, 0.0f, -p.x));
        WoodPlace here = wood_place(p), next = wood_place(vec3_madd(p, step, u));
        Vec3 off = vec3_sub(next.grain, here.grain);
        float stretch = vec3_length(vec3(off.x, 0.0f, off.z)) / step;
        bend = fmaxf(bend, here.knot == 0.0f ? fabsf(stretch - 1.0f) : 0.0f);
        beside += here.knot > 0.0f;
        turned_back += here.knot == 0.0f && vec3_dot(off, u) < 0.0f && stretch > 1.5f;
    }
    assert_true(beside > 10);
    assert_true(bend > 0.3f);
    assert_int_equal(turned_back, 0);
}

// No step anywhere around the stem, as there might be where the angle starts anew.
static void there_is_no_seam(void **state)
{
    (void)state;
    const float step = 1e-4f; // rad
    for (int row = 0; row < 40; row++) {
        float y = 0.037f * (float)row, last = 0.0f;
        for (int i = -4000; i < 4000; i++) {
            float angle = PI_F + step * (float)i;
            Vec3 side = vec3(sinf(angle), 0.0f, cosf(angle));
            Vec3 p = vec3(0.05f * side.x, y, 0.05f * side.z);
            float height = wood_relief(p, side, 0.004f, 0.0f);
            assert_true(i == -4000 || fabsf(height - last) < 3e-5f);
            last = height;
        }
    }
}

static void ends_wear_less(void **state)
{
    (void)state;
    assert_true(wood_end(vec3(0, 1, 0)) == 1.0f && wood_end(vec3(0, -1, 0)) == 1.0f);
    assert_true(wood_end(vec3(1, 0, 0)) == 0.0f);
    double side = 0.0, end = 0.0;
    for (uint64_t i = 0; i < PLACES; i++) {
        WoodPlace place = wood_place(on_stem(i, 0.03f));
        side += fabs((double)wood_grain_height(&place, 0.0f, 0.002f));
        end += fabs((double)wood_grain_height(&place, 1.0f, 0.002f));
    }
    assert_true(end < 0.3 * side && end > 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(checks_are_few_and_cut_inward),
        cmocka_unit_test(grain_runs_along_the_stem),
        cmocka_unit_test(fibres_flow_around_knots),
        cmocka_unit_test(there_is_no_seam),
        cmocka_unit_test(ends_wear_less),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
