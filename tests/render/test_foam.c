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

static float lace(float cover, Vec2 at, float width)
{
    return foam_share((FoamCover){cover, 0.0f}, (FoamPlace){at, at}, width);
}

static float froth(float cover, Vec2 at, float width)
{
    return foam_share((FoamCover){cover, 1.0f}, (FoamPlace){at, at}, width);
}

static void mean_is_the_cover(void **state)
{
    (void)state;
    enum { PLACES = 20000 };
    const float cover[] = {0.02f, 0.1f, 0.3f, 0.6f, 0.9f},
                width[] = {0.0f, 0.1f, 0.6f, 4.0f, 40.0f};
    for (size_t c = 0; c < sizeof cover / sizeof cover[0]; c++) {
        for (size_t w = 0; w < sizeof width / sizeof width[0]; w++) {
            double sum[2] = {0.0, 0.0}, want = (double)cover[c];
            for (uint64_t i = 0; i < PLACES; i++) {
                sum[0] += (double)lace(cover[c], random_place(i), width[w]);
                sum[1] += (double)froth(cover[c], random_place(i), width[w]);
            }
            printf("    cover %.2f, pixel %4.1f m: lace %.4f, froth %.4f\n", want, (double)width[w],
                   sum[0] / PLACES, sum[1] / PLACES);
            for (int k = 0; k < 2; k++) {
                assert_true(fabs(sum[k] / PLACES - want) < 0.05 * want + 0.01);
            }
        }
    }
    assert_true(lace(0.0f, random_place(1), 0.0f) == 0.0f);
    assert_true(lace(1.0f, random_place(1), 0.0f) == 1.0f);
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
            float share = lace((float)k / STEPS, at, 0.02f);
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
        double step = fabs((double)(lace(0.3f, at, 0.0f) - lace(0.3f, near, 0.0f)));
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
            sum += (double)lace(0.3f, p, 0.0f);
        }
        double mean = sum / (SIDE * SIDE), off = (double)lace(0.3f, at, width) - mean;
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

// Eddies keep areas (the determinant of their map is 1), have no seams, and turn some places far.
static void eddies_keep_areas(void **state)
{
    (void)state;
    enum { PLACES = 20000 };
    const float step = 0.002f, spacing = 3.0f;
    int off = 0, far = 0;
    for (uint64_t i = 0; i < PLACES; i++) {
        Vec2 at = random_place(i), x = {at.x + step, at.y}, y = {at.x, at.y + step};
        Vec2 a = foam_stirred(at, spacing, 6.0f, 5), b = foam_stirred(x, spacing, 6.0f, 5),
             c = foam_stirred(y, spacing, 6.0f, 5);
        float ux = (b.x - a.x) / step, uy = (b.y - a.y) / step;
        float vx = (c.x - a.x) / step, vy = (c.y - a.y) / step;
        assert_true(hypotf(ux, uy) < 25.0f && hypotf(vx, vy) < 25.0f); // no seam
        off += fabsf(ux * vy - uy * vx - 1.0f) > 0.25f;
        far += hypotf(a.x - at.x, a.y - at.y) > 0.3f * spacing;
    }
    printf("    %.2f %% of areas differ, %.1f %% are moved far\n", 100.0 * off / PLACES,
           100.0 * far / PLACES);
    assert_true(off < PLACES / 50 && far > PLACES / 50);
}

// Lace lies still while patches drift: far drifts keep what is finer than a decimetre in place.
static void lace_does_not_drift(void **state)
{
    (void)state;
    enum { PLACES = 4000 };
    double alike[2] = {0.0, 0.0};
    for (uint64_t i = 0; i < PLACES; i++) {
        Vec2 at = random_place(i), by = {at.x + 40.0f, at.y}, other = random_place(i + PLACES);
        double here = (double)lace(0.5f, at, 0.0f);
        alike[0] +=
            fabs(here - (double)foam_share((FoamCover){0.5f, 0.0f}, (FoamPlace){by, at}, 0.0f));
        alike[1] +=
            fabs(here - (double)foam_share((FoamCover){0.5f, 0.0f}, (FoamPlace){by, other}, 0.0f));
    }
    printf("    differs by %.3f; with other lace by %.3f\n", alike[0] / PLACES, alike[1] / PLACES);
    assert_true(alike[0] < 0.85 * alike[1]);
}

static double mean_steepness(FoamCover foam, float width)
{
    enum { PLACES = 4000 };
    double sum = 0.0;
    for (uint64_t i = 0; i < PLACES; i++) {
        FoamPlace at = {random_place(i), random_place(i)};
        Vec2 slope = foam_slope(foam, foam_share(foam, at, width), at, 1.0f, width);
        sum += sqrt((double)(slope.x * slope.x + slope.y * slope.y));
        assert_true(fabsf(slope.x) <= 0.7f && fabsf(slope.y) <= 0.7f);
    }
    return sum / PLACES;
}

// Froth is lumpy from near and smooth from afar, lace far flatter, the thinner the flatter; and
// where there is none, nothing rises.
static void foam_has_relief(void **state)
{
    (void)state;
    double lumps = mean_steepness((FoamCover){0.9f, 1.0f}, 0.005f),
           dense = mean_steepness((FoamCover){0.9f, 0.0f}, 0.005f),
           thin = mean_steepness((FoamCover){0.1f, 0.0f}, 0.005f);
    printf("    steepness of froth %.3f, dense lace %.3f, thin lace %.3f\n", lumps, dense, thin);
    assert_true(lumps > 0.2 && lumps > 2.0 * dense && dense > thin && thin > 0.01);
    assert_true(mean_steepness((FoamCover){0.9f, 1.0f}, 4.0f) < 0.02 * lumps);
    assert_true(mean_steepness((FoamCover){0.0f, 0.0f}, 0.005f) == 0.0);
}

// Beside a strand the foam falls toward open water: slopes are those of its thickness, 2 cm times
// its share, where no lumps are seen.
static void relief_is_that_of_the_share(void **state)
{
    (void)state;
    const float width = 0.4f, step = 0.4f; // m: no lump is as wide
    int steep = 0;
    for (uint64_t i = 0; i < 2000; i++) {
        Vec2 at = random_place(i),
             slope = foam_slope((FoamCover){0.5f, 0.0f}, lace(0.5f, at, width), (FoamPlace){at, at},
                                1.0f, width);
        float x = lace(0.5f, (Vec2){at.x + step, at.y}, width) - lace(0.5f, at, width);
        float y = lace(0.5f, (Vec2){at.x, at.y + step}, width) - lace(0.5f, at, width);
        assert_float_equal(slope.x, 0.02f * x / step, 1e-6f);
        assert_float_equal(slope.y, 0.02f * y / step, 1e-6f);
        steep += fabsf(slope.x) > 0.004f;
    }
    assert_true(steep > 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mean_is_the_cover), cmocka_unit_test(grows_with_the_cover_without_steps),
        cmocka_unit_test(edges_are_soft),    cmocka_unit_test(wide_pixels_show_the_mean),
        cmocka_unit_test(eddies_keep_areas), cmocka_unit_test(lace_does_not_drift),
        cmocka_unit_test(foam_has_relief),   cmocka_unit_test(relief_is_that_of_the_share),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
