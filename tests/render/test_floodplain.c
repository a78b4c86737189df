// The patterns of a meandering river's floodplain and of its water.
#include "render/material/pattern.h"

#include "base/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

static Vec3 color_at(PatternKind kind, Vec3 p, Vec2 site, float footprint)
{
    Material m = {.kind = MATERIAL_DIFFUSE,
                  .color = {0.42f, 0.355f, 0.255f},
                  .color2 = {0.066f, 0.077f, 0.032f},
                  .pattern = kind,
                  .pattern_depth = 1.0f};
    SurfacePoint point = {.object_position = p,
                          .position = p,
                          .geometric_normal = {0, 1, 0},
                          .normal = {0, 1, 0},
                          .footprint = footprint,
                          .site = site};
    PatternShade shade = {.color = m.color, .normal = {0, 1, 0}};
    pattern_apply(&m, &point, &shade);
    assert_float_equal(vec3_length(shade.normal), 1.0f, 1e-4f);
    return shade.color;
}

// The mean of random places of 2 km.
static Vec3 mean_color(PatternKind kind, Vec2 site, float footprint)
{
    enum { COUNT = 6000 };
    Vec3 sum = {0};
    for (uint64_t i = 0; i < COUNT; i++) {
        Vec3 p = vec3(random_range(random_key(i, 0), -1000.0f, 1000.0f), 0.0f,
                      random_range(random_key(i, 1), -1000.0f, 1000.0f));
        sum = vec3_add(sum, color_at(kind, p, site, footprint));
    }
    return vec3_scale(sum, 1.0f / COUNT);
}

// meander.c: the age of ground after a time, and how damp a bar is at a scroll's height.
static Vec2 site_of(float lain, float scroll)
{
    const float low = 0.011f / 0.045f;
    float grown = lain / (lain + 2.5f), fades = 40.0f / (40.0f + lain);
    float level = low + (1.0f - low) * grown * (1.0f + 0.22f * scroll * fades);
    return (Vec2){0.74f * lain / (lain + 9.0f), 1.0f - level / 1.25f};
}

static float greenness(Vec3 c)
{
    return c.y / c.x;
}

// Bare sand first, then plants; dry grass on ridges, lush and dark ground in swales.
static void test_succession(void **state)
{
    (void)state;
    Vec3 fresh = mean_color(PATTERN_FLOODPLAIN, site_of(0.1f, 0.0f), 0.5f);
    Vec3 young = mean_color(PATTERN_FLOODPLAIN, site_of(2.5f, 0.0f), 0.5f);
    Vec3 meadow = mean_color(PATTERN_FLOODPLAIN, site_of(9.0f, 0.0f), 0.5f);
    assert_true(fresh.x > 0.2f && fresh.y < fresh.x);
    assert_true(young.x < 0.8f * fresh.x && greenness(young) > greenness(fresh) + 0.02f);
    assert_true(meadow.x < 0.8f * young.x && greenness(meadow) > greenness(young) + 0.02f);
    Vec3 ridge = mean_color(PATTERN_FLOODPLAIN, site_of(9.0f, 0.5f), 0.5f);
    Vec3 swale = mean_color(PATTERN_FLOODPLAIN, site_of(9.0f, -0.6f), 0.5f);
    print_message("ridge %.3f %.3f, swale %.3f %.3f\n", (double)ridge.x, (double)ridge.y,
                  (double)swale.x, (double)swale.y);
    assert_true(swale.x < 0.85f * ridge.x && greenness(swale) > greenness(ridge) + 0.03f);
}

// A pixel that is too wide for shrubs, rows and ruts shows what many narrow ones show together.
static void test_far_ground_is_the_mean_of_near(void **state)
{
    (void)state;
    const Vec2 sites[] = {site_of(0.3f, 0.0f),
                          site_of(2.5f, 0.3f),
                          site_of(8.0f, -0.2f),
                          site_of(30.0f, 0.0f),
                          {0.74f, 0.0f}};
    for (int k = 0; k < 5; k++) {
        Vec3 near = mean_color(PATTERN_FLOODPLAIN, sites[k], 0.05f);
        Vec3 far = mean_color(PATTERN_FLOODPLAIN, sites[k], 30.0f);
        print_message("near %.3f %.3f %.3f, far %.3f %.3f %.3f\n", (double)near.x, (double)near.y,
                      (double)near.z, (double)far.x, (double)far.y, (double)far.z);
        assert_true(fabsf(far.x / near.x - 1.0f) < 0.2f && fabsf(far.y / near.y - 1.0f) < 0.2f);
    }
}

// Over shoals the bed shows through, the less the deeper, red longest; deep water has its own
// colour.
static void test_water_hides_its_bed_with_depth(void **state)
{
    (void)state;
    Vec3 last = {0};
    for (int k = 0; k < 6; k++) {
        float depth = 0.6f * (float)k;
        Vec3 c = mean_color(PATTERN_RIVER, (Vec2){depth / (1.0f + depth), 0.3f}, 0.5f);
        assert_true(k == 0 || c.x > last.x); // here color, of the water, is brighter than the bed
        assert_true(k == 0 || c.z > last.z);
        last = c;
    }
    Vec3 shoal = mean_color(PATTERN_RIVER, (Vec2){0.0f, 0.3f}, 0.5f);
    Vec3 deep = mean_color(PATTERN_RIVER, (Vec2){0.95f, 0.3f}, 0.5f);
    assert_float_equal(shoal.x, 0.9f * 0.066f, 0.003f);
    assert_float_equal(deep.x, 0.42f, 0.02f);
    assert_float_equal(deep.z, 0.255f, 0.01f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_succession),
        cmocka_unit_test(test_far_ground_is_the_mean_of_near),
        cmocka_unit_test(test_water_hides_its_bed_with_depth),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
