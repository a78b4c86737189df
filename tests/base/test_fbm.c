#include "base/exact_math.h"
#include "base/fbm.h"
#include "base/fft.h"
#include "base/memory.h"
#include "base/random.h"
#include "testing.h"

#include <math.h>
#include <string.h>

static void sines_and_cosines_are_exact_to_a_double(void **state)
{
    (void)state;
    for (int i = -4000; i <= 4000; i++) {
        double angle = 0.00175 * i, sine, cosine;
        exact_sincos_double(angle, &sine, &cosine);
        assert_true(fabs(sine - sin(angle)) < 1e-15);
        assert_true(fabs(cosine - cos(angle)) < 1e-15);
    }
}

// Against the sum that defines it.
static void the_transform_is_that_of_fourier(void **state)
{
    (void)state;
    enum { MOST = 64 };
    for (int64_t n = 2; n <= MOST; n *= 2) {
        Complex x[MOST], y[MOST], *root = fft_roots(n, NULL);
        for (int64_t k = 0; k < n; k++) {
            x[k].re = (double)random_normal(random_key(1, (uint64_t)k));
            x[k].im = (double)random_normal(random_key(2, (uint64_t)k));
        }
        memcpy(y, x, sizeof x);
        fft_transform(y, n, root);
        for (int64_t j = 0; j < n; j++) {
            double re = 0.0, im = 0.0;
            for (int64_t k = 0; k < n; k++) {
                double angle = -2.0 * 3.14159265358979323846 * (double)(j * k) / (double)n;
                re += x[k].re * cos(angle) - x[k].im * sin(angle);
                im += x[k].re * sin(angle) + x[k].im * cos(angle);
            }
            assert_true(fabs(y[j].re - re) < 1e-12 && fabs(y[j].im - im) < 1e-12);
        }
        free(root);
    }
}

// Sample covariances over many paths against the exact ones, within five standard errors (of the
// product of two normal numbers).
static void the_covariance_is_that_of_the_process(void **state)
{
    (void)state;
    enum { STEPS = 24, PATHS = 3000 };
    static const double hursts[4] = {0.3, 0.5, 0.7, 0.9};
    for (int h = 0; h < 4; h++) {
        Fbm *fbm = fbm_new(hursts[h], NULL);
        static double sum[STEPS + 1][STEPS + 1];
        double a[STEPS + 1], b[STEPS + 1], mixed = 0.0;
        memset(sum, 0, sizeof sum);
        for (uint64_t p = 0; p < PATHS; p++) {
            assert_true(fbm_paths(fbm, STEPS, random_key(7, p), a, b, NULL));
            assert_true(a[0] == 0.0 && b[0] == 0.0);
            mixed += a[STEPS] * b[STEPS];
            for (int s = 1; s <= STEPS; s++) {
                for (int t = 1; t <= STEPS; t++) {
                    sum[s][t] += 0.5 * (a[s] * a[t] + b[s] * b[t]);
                }
            }
        }
        for (int s = 1; s <= STEPS; s++) {
            for (int t = 1; t <= STEPS; t++) {
                double exact = fbm_covariance(hursts[h], s, t);
                double spread = fbm_covariance(hursts[h], s, s) * fbm_covariance(hursts[h], t, t);
                double error = sqrt((spread + exact * exact) / (2.0 * PATHS));
                assert_true(fabs(sum[s][t] / PATHS - exact) < 5.0 * error);
            }
        }
        double end = fbm_covariance(hursts[h], STEPS, STEPS);
        assert_true(fabs(mixed / PATHS) < 5.0 * end / sqrt((double)PATHS)); // independent
        fbm_free(fbm);
    }
}

static void the_closed_form_of_the_covariance_is_right(void **state)
{
    (void)state;
    assert_true(fabs(fbm_covariance(0.5, 3.0, 8.0) - 3.0) < 1e-12); // Brownian: min(s, t)
    assert_true(fabs(fbm_covariance(0.7, 5.0, 5.0) - pow(5.0, 1.4)) < 1e-12);
    assert_true(fbm_covariance(0.7, 0.0, 5.0) == 0.0);
}

// H from how the mean square of increments grows with the lag: E (B(t + d) - B(t))^2 = d^2H.
static double estimate_hurst(double asked)
{
    enum { STEPS = 4096, PATHS = 24, LAGS = 6 };
    Fbm *fbm = fbm_new(asked, NULL);
    double *a = memory_alloc(STEPS + 1, sizeof *a, NULL);
    double *b = memory_alloc(STEPS + 1, sizeof *b, NULL);
    double square[LAGS] = {0};
    int64_t count[LAGS] = {0};
    for (uint64_t p = 0; p < PATHS; p++) {
        assert_true(fbm_paths(fbm, STEPS, random_key(11, p), a, b, NULL));
        for (int l = 0; l < LAGS; l++) {
            for (int64_t t = 0; t + (1 << l) <= STEPS; t++, count[l] += 2) {
                double da = a[t + (1 << l)] - a[t], db = b[t + (1 << l)] - b[t];
                square[l] += da * da + db * db;
            }
        }
    }
    double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
    for (int l = 0; l < LAGS; l++) {
        double x = l * log(2.0), y = log(square[l] / (double)count[l]);
        sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    free(a);
    free(b);
    fbm_free(fbm);
    return 0.5 * (LAGS * sxy - sx * sy) / (LAGS * sxx - sx * sx);
}

static void the_hurst_exponent_is_the_asked_one(void **state)
{
    (void)state;
    static const double hursts[4] = {0.3, 0.5, 0.7, 0.9};
    for (int h = 0; h < 4; h++) {
        assert_true(fabs(estimate_hurst(hursts[h]) - hursts[h]) < 0.05);
    }
}

// A bridge has the covariance of the process given its end, and ends at 0 to the last bit.
static void bridges_are_pinned_and_have_the_conditioned_covariance(void **state)
{
    (void)state;
    enum { STEPS = 12, PATHS = 4000 };
    double hurst = 0.7, sum[STEPS + 1][STEPS + 1] = {{0}}, a[STEPS + 1], b[STEPS + 1];
    Fbm *fbm = fbm_new(hurst, NULL);
    for (uint64_t p = 0; p < PATHS; p++) {
        assert_true(fbm_bridges(fbm, STEPS, random_key(3, p), a, b, NULL));
        assert_true(a[0] == 0.0 && b[0] == 0.0 && a[STEPS] == 0.0 && b[STEPS] == 0.0);
        for (int s = 1; s < STEPS; s++) {
            for (int t = 1; t < STEPS; t++) {
                sum[s][t] += 0.5 * (a[s] * a[t] + b[s] * b[t]);
            }
        }
    }
    for (int s = 1; s < STEPS; s++) {
        for (int t = 1; t < STEPS; t++) {
            double end = fbm_covariance(hurst, STEPS, STEPS);
            double exact = fbm_covariance(hurst, s, t) -
                           fbm_covariance(hurst, s, STEPS) * fbm_covariance(hurst, t, STEPS) / end;
            assert_true(fabs(sum[s][t] / PATHS - exact) < 0.05 * end);
        }
    }
    fbm_free(fbm);
}

static void paths_depend_on_their_key_alone(void **state)
{
    (void)state;
    enum { STEPS = 100000 }; // long ones are affordable
    double *one = memory_alloc(2 * (STEPS + 1), sizeof *one, NULL);
    double *two = memory_alloc(2 * (STEPS + 1), sizeof *two, NULL);
    Fbm *fresh = fbm_new(0.6, NULL), *used = fbm_new(0.6, NULL);
    assert_true(fbm_paths(used, 77, 9, two, two + STEPS + 1, NULL));
    assert_true(fbm_paths(fresh, STEPS, 5, one, one + STEPS + 1, NULL));
    assert_true(fbm_paths(used, STEPS, 5, two, two + STEPS + 1, NULL));
    assert_memory_equal(one, two, 2 * (STEPS + 1) * sizeof *one);
    assert_true(fbm_paths(used, STEPS, 6, two, two + STEPS + 1, NULL));
    assert_memory_not_equal(one, two, sizeof *one * STEPS);
    fbm_free(fresh);
    fbm_free(used);
    free(one);
    free(two);
}

static void nonsense_is_refused(void **state)
{
    (void)state;
    Error e = {0};
    assert_null(fbm_new(1.0, &e));
    assert_non_null(strstr(e.message, "below 1"));
    assert_null(fbm_new(NAN, &e));
    double a[2], b[2];
    Fbm *fbm = fbm_new(0.5, &e);
    assert_false(fbm_paths(fbm, 0, 1, a, b, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    assert_true(fbm_paths(fbm, 1, 1, a, b, &e));
    assert_true(a[0] == 0.0 && a[1] != 0.0);
    fbm_free(fbm);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sines_and_cosines_are_exact_to_a_double),
        cmocka_unit_test(the_transform_is_that_of_fourier),
        cmocka_unit_test(the_closed_form_of_the_covariance_is_right),
        cmocka_unit_test(the_covariance_is_that_of_the_process),
        cmocka_unit_test(the_hurst_exponent_is_the_asked_one),
        cmocka_unit_test(bridges_are_pinned_and_have_the_conditioned_covariance),
        cmocka_unit_test(paths_depend_on_their_key_alone),
        cmocka_unit_test(nonsense_is_refused),
    };
    return cmocka_run_group_tests_name("fbm", tests, NULL, NULL);
}
