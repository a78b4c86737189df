#include "base/fbm.h"

#include "base/exact_math.h"
#include "base/fft.h"
#include "base/memory.h"
#include "base/random.h"

#include <math.h>
#include <stdlib.h>

enum { MAX_LEVELS = 25 }; // 2^24 steps
enum { STREAM_REAL = 0, STREAM_IMAGINARY = 1 };

// Spectrum of the increments' circulant covariance of 2^(level + 1) points.
typedef struct Spectrum {
    Complex *root; // for the transform; NULL = not computed yet
    double *scale; // sqrt(eigenvalue / points)
} Spectrum;

struct Fbm {
    double hurst;
    Spectrum level[MAX_LEVELS];
    Complex *work; // with room for the longest path so far
    int64_t work_capacity;
};

static double power(double x, double y)
{
    return x > 0.0 ? exact_exp(y * exact_log(x)) : 0.0;
}

double fbm_covariance(double hurst, double s, double t)
{
    double h = 2.0 * hurst;
    return 0.5 * (power(s, h) + power(t, h) - power(fabs(s - t), h));
}

// Covariance of two increments k steps apart: (|k+1|^2H - 2|k|^2H + |k-1|^2H) / 2. For large k this
// cancels, so its binomial series in 1/k^2 is used there.
static double increment_covariance(double hurst, int64_t k)
{
    double h = 2.0 * hurst, x = (double)k;
    if (k == 0) {
        return 1.0;
    }
    if (k < 32) {
        return 0.5 * (power(x + 1.0, h) - 2.0 * power(x, h) + power(x - 1.0, h));
    }
    double term = h * (h - 1.0) / 2.0, sum = 0.0, x2 = 1.0 / (x * x);
    for (int j = 2; j <= 12; j += 2) {
        sum += term;
        term *= (h - j) * (h - j - 1.0) / ((j + 1.0) * (j + 2.0)) * x2;
    }
    return power(x, h - 2.0) * sum;
}

Fbm *fbm_new(double hurst, Error *e)
{
    if (!(hurst > 0.0 && hurst < 1.0)) {
        error_set(e, ERROR_INPUT, "the Hurst exponent is %g; it must be above 0 and below 1",
                  hurst);
        return NULL;
    }
    Fbm *fbm = memory_alloc_zero(1, sizeof *fbm, e);
    if (fbm) {
        fbm->hurst = hurst;
    }
    return fbm;
}

void fbm_free(Fbm *fbm)
{
    for (int i = 0; fbm && i < MAX_LEVELS; i++) {
        free(fbm->level[i].root);
        free(fbm->level[i].scale);
    }
    if (fbm) {
        free(fbm->work);
    }
    free(fbm);
}

// Eigenvalues of the circulant matrix with the covariance, mirrored, as first row. For fractional
// Gaussian noise none is negative (Craigmile 2003), except by rounding.
static bool make_spectrum(Fbm *fbm, int level, Error *e)
{
    Spectrum *spectrum = &fbm->level[level];
    int64_t half = (int64_t)1 << level, count = 2 * half;
    if (!memory_reserve(&fbm->work, &fbm->work_capacity, count, sizeof *fbm->work, e)) {
        return false;
    }
    if (spectrum->root) {
        return true;
    }
    Complex *root = fft_roots(count, e);
    double *scale = root ? memory_alloc(count, sizeof *scale, e) : NULL;
    if (!scale) {
        free(root);
        return false;
    }
    for (int64_t k = 0; k <= half; k++) {
        double c = increment_covariance(fbm->hurst, k);
        fbm->work[k] = (Complex){c, 0.0};
        fbm->work[k ? count - k : 0] = (Complex){c, 0.0};
    }
    fft_transform(fbm->work, count, root);
    for (int64_t k = 0; k < count; k++) {
        double eigenvalue = fbm->work[k].re;
        scale[k] = eigenvalue > 0.0 ? sqrt(eigenvalue / (double)count) : 0.0;
    }
    *spectrum = (Spectrum){root, scale};
    return true;
}

bool fbm_paths(Fbm *fbm, int64_t steps, uint64_t key, double *a, double *b, Error *e)
{
    if (steps < 1 || steps > FBM_MOST_STEPS) {
        return error_set(e, ERROR_INPUT, "a path of %lld steps; it must have 1 to %d",
                         (long long)steps, FBM_MOST_STEPS);
    }
    int level = 0;
    while (((int64_t)1 << level) < steps) {
        level++;
    }
    if (!make_spectrum(fbm, level, e)) {
        return false;
    }
    // Independent complex weights: real and imaginary part of the transform are two independent
    // series of increments.
    int64_t count = (int64_t)2 << level;
    const double *scale = fbm->level[level].scale;
    for (int64_t k = 0; k < count; k++) {
        uint64_t mine = random_key(key, (uint64_t)k);
        fbm->work[k].re = scale[k] * (double)random_normal(random_key(mine, STREAM_REAL));
        fbm->work[k].im = scale[k] * (double)random_normal(random_key(mine, STREAM_IMAGINARY));
    }
    fft_transform(fbm->work, count, fbm->level[level].root);
    a[0] = b[0] = 0.0;
    for (int64_t k = 0; k < steps; k++) {
        a[k + 1] = a[k] + fbm->work[k].re;
        b[k + 1] = b[k] + fbm->work[k].im;
    }
    return true;
}

bool fbm_bridges(Fbm *fbm, int64_t steps, uint64_t key, double *a, double *b, Error *e)
{
    if (!fbm_paths(fbm, steps, key, a, b, e)) {
        return false;
    }
    double n = (double)steps, last_a = a[steps], last_b = b[steps];
    double variance = fbm_covariance(fbm->hurst, n, n);
    for (int64_t k = 1; k < steps; k++) {
        double share = fbm_covariance(fbm->hurst, (double)k, n) / variance;
        a[k] -= share * last_a;
        b[k] -= share * last_b;
    }
    a[steps] = b[steps] = 0.0;
    return true;
}
