// Local regression: exact for what is linear, a weighted mean that never overshoots.
#include "image/regression.h"

#include "base/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { NEIGHBOURS = 600 };

typedef struct Data {
    Lane weight[NEIGHBOURS], feature[NEIGHBOURS][FEATURES], value[NEIGHBOURS];
} Data;

static float uniform(int lane, int neighbour, int which)
{
    uint64_t key = random_key(random_key(3, (uint64_t)lane), (uint64_t)neighbour);
    return random_unit(random_key(key, (uint64_t)which)) - 0.5f;
}

// Values 5 + slope * feature about (0, 0, ...), moved by `aside` from it.
static void make_data(Data *d, float aside)
{
    for (int i = 0; i < NEIGHBOURS; i++) {
        for (int x = 0; x < LANES; x++) {
            d->weight[i][x] = 1.0f + uniform(x, i, 20);
            d->value[i][x] = 5.0f;
            for (int k = 0; k < FEATURES; k++) {
                d->feature[i][k][x] = uniform(x, i, k) + aside;
                d->value[i][x] += uniform(x, 0, 30 + k) * d->feature[i][k][x];
            }
        }
    }
}

// Fits, and sums values and shares; *least: the smallest share.
static void fit(const Data *d, float ridge, Lane sum, Lane shares, float *least)
{
    Regression r;
    regression_clear(&r);
    for (int i = 0; i < NEIGHBOURS; i++) {
        regression_add(&r, d->weight[i], d->feature[i]);
    }
    regression_solve(&r, ridge);
    memset(sum, 0, sizeof(Lane));
    memset(shares, 0, sizeof(Lane));
    *least = INFINITY;
    for (int i = 0; i < NEIGHBOURS; i++) {
        Lane share;
        regression_share(&r, d->weight[i], d->feature[i], share);
        for (int x = 0; x < LANES; x++) {
            sum[x] += share[x] * d->value[i][x];
            shares[x] += share[x];
            *least = fminf(*least, share[x]);
        }
    }
}

static void test_linear_is_exact(void **state)
{
    (void)state;
    static Data d;
    Lane sum, shares, plain = {0};
    float least;
    make_data(&d, 0.01f);
    fit(&d, 0.0f, sum, shares, &least);
    double error = 0.0, without = 0.0;
    for (int x = 0; x < LANES; x++) {
        float weights = 0.0f;
        for (int i = 0; i < NEIGHBOURS; i++) {
            plain[x] += d.weight[i][x] * d.value[i][x];
            weights += d.weight[i][x];
        }
        assert_true(fabsf(shares[x] - 1.0f) < 1e-4f);
        error = fmax(error, fabs((double)sum[x] - 5.0));
        without = fmax(without, fabs((double)(plain[x] / weights) - 5.0));
    }
    if (error > 5e-4 || without < 0.01) {
        fail_msg("error %g, of the weighted mean %g", error, without);
    }
}

// The ridge takes the fit to the weighted mean.
static void test_ridge_holds_down(void **state)
{
    (void)state;
    static Data d;
    Lane sum, shares;
    float least;
    make_data(&d, 0.05f);
    fit(&d, 1e6f, sum, shares, &least);
    for (int x = 0; x < LANES; x++) {
        float mean = 0.0f, weights = 0.0f;
        for (int i = 0; i < NEIGHBOURS; i++) {
            mean += d.weight[i][x] * d.value[i][x];
            weights += d.weight[i][x];
        }
        assert_true(fabsf(sum[x] / shares[x] - mean / weights) < 1e-3f);
    }
}

// Far outside of the neighbours' features no share is negative, so values within bounds stay so.
static void test_no_overshoot(void **state)
{
    (void)state;
    static Data d;
    Lane sum, shares;
    float least;
    make_data(&d, 0.6f);
    fit(&d, 0.0f, sum, shares, &least);
    assert_true(least >= 0.0f);
    for (int x = 0; x < LANES; x++) {
        float low = INFINITY, high = -INFINITY;
        for (int i = 0; i < NEIGHBOURS; i++) {
            low = fminf(low, d.value[i][x]);
            high = fmaxf(high, d.value[i][x]);
        }
        float value = sum[x] / shares[x];
        assert_true(value >= low - 1e-4f && value <= high + 1e-4f);
    }
}

// Neighbours whose features are all the same: nothing can be fitted, the mean remains.
static void test_no_features(void **state)
{
    (void)state;
    static Data d;
    Lane sum, shares;
    float least;
    make_data(&d, 0.0f);
    memset(d.feature, 0, sizeof d.feature);
    fit(&d, 0.2f, sum, shares, &least);
    for (int x = 0; x < LANES; x++) {
        assert_true(fabsf(shares[x] - 1.0f) < 1e-4f && isfinite(sum[x]));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_linear_is_exact),
        cmocka_unit_test(test_ridge_holds_down),
        cmocka_unit_test(test_no_overshoot),
        cmocka_unit_test(test_no_features),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
