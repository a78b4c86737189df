// Rubble masonry: stones and the mortar between them.
#include "render/material/pattern.h"

#include "base/random.h"
#include "render/material/bsdf.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

enum { PLACES = 6000 };

static Material wall(Vec3 mortar)
{
    Material m = material_default(MATERIAL_DIFFUSE);
    m.pattern = PATTERN_RUBBLE;
    m.color = m.color2 = vec3_splat(0.2f);
    m.mortar = mortar;
    m.pattern_scale = 0.13f;
    m.pattern_depth = 0.03f;
    return m;
}

static SurfacePoint on_side(Vec3 p, Vec3 side, float footprint)
{
    return (SurfacePoint){.position = p,
                          .object_position = p,
                          .normal = side,
                          .geometric_normal = side,
                          .footprint = footprint};
}

static Vec3 color_at(const Material *m, const SurfacePoint *point)
{
    PatternShade shade = {.color = m->color, .normal = point->normal};
    pattern_apply(m, point, &shade);
    assert_true(vec3_dot(shade.normal, point->normal) > 0.0f);
    return shade.color;
}

static Vec3 place(uint64_t i)
{
    uint64_t key = random_key(7, i);
    return vec3(random_range(random_key(key, 0), -4.0f, 4.0f),
                random_range(random_key(key, 1), -4.0f, 4.0f),
                random_range(random_key(key, 2), -4.0f, 4.0f));
}

// 0..1: how much of the colour at the point is the mortar's.
static float mortar_share(const SurfacePoint *point)
{
    Material dark = wall(vec3_splat(0.1f)), pale = wall(vec3_splat(0.5f));
    float change = color_at(&pale, point).x - color_at(&dark, point).x;
    return clampf(change / 0.15f, 0.0f, 1.0f);
}

// Between stones lies mortar of its own colour, which the stones have nothing of, and it lies
// deeper, on all sides of a wall. Joints of 2 cm about stones of 11 by 8 take three tenths of it,
// and more where edges are broken off.
static void mortar_lies_between_the_stones(void **state)
{
    (void)state;
    static const Vec3 SIDES[] = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
    for (int side = 0; side < 3; side++) {
        Material m = wall(vec3_splat(0.4f));
        double height[2] = {0};
        int count[2] = {0};
        for (uint64_t i = 0; i < PLACES; i++) {
            SurfacePoint point = on_side(place(i), SIDES[side], 0.0003f);
            float share = mortar_share(&point), at = pattern_height(&m, &point);
            assert_true(at > -1.2f * m.pattern_depth && at < 1.5f * m.pattern_depth);
            if (share == 0.0f || share > 0.5f) {
                count[share > 0.5f]++;
                height[share > 0.5f] += (double)at;
            }
        }
        double share = (double)count[1] / (double)(count[0] + count[1]);
        double step = height[0] / count[0] - height[1] / count[1];
        printf("    mortar %.3f of the wall, %.4f m below the stones\n", share, step);
        assert_true(share > 0.12 && share < 0.45);
        assert_true(step > 0.25 * (double)m.pattern_depth);
    }
}

// Deviation of the colour between places 3 mm apart in the mortar, relative to it.
static double grain(float footprint)
{
    Material m = wall(vec3_splat(0.4f));
    double squares = 0.0, mean = 0.0;
    int count = 0;
    for (uint64_t i = 0; i < PLACES; i++) {
        SurfacePoint a = on_side(place(i), vec3(0, 0, 1), footprint), b = a;
        b.position.x = b.object_position.x += 0.003f;
        if (mortar_share(&a) > 0.8f && mortar_share(&b) > 0.8f) {
            double x = (double)color_at(&m, &a).x, y = (double)color_at(&m, &b).x;
            squares += (x - y) * (x - y);
            mean += 0.5 * (x + y);
            count++;
        }
    }
    assert_true(count > 100);
    return sqrt(squares / count) / (mean / count);
}

// Sand shows in the mortar from near, and from afar its mean alone.
static void mortar_has_grains_of_sand(void **state)
{
    (void)state;
    double near = grain(0.0003f), far = grain(0.02f);
    printf("    deviation of neighbours: %.3f near, %.3f far\n", near, far);
    assert_true(near > 0.08);
    assert_true(far < 0.6 * near);
}

// Stones are of all sizes: the lengths of level lines from mortar to mortar vary by more than half.
static void stones_are_of_all_sizes(void **state)
{
    (void)state;
    const float step = 0.002f;
    double sum = 0.0, squares = 0.0;
    int count = 0;
    for (uint64_t line = 0; line < 60; line++) {
        float y = random_range(random_key(11, line), -4.0f, 4.0f), length = 0.0f;
        for (int i = 0; i < 2000; i++) {
            SurfacePoint point = on_side(vec3((float)i * step, y, 0.0f), vec3(0, 0, 1), 0.0003f);
            bool stone = mortar_share(&point) < 0.5f;
            if (!stone && length > 0.02f) {
                sum += (double)length;
                squares += (double)(length * length);
                count++;
            }
            length = stone ? length + step : 0.0f;
        }
    }
    double mean = sum / count, deviation = sqrt(squares / count - mean * mean);
    printf("    %d stones, %.3f m long, deviation %.3f\n", count, mean, deviation);
    assert_true(mean > 0.07 && mean < 0.3);
    assert_true(deviation > 0.5 * mean);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mortar_lies_between_the_stones),
        cmocka_unit_test(mortar_has_grains_of_sand),
        cmocka_unit_test(stones_are_of_all_sizes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
