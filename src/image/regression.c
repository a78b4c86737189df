#include "image/regression.h"

#include <math.h>
#include <string.h>

#define LEAST_VARIANCE 1e-4f // of a feature: what varies less is taken as constant

void regression_clear(Regression *r)
{
    memset(r, 0, sizeof *r);
}

void regression_add(Regression *r, const Lane weight, const Lane feature[FEATURES])
{
    for (int x = 0; x < LANES; x++) {
        r->weight[x] += weight[x];
        r->square[x] += weight[x] * weight[x];
    }
    for (int l = 0; l < FEATURES; l++) {
        Lane weighted;
        for (int x = 0; x < LANES; x++) {
            weighted[x] = weight[x] * feature[l][x];
            r->mean[l][x] += weighted[x];
        }
        for (int k = 0; k <= l; k++) {
            for (int x = 0; x < LANES; x++) {
                r->product[l][k][x] += weighted[x] * feature[k][x];
            }
        }
    }
}

// Covariances with the ridge on their diagonal.
static void make_covariances(Regression *r, float ridge)
{
    Lane scale;
    for (int x = 0; x < LANES; x++) {
        scale[x] = 1.0f / r->weight[x];
        r->square[x] *= scale[x] * scale[x];
    }
    for (int l = 0; l < FEATURES; l++) {
        for (int x = 0; x < LANES; x++) {
            r->mean[l][x] *= scale[x];
        }
        for (int k = 0; k <= l; k++) {
            for (int x = 0; x < LANES; x++) {
                r->product[l][k][x] =
                    r->product[l][k][x] * scale[x] - r->mean[l][x] * r->mean[k][x];
            }
        }
        for (int x = 0; x < LANES; x++) {
            r->product[l][l][x] += ridge * r->square[x] + LEAST_VARIANCE;
        }
    }
}

// Cholesky's factor in place of the covariances, its diagonal inverted.
static void factorize(Regression *r)
{
    for (int l = 0; l < FEATURES; l++) {
        for (int k = 0; k <= l; k++) {
            float *restrict to = r->product[l][k];
            for (int m = 0; m < k; m++) {
                for (int x = 0; x < LANES; x++) {
                    to[x] -= r->product[l][m][x] * r->product[k][m][x];
                }
            }
            for (int x = 0; k < l && x < LANES; x++) {
                to[x] *= r->product[k][k][x];
            }
        }
        for (int x = 0; x < LANES; x++) {
            float rest = r->product[l][l][x];
            r->product[l][l][x] = 1.0f / sqrtf(rest > 1e-6f ? rest : 1e-6f);
        }
    }
}

void regression_solve(Regression *r, float ridge)
{
    make_covariances(r, ridge);
    factorize(r);
    memcpy(r->slope, r->mean, sizeof r->slope);
    for (int l = 0; l < FEATURES; l++) {
        for (int k = 0; k < l; k++) {
            for (int x = 0; x < LANES; x++) {
                r->slope[l][x] -= r->product[l][k][x] * r->slope[k][x];
            }
        }
        for (int x = 0; x < LANES; x++) {
            r->slope[l][x] *= r->product[l][l][x];
        }
    }
    for (int l = FEATURES - 1; l >= 0; l--) {
        for (int k = l + 1; k < FEATURES; k++) {
            for (int x = 0; x < LANES; x++) {
                r->slope[l][x] -= r->product[k][l][x] * r->slope[k][x];
            }
        }
        for (int x = 0; x < LANES; x++) {
            r->slope[l][x] *= r->product[l][l][x];
        }
    }
    for (int x = 0; x < LANES; x++) {
        r->base[x] = 1.0f;
    }
    for (int l = 0; l < FEATURES; l++) {
        for (int x = 0; x < LANES; x++) {
            r->base[x] += r->slope[l][x] * r->mean[l][x];
        }
    }
}

void regression_share(const Regression *r, const Lane weight, const Lane feature[FEATURES],
                      Lane share)
{
    Lane fit;
    memcpy(fit, r->base, sizeof fit);
    for (int l = 0; l < FEATURES; l++) {
        for (int x = 0; x < LANES; x++) {
            fit[x] -= r->slope[l][x] * feature[l][x];
        }
    }
    for (int x = 0; x < LANES; x++) {
        share[x] = fit[x] > 0.0f ? fit[x] * weight[x] / r->weight[x] : 0.0f;
    }
}
