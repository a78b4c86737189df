// Feature-guided denoising of a finished rendering.
#ifndef RAMIFY_IMAGE_DENOISE_H
#define RAMIFY_IMAGE_DENOISE_H

#include "base/run.h"
#include "image/image.h"

// Non-local means guided by albedo, normal and depth, weighted by the per-pixel variance (Rousselle
// et al. 2013), on radiance divided by albedo, so that the texture of surfaces stays. All images
// have the same size; color has 3 or 4 channels (alpha is kept), albedo and normal 3, depth 1
// (INFINITY where nothing was met), variance 1 (of the mean luminance). strength: 1 usual, 0 =
// a copy. Where the variance is 0 nothing changes. The same bits for any run->threads.
// ERROR_INPUT when sizes or channels do not fit.
Image *image_denoise(const Image *color, const Image *albedo, const Image *normal,
                     const Image *depth, const Image *variance, float strength, const Run *run,
                     Error *e);

#endif
