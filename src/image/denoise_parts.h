// What both the filter of one scale and the sum of scales need.
#ifndef RAMIFY_IMAGE_DENOISE_PARTS_H
#define RAMIFY_IMAGE_DENOISE_PARTS_H

#include "image/denoise.h"

#include <math.h>

// The filter at one scale: linear regression on albedo, normal and place over neighbours that are
// weighted by non-local means; of two such filters the one with the smaller error by Stein's
// estimate. Arguments and errors as of image_denoise, but for those of the input, which it takes as
// checked; strength > 0. The caller frees the image.
Image *denoise_filter(const DenoiseInput *input, float strength, const Run *run, Error *e);

static inline int denoise_mirror(int i, int count)
{
    while (i < 0 || i >= count) { // repeatedly in images smaller than the border
        i = i < 0 ? -1 - i : 2 * count - 1 - i;
    }
    return i;
}

// Divisor of radiance that removes texture. Sky, lamps and haze have albedo 1: in a pixel that also
// shows a surface, the quotient lies between both.
static inline void denoise_divisor(const float *albedo, float divisor[3])
{
    for (int c = 0; c < 3; c++) {
        divisor[c] = fmaxf(albedo[c], 0.03f);
    }
}

// Square of the factor k by which differences are weighed against the noise (Rousselle 2012, eq.
// 2). A variance estimated from n samples is itself uncertain, by about 1 / sqrt(n): too small
// where no sample met what is rare, so that a narrow k would leave each pixel that did as it is.
static inline float denoise_tolerance(float samples, float strength)
{
    return strength * strength * (0.5f + 12.0f / fmaxf(samples, 12.0f));
}

static inline float denoise_finite(float x)
{
    return isfinite(x) ? x : 0.0f;
}

// Mean of a channel over a 3 x 3 neighbourhood: individual variances are noisy themselves.
static inline float denoise_variance(const Image *variance, int channel, int x, int y)
{
    float sum = 0.0f;
    for (int k = 0; k < 9; k++) {
        int i = denoise_mirror(x + k % 3 - 1, variance->width);
        int j = denoise_mirror(y + k / 3 - 1, variance->height);
        int64_t at = (int64_t)j * variance->width + i;
        sum += denoise_finite(variance->pixel[at * variance->channels + channel]);
    }
    return sum / 9.0f;
}

// Weights of the channels' squared differences, with a sum of 3. Light that does not take the
// surface's colour, as a gloss of white light, is magnified by the division in the channels that
// the surface absorbs, and the variance, which is of luminance, does not know of it. These weights
// count the differences as they are seen, undivided; where light does take the surface's colour,
// they make no difference.
static inline void denoise_weights(const float divisor[3], float weight[3])
{
    float sum = divisor[0] * divisor[0] + divisor[1] * divisor[1] + divisor[2] * divisor[2];
    for (int c = 0; c < 3; c++) {
        weight[c] = 3.0f * divisor[c] * divisor[c] / sum;
    }
}

#endif
