// Feature-guided denoising of a finished rendering.
#ifndef RAMIFY_IMAGE_DENOISE_H
#define RAMIFY_IMAGE_DENOISE_H

#include "base/run.h"
#include "image/image.h"

// Non-local means guided by albedo, normal and depth, weighted by the per-pixel variance (Rousselle
// et al. 2013), on radiance divided by albedo. All images have the same size; variance has 1
// channel (of the mean luminance).
Image *image_denoise(const Image *color, const Image *albedo, const Image *normal,
                     const Image *depth, const Image *variance, float strength, const Run *run,
                     Error *e);

#endif
