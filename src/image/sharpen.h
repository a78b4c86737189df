// Sharpens a developed picture, as cameras and photo editors do for what lens, pixel filter and
// resampling have softened.
#ifndef RAMIFY_IMAGE_SHARPEN_H
#define RAMIFY_IMAGE_SHARPEN_H

#include "image/image.h"

// Unsharp masking of luma: each pixel's difference from the binomial mean of its 3 x 3
// neighbourhood, times strength, is added to its red, green and blue. Differences as small as a
// step of 8 bits are left alone, so that skies stay smooth, and a pixel passes the darkest and
// brightest of its neighbourhood by at most a fifth of their distance, so that edges get no
// visible halo. image: 3 or 4 channels of display values, 0..1; alpha is kept. strength: 0 = a
// copy. The caller frees the result; NULL and e when out of memory.
Image *image_sharpen(const Image *image, float strength, Error *e);

#endif
