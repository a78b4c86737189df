// Feature-guided denoising of a finished rendering.
#ifndef RAMIFY_IMAGE_DENOISE_H
#define RAMIFY_IMAGE_DENOISE_H

#include "base/run.h"
#include "image/image.h"

// All images have the same size.
typedef struct DenoiseInput {
    const Image *color;           // 3 or 4 channels; alpha is kept
    const Image *albedo, *normal; // 3 channels
    const Image *depth;           // 1 channel; INFINITY where no surface was hit
    const Image *variance;        // 1 channel: of the mean luminance, estimated
    const Image *samples;         // 1 channel: that color and variance are estimated from; may be
                                  // NULL = so many that the variance is exact
    const Image *guide_variance;  // 2 channels: of the mean albedo's luminance and of the mean
                                  // normal, estimated; NULL = both are without noise
} DenoiseInput;

// Linear regression on albedo, normal and place over neighbours, which are weighted by non-local
// means (Rousselle 2013; Bitterli 2016), of radiance divided by albedo, so that surface texture is
// preserved; of two such filters the one with the smaller error by Stein's estimate (Li 2012).
// Albedo and normal are freed of their own noise before (denoise_guides.h): where the lens blurs,
// what follows them would keep it. strength: typically 1, 0 = a copy. Pixels of variance 0 stay
// unchanged. The result does not depend on run->threads. ERROR_INPUT when sizes or channels do not
// match. The caller frees the image.
Image *image_denoise(const DenoiseInput *input, float strength, const Run *run, Error *e);

#endif
