// Feature-guided denoising of a finished rendering.
#ifndef RAMIFY_IMAGE_DENOISE_H
#define RAMIFY_IMAGE_DENOISE_H

#include "base/run.h"
#include "image/image.h"

// Non-local means guided by albedo, normal and depth, weighted by the per-pixel variance (Rousselle
// 2013), on radiance divided by albedo, so that surface texture is preserved. All images have the
// same size; color has 3 or 4 channels (alpha is kept), albedo and normal 3, depth 1 (INFINITY
// where no surface was hit), variance 1 (of the mean luminance). strength: typically 1, 0 = a copy.
// Pixels of variance 0 stay unchanged. The result does not depend on run->threads. ERROR_INPUT when
// sizes or channels do not match. The caller frees the image.
Image *image_denoise(const Image *color, const Image *albedo, const Image *normal,
                     const Image *depth, const Image *variance, float strength, const Run *run,
                     Error *e);

#endif
