// Covers of slopes: streaks follow the fall line, and what a pixel no longer shows fades into its
// mean.
#include "render/material/pattern_slopes.h"

#include "base/random.h"
#include "base/strata.h"
#include "render/material/pattern_beds.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { PLACES = 4000 };

static SurfacePoint place(uint64_t key, Vec3 normal, float footprint)
{
    Vec3 at = {random_range(random_key(key, 0), -3000.0f, 3000.0f),
               random_range(random_key(key, 1), -300.0f, 300.0f),
               random_range(random_key(key, 2), -3000.0f, 3000.0f)};
    return (SurfacePoint){.object_position = at,
                          .position = at,
                          .normal = normal,
                          .geometric_normal = normal,
                          .footprint = footprint};
}

static float streak(SurfacePoint point, Vec3 step)
{
    point.object_position = vec3_add(point.object_position, step);
    return pattern_fall_lines(&point, 4.0f, 1, 0.5f, 7).value;
}

// Down the slope values change over six times the distance that they change over across it; on
// level ground over the same.
static void streaks_run_down_the_slope(void **state)
{
    (void)state;
    const Vec3 slopes[3] = {{0.6f, 0.8f, 0.0f}, {0.36f, 0.8f, -0.48f}, {0.0f, 1.0f, 0.0f}};
    for (int k = 0; k < 3; k++) {
        Vec3 n = slopes[k];
        Vec3 down = k < 2 ? vec3_normalize(vec3(n.x, 0.0f, n.z)) : vec3(1.0f, 0.0f, 0.0f);
        Vec3 across = {-down.z, 0.0f, down.x};
        double along = 0.0, sideways = 0.0, sum = 0.0, square = 0.0;
        for (uint64_t i = 0; i < PLACES; i++) {
            SurfacePoint p = place(i, n, 0.01f);
            float here = streak(p, vec3_splat(0.0f));
            along += pow((double)(streak(p, vec3_scale(down, 0.4f)) - here), 2.0);
            sideways += pow((double)(streak(p, vec3_scale(across, 0.4f)) - here), 2.0);
            sum += (double)here;
            square += (double)(here * here);
        }
        double ratio = sqrt(sideways / along);
        assert_true(k < 2 ? ratio > 4.5 && ratio < 7.5 : ratio > 0.85 && ratio < 1.18);
        double deviation = sqrt(square / PLACES);
        assert_true(fabs(sum / PLACES) < 5.0 * deviation / sqrt(PLACES));
        assert_true(deviation > 0.1 && deviation < 0.6);
    }
}

static void slopes_of_streaks_are_their_gradients(void **state)
{
    (void)state;
    const float h = 1e-2f;
    double along = 0.0, found = 0.0, asked = 0.0;
    for (uint64_t i = 0; i < PLACES; i++) {
        SurfacePoint p = place(i, vec3(0.36f, 0.8f, -0.48f), 0.01f);
        Vec3 s = pattern_fall_lines(&p, 4.0f, 1, 0.5f, 7).slope, d = {0};
        d.x = (streak(p, vec3(h, 0, 0)) - streak(p, vec3(-h, 0, 0))) / (2.0f * h);
        d.z = (streak(p, vec3(0, 0, h)) - streak(p, vec3(0, 0, -h))) / (2.0f * h);
        along += (double)vec3_dot(s, d);
        found += (double)vec3_dot(d, d);
        asked += (double)vec3_dot(s, s);
    }
    assert_true(along / sqrt(found * asked) > 0.995);
    assert_true(fabs(sqrt(asked / found) - 1.0) < 0.02);
}

// The share under mounds does not hang on the pixel, nor does their tone.
typedef Mounds (*MoundsOf)(const SurfacePoint *, float, float, uint32_t);

static void far_ones_are_their_mean(MoundsOf of)
{
    const float densities[2] = {0.3f, 0.9f};
    for (int k = 0; k < 2; k++) {
        double near = 0.0, square = 0.0;
        for (uint64_t i = 0; i < PLACES; i++) {
            SurfacePoint p = place(i, vec3(0, 1, 0), 0.01f), far = place(i, vec3(0, 1, 0), 50.0f);
            Mounds a = of(&p, densities[k], 5.0f, 3);
            Mounds b = of(&far, densities[k], 5.0f, 3);
            near += (double)a.share;
            square += (double)(a.share * a.share);
            assert_true(b.share == of(&far, densities[k], 5.0f, 4).share);
            assert_true(vec3_length(b.slope) == 0.0f && b.tone == 0.5f);
            assert_true(a.share >= 0.0f && a.share <= 1.0f && a.tone >= 0.0f && a.tone <= 1.0f);
        }
        SurfacePoint far = place(0, vec3(0, 1, 0), 50.0f);
        double mean = near / PLACES, error = sqrt((square / PLACES - mean * mean) / PLACES);
        double told = (double)of(&far, densities[k], 5.0f, 3).share;
        assert_true(fabs(mean - told) < 3.5 * error + 0.02 * told);
    }
}

static void far_mounds_are_their_mean(void **state)
{
    (void)state;
    far_ones_are_their_mean(pattern_mounds);
    far_ones_are_their_mean(pattern_tussocks);
}

// Mounds lean outward: the relief falls away from the middle of each, and rises on the way to it.
static void tussocks_slope_as_balls_do(void **state)
{
    (void)state;
    int within = 0, inward = 0;
    for (uint64_t i = 0; i < PLACES; i++) {
        SurfacePoint p = place(i, vec3(0, 1, 0), 0.01f), q = p;
        Mounds here = pattern_tussocks(&p, 1.0f, 5.0f, 3);
        float steep = vec3_length(here.slope);
        if (here.share < 1.0f || steep < 0.5f) {
            continue;
        }
        within++;
        // uphill the slope grows less, as toward a ball's top
        q.object_position = vec3_madd(p.object_position, 0.05f / steep, here.slope);
        inward += vec3_length(pattern_tussocks(&q, 1.0f, 5.0f, 3).slope) < steep;
    }
    assert_true(within > PLACES / 10 && inward > within - within / 50);
}

// A cover has about the same colour from near and from afar, and no detail that is finer than a
// pixel.
static void covers_keep_their_mean(void **state)
{
    (void)state;
    Vec3 pale = {0.3f, 0.28f, 0.25f}, dark = {0.15f, 0.14f, 0.13f};
    double near[2] = {0}, far[2] = {0}, rough[2] = {0};
    Turf turf = {.lush = {0.04f, 0.06f, 0.02f},
                 .straw = {0.1f, 0.09f, 0.04f},
                 .bush = {0.02f, 0.03f, 0.014f},
                 .soil = {0.11f, 0.1f, 0.07f},
                 .scale = 60.0f,
                 .dry = 0.5f};
    for (uint64_t i = 0; i < PLACES; i++) {
        SurfacePoint a = place(i, vec3(0.36f, 0.8f, -0.48f), 0.05f), b = a;
        b.footprint = 1000.0f;
        Ground fine[2] = {slopes_talus(&a, pale, dark, 80.0f), slopes_turf(&a, &turf)};
        Ground coarse[2] = {slopes_talus(&b, pale, dark, 80.0f), slopes_turf(&b, &turf)};
        for (int k = 0; k < 2; k++) {
            near[k] += (double)fine[k].color.y;
            far[k] += (double)coarse[k].color.y;
            rough[k] += (double)vec3_length(fine[k].slope);
            assert_true(vec3_length(coarse[k].slope) == 0.0f);
        }
    }
    for (int k = 0; k < 2; k++) {
        assert_true(fabs(near[k] / far[k] - 1.0) < 0.08);
        assert_true(rough[k] / PLACES > 0.1);
    }
}

// Tints have the beds' ratios, and by thickness their mean is the colour itself.
static void beds_tint_about_their_mean(void **state)
{
    (void)state;
    StrataBed beds[2] = {{.thickness = 30.0f, .hardness = 0.8f, .color = {0.4f, 0.3f, 0.2f}},
                         {.thickness = 10.0f, .hardness = 0.2f, .color = {0.1f, 0.2f, 0.3f}}};
    StrataParams params = {.beds = beds, .bed_count = 2};
    Strata *strata = strata_new(&params, vec3_splat(0.0f), 1000.0f, NULL);
    assert_non_null(strata);
    SurfacePoint point = {.strata = strata, .footprint = 0.1f};
    Vec3 color = {0.2f, 0.24f, 0.28f};
    Vec3 first = beds_tinted(&point, -15.0f, color), second = beds_tinted(&point, -35.0f, color);
    assert_float_equal(first.x / second.x, 4.0f, 1e-4f);
    assert_float_equal(first.z / second.z, 2.0f / 3.0f, 1e-4f);
    Vec3 mean = vec3_add(vec3_scale(first, 0.75f), vec3_scale(second, 0.25f));
    assert_float_equal(vec3_distance(mean, color), 0.0f, 1e-5f);
    strata_free(strata);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(streaks_run_down_the_slope),
        cmocka_unit_test(slopes_of_streaks_are_their_gradients),
        cmocka_unit_test(far_mounds_are_their_mean),
        cmocka_unit_test(tussocks_slope_as_balls_do),
        cmocka_unit_test(covers_keep_their_mean),
        cmocka_unit_test(beds_tint_about_their_mean),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
