// Makes a developed picture smaller. A picture that is traced, denoised and tone mapped finer than
// it is shown keeps its leaves, needles and twigs: the denoiser tells them apart, and their
// contrast is averaged as an eye would do from afar, after the view has compressed it.
#ifndef RAMIFY_IMAGE_DOWNSAMPLE_H
#define RAMIFY_IMAGE_DOWNSAMPLE_H

#include "image/image.h"

// The mean of each factor x factor pixels, as light: sRGB display values are made linear, weighted
// by alpha, and encoded again. image: 3 or 4 channels, 0..1, alpha straight; factor divides its
// width and height. The caller frees the result; NULL and e when out of memory.
Image *image_downsample(const Image *image, int factor, Error *e);

#endif
