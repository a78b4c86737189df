// Film grain, which hides the last smears of a denoiser and the smoothness of what is computed.
#ifndef RAMIFY_IMAGE_GRAIN_H
#define RAMIFY_IMAGE_GRAIN_H

#include "image/image.h"

// Adds noise of standard deviation 2 strength sqrt(v (1 - v)) to pixels of luma v, as of grains
// that cover the share v of a pixel (the Boolean model of Newson et al. 2017): `strength` at middle
// grey, none in black and white. Grains are about 1.5 pixels wide; red, green and blue share most
// of their noise. image: 3 or 4 channels of display values, 0..1; alpha is kept. strength: 0..1.
// The noise is a function of key and pixel alone. The caller frees the result; NULL and e when out
// of memory.
Image *image_grain(const Image *image, float strength, uint64_t key, Error *e);

#endif
