// Film grain, which hides the last smears of a denoiser and the smoothness of what is computed.
#ifndef RAMIFY_IMAGE_GRAIN_H
#define RAMIFY_IMAGE_GRAIN_H

#include "image/image.h"

// Adds noise of standard deviation 2 sqrt(2) strength sqrt(v) (1 - v) to pixels of luma v:
// `strength` at middle grey, none in black and white. That is the noise of light (its deviation is
// the root of the light, Poisson 1837) behind a tone curve whose slope falls to 0 towards white, so
// bright skies stay clean. Grains are about 1.5 pixels wide; red, green and blue share most
// of their noise. image: 3 or 4 channels of display values, 0..1; alpha is kept. strength: 0..1.
// The noise is a function of key and pixel alone. The caller frees the result; NULL and e when out
// of memory.
Image *image_grain(const Image *image, float strength, uint64_t key, Error *e);

#endif
