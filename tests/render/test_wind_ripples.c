// Ripples of wind on lakes: the variance of their slopes against what is told of seas, the same
// from any distance; patches against the share that they are told to cover.
#include "render/material/wind_ripples.h"

#include "base/random.h"
#include "render/material/bsdf.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#define ASSERT_NEAR(value, wanted, tolerance)                                             \
    do {                                                                                  \
        double v_ = (double)(value), w_ = (double)(wanted);                               \
        if (!(fabs(v_ - w_) <= (double)(tolerance))) {                                    \
            fail_msg("%s = %.6g, not %.6g +- %.2g", #value, v_, w_, (double)(tolerance)); \
        }                                                                                 \
    } while (0)

static const RippleWind BREEZE = {.speed = 3.0f, .way = {0.6f, 0.8f}, .gusts = 90.0f};

static Vec2 random_place(uint64_t i, float size)
{
    uint64_t key = random_key(77, i);
    return (Vec2){random_range(random_key(key, 0), -size, size),
                  random_range(random_key(key, 1), -size, size)};
}

// Of slopes that pixels this wide show; seen at an angle they are `longer` times as long.
typedef struct Slopes {
    double along, across, hidden; // variances, by the wind; mean of what is left out
} Slopes;

static Slopes slopes_of(const RippleWind *wind, float width, float longer, int count)
{
    Slopes s = {0.0, 0.0, 0.0};
    RipplePixel pixel = {{1.0f, 0.0f}, longer * width, width};
    WindRipples ripples = wind_ripples_of(wind);
    for (int i = 0; i < count; i++) {
        RipplePoint p = wind_ripples_at(&ripples, random_place((uint64_t)i, 20000.0f), &pixel);
        double along = (double)(p.slope.x * wind->way.x + p.slope.y * wind->way.y);
        double across = (double)(p.slope.y * wind->way.x - p.slope.x * wind->way.y);
        s.along += along * along / count;
        s.across += across * across / count;
        s.hidden += (double)p.roughness2 / count;
    }
    return s;
}

// Without still water all slopes are those of Cox and Munk, steeper along the wind: they found
// 0.00316 wind along it and 0.003 + 0.00192 wind across.
static void slopes_are_those_of_a_sea(void **state)
{
    (void)state;
    for (float speed = 1.0f; speed < 9.0f; speed *= 2.0f) {
        RippleWind wind = BREEZE;
        wind.speed = speed;
        Slopes s = slopes_of(&wind, 1e-4f, 1.0f, 40000);
        double told = 0.003 + 0.00512 * (double)speed;
        ASSERT_NEAR(s.hidden, 0.0, 1e-4 * told);
        ASSERT_NEAR((s.along + s.across) / told, 1.0, 0.03);
        assert_true(s.along > 1.3 * s.across && s.along < 4.0 * s.across);
        ASSERT_NEAR(wind_ripples_mean_variance(&wind) / (float)told, 1.0, 1e-5);
    }
}

// From a millimetre to a kilometre a pixel, level or at a grazing angle.
static void no_distance_changes_the_variance(void **state)
{
    (void)state;
    RippleWind wind = BREEZE;
    wind.calm = 0.4f;
    double mean = (double)wind_ripples_mean_variance(&wind), last = -1.0;
    assert_true(mean > 0.6 * (double)wind_ripples_variance(&wind));
    for (float width = 0.001f; width < 2000.0f; width *= 4.0f) {
        Slopes s = slopes_of(&wind, width, 1.0f, 30000);
        ASSERT_NEAR((s.along + s.across + s.hidden) / mean, 1.0, 0.04);
        assert_true(s.hidden > 0.97 * last);
        last = s.hidden;
        Slopes grazing = slopes_of(&wind, width, 20.0f, 30000);
        ASSERT_NEAR((grazing.along + grazing.across + grazing.hidden) / mean, 1.0, 0.04);
        assert_true(grazing.hidden > 0.97 * s.hidden);
    }
    ASSERT_NEAR(last / mean, 1.0, 0.04);
}

// Half a metre wide across the view and ten metres along it: the crests that run along the view are
// seen, those across are not.
static void long_pixels_hide_crests_across(void **state)
{
    (void)state;
    RippleWind wind = BREEZE;
    wind.longest = 2.0f;
    WindRipples ripples = wind_ripples_of(&wind);
    RipplePixel with = {wind.way, 6.0f, 0.2f};
    RipplePixel across = {{wind.way.y, -wind.way.x}, 6.0f, 0.2f};
    double seen[2] = {0.0, 0.0};
    for (uint64_t i = 0; i < 20000; i++) {
        Vec2 place = random_place(i, 5000.0f);
        RipplePoint a = wind_ripples_at(&ripples, place, &with);
        RipplePoint b = wind_ripples_at(&ripples, place, &across);
        seen[0] += (double)(a.slope.x * a.slope.x + a.slope.y * a.slope.y);
        seen[1] += (double)(b.slope.x * b.slope.x + b.slope.y * b.slope.y);
    }
    assert_true(seen[1] > 2.0 * seen[0]);
}

static void patches_cover_their_share(void **state)
{
    (void)state;
    for (float calm = 0.1f; calm < 0.95f; calm += 0.2f) {
        RippleWind wind = BREEZE;
        wind.calm = calm;
        WindRipples ripples = wind_ripples_of(&wind);
        for (float width = 0.01f; width < 1000.0f; width *= 10.0f) {
            RipplePixel pixel = {{1.0f, 0.0f}, width, width};
            double sum = 0.0;
            enum { COUNT = 30000 };
            for (uint64_t i = 0; i < COUNT; i++) {
                Vec2 place = random_place(i, 50000.0f);
                sum += (double)wind_ripples_at(&ripples, place, &pixel).cover / COUNT;
            }
            ASSERT_NEAR(sum, 1.0f - calm, 0.035);
        }
    }
}

// They are patches, rippled or still, as large as told.
static void patches_have_their_size(void **state)
{
    (void)state;
    RippleWind wind = BREEZE;
    wind.calm = 0.5f;
    WindRipples ripples = wind_ripples_of(&wind);
    RipplePixel pixel = {{1.0f, 0.0f}, 0.05f, 0.05f};
    enum { COUNT = 20000, STEPS = 4 };
    static const float step[STEPS] = {0.02f, 0.15f, 0.5f, 6.0f}; // of gusts
    double square = 0.0, product[STEPS] = {0.0};
    int either = 0;
    for (uint64_t i = 0; i < COUNT; i++) {
        Vec2 place = random_place(i, 50000.0f);
        double here = (double)wind_ripples_at(&ripples, place, &pixel).cover - 0.5;
        either += fabs(here) > 0.4;
        square += here * here;
        for (int k = 0; k < STEPS; k++) {
            Vec2 there = {place.x - wind.way.y * step[k] * wind.gusts,
                          place.y + wind.way.x * step[k] * wind.gusts};
            product[k] += here * ((double)wind_ripples_at(&ripples, there, &pixel).cover - 0.5);
        }
    }
    assert_true(either > COUNT / 2);
    assert_true(product[0] / square > 0.85);
    assert_true(product[1] / square > 0.4 && product[1] / square < 0.9);
    assert_true(product[2] / square < 0.5);
    ASSERT_NEAR(product[3] / square, 0.0, 0.05);
}

// Water far away is as rough as the ripples in its pixel; without wind it is a mirror.
static void far_water_is_rough(void **state)
{
    (void)state;
    Material water = material_default(MATERIAL_WATER);
    water.calm = 0.0f;
    for (int windy = 0; windy < 2; windy++) {
        water.wind = windy ? 3.0f : 0.0f;
        Run run = run_default();
        MaterialSet *set = material_set_new(&water, NULL, 1, &run, NULL);
        assert_non_null(set);
        SurfacePoint point = {.geometric_normal = {0, 1, 0},
                              .normal = {0, 1, 0},
                              .facet_normal = {0, 1, 0},
                              .footprint = 40.0f};
        Bsdf b = bsdf_at(set, &point, vec3_normalize(vec3(1.0f, 0.2f, 0.3f)));
        assert_true(b.delta == !windy);
        if (windy) {
            ASSERT_NEAR(b.alpha, 0.75f * sqrtf(wind_ripples_variance(&BREEZE)), 0.002);
        }
        point.footprint = 1e-4f; // near, its normals tell of them
        b = bsdf_at(set, &point, vec3_normalize(vec3(1.0f, 0.2f, 0.3f)));
        assert_true(b.delta);
        assert_true(windy == (b.normal.y < 0.99999f));
        material_set_free(set);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(slopes_are_those_of_a_sea),
                                       cmocka_unit_test(no_distance_changes_the_variance),
                                       cmocka_unit_test(long_pixels_hide_crests_across),
                                       cmocka_unit_test(patches_cover_their_share),
                                       cmocka_unit_test(patches_have_their_size),
                                       cmocka_unit_test(far_water_is_rough)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
