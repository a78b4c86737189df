// Foam's lace: it covers what is asked, at any width of the pixel; it grows with the cover; it has
// no hard steps; and a wide pixel shows the mean of what narrow ones show.
#include "base/random.h"
#include "render/material/foam.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

static Vec2 random_place(uint64_t i)
{
    return (Vec2){random_range(random_key(71, 2 * i), -400.0f, 400.0f),
                  random_range(random_key(71, 2 * i + 1), -400.0f, 400.0f)};
}

static void mean_is_the_cover(void **state)
{
    (void)state;
    enum { PLACES = 20000 };
    const float cover[] = {0.02f, 0.1f, 0.3f, 0.6f, 0.9f},
                width[] = {0.0f, 0.1f, 0.6f, 4.0f, 40.0f};
    for (size_t c = 0; c < sizeof cover / sizeof cover[0]; c++) {
        for (size_t w = 0; w < sizeof width / sizeof width[0]; w++) {
            double sum = 0.0;
            for (uint64_t i = 0; i < PLACES; i++) {
                sum += (double)foam_share(cover[c], random_place(i), width[w]);
            }
            double mean = sum / PLACES, want = (double)cover[c];
            printf("    cover %.2f, pixel %4.1f m: mean %.4f\n", want, (double)width[w], mean);
            assert_true(fabs(mean - want) < 0.05 * want + 0.01);
        }
    }
    assert_true(foam_share(0.0f, random_place(1), 0.0f) == 0.0f);
    assert_true(foam_share(1.0f, random_place(1), 0.0f) == 1.0f);
}

static void grows_with_the_cover_without_steps(void **state)
{
    (void)state;
    enum { PLACES = 100, STEPS = 5000 };
    float most = 0.0f;
    for (uint64_t i = 0; i < PLACES; i++) {
        Vec2 at = random_place(i);
        float last = 0.0f;
        for (int k = 1; k <= STEPS; k++) {
            float share = foam_share((float)k / STEPS, at, 0.02f);
            assert_true(share >= last - 1e-5f && share <= 1.0f);
            most = fmaxf(most, share - last);
            last = share;
        }
    }
    printf("    largest step for 1/%d of cover: %.3f\n", STEPS, (double)most);
    assert_true(most < 0.12f);
}

// A tenth of a millimetre further foam is nearly the same: edges are soft.
static void edges_are_soft(void **state)
{
    (void)state;
    enum { PLACES = 20000 };
    double most = 0.0;
    for (uint64_t i = 0; i < PLACES; i++) {
        Vec2 at = random_place(i), near = {at.x + 0.0001f, at.y};
        double step = fabs((double)(foam_share(0.3f, at, 0.0f) - foam_share(0.3f, near, 0.0f)));
        most = step > most ? step : most;
    }
    printf("    steepest edge: %.3f in 0.1 mm\n", most);
    assert_true(most < 0.08);
}

// Of a pixel of `width`: the share there against the mean of 16 x 16 narrow pixels.
static double misses(float width, double *spread)
{
    enum { PLACES = 150, SIDE = 16 };
    double squares = 0.0, variance = 0.0;
    for (uint64_t i = 0; i < PLACES; i++) {
        Vec2 at = random_place(i);
        double sum = 0.0;
        for (int k = 0; k < SIDE * SIDE; k++) {
            Vec2 p = {at.x + width * ((float)(k % SIDE) / SIDE - 0.5f),
                      at.y + width * ((float)(k / SIDE) / SIDE - 0.5f)};
            sum += (double)foam_share(0.3f, p, 0.0f);
        }
        double mean = sum / (SIDE * SIDE), off = (double)foam_share(0.3f, at, width) - mean;
        squares += off * off;
        variance += (mean - 0.3) * (mean - 0.3);
    }
    *spread = sqrt(variance / PLACES);
    return sqrt(squares / PLACES);
}

static void wide_pixels_show_the_mean(void **state)
{
    (void)state;
    const float width[] = {0.1f, 1.0f, 10.0f};
    const double most[] = {0.15, 0.15, 0.12}; // of one sample of the lace itself: 0.36
    for (int i = 0; i < 3; i++) {
        double spread, off = misses(width[i], &spread);
        printf("    pixel %4.1f m: off by %.3f, means differ by %.3f\n", (double)width[i], off,
               spread);
        assert_true(off < most[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mean_is_the_cover),
        cmocka_unit_test(grows_with_the_cover_without_steps),
        cmocka_unit_test(edges_are_soft),
        cmocka_unit_test(wide_pixels_show_the_mean),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
