// The ground of a volcano: what a flow of lava looks like.
#include "render/material/pattern.h"

#include "base/random.h"
#include "render/material/bsdf.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const float SLOPE = 0.17f; // of the land, which falls toward +x

static Material ground(void)
{
    Material m = material_default(MATERIAL_DIFFUSE);
    m.pattern = PATTERN_VOLCANO;
    m.pattern_depth = 1.0f;
    m.color = vec3(0.1f, 0.09f, 0.08f);
    m.color2 = vec3(0.03f, 0.029f, 0.028f);
    return m;
}

static PatternShade lava_at(float x, float z, float footprint)
{
    Material m = ground();
    Vec3 n = vec3_normalize(vec3(SLOPE, 1.0f, 0.0f));
    SurfacePoint p = {.normal = n, .geometric_normal = n, .footprint = footprint};
    p.position = p.object_position = vec3(x, -SLOPE * x, z);
    p.site = (Vec2){0.3f, 0.9f};
    PatternShade shade = {m.color, m.transmittance, n, 0.0f, m.roughness};
    pattern_apply(&m, &p, &shade);
    assert_true(vec3_finite(shade.color) && vec3_finite(shade.normal));
    return shade;
}

// Most of a flow is grey or black, some of it red with oxides.
static void lava_has_zones(void **state)
{
    (void)state;
    int red = 0, grey = 0;
    const int count = 4000;
    for (int i = 0; i < count; i++) {
        float x = random_range(random_key(1, (uint64_t)i), -2000.0f, 2000.0f);
        float z = random_range(random_key(2, (uint64_t)i), -2000.0f, 2000.0f);
        Vec3 c = lava_at(x, z, 0.3f).color;
        red += c.x > 1.35f * c.z;
        grey += c.x < 1.2f * c.z;
    }
    assert_true(red > count / 50 && red < count / 4);
    assert_true(grey > count / 2);
}

// Variance, over strips 12 m long, of the normal's mean tilt down the slope.
static double tilt_variance(bool across, float footprint)
{
    double sum = 0.0, squares = 0.0;
    const int strips = 400, steps = 24;
    for (int i = 0; i < strips; i++) {
        float x = random_range(random_key(3, (uint64_t)i), -2000.0f, 2000.0f);
        float z = random_range(random_key(4, (uint64_t)i), -2000.0f, 2000.0f);
        double mean = 0.0;
        for (int k = 0; k < steps; k++) {
            float at = 0.5f * (float)k;
            PatternShade shade = lava_at(across ? x : x + at, across ? z + at : z, footprint);
            mean += (double)shade.normal.x / steps;
        }
        sum += mean / strips;
        squares += mean * mean / strips;
    }
    return squares - sum * sum;
}

// Pressure ridges lie across the flow: along a contour the ground keeps its tilt, down the slope it
// changes. From afar none are seen.
static void pressure_ridges_lie_across_the_slope(void **state)
{
    (void)state;
    double across = tilt_variance(true, 0.3f), down = tilt_variance(false, 0.3f);
    assert_true(across > 1.5 * down);
    assert_true(tilt_variance(true, 50.0f) < 0.2 * across);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lava_has_zones),
        cmocka_unit_test(pressure_ridges_lie_across_the_slope),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
