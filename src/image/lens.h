// Lens effects before tone mapping: bloom and vignetting.
#ifndef RAMIFY_IMAGE_LENS_H
#define RAMIFY_IMAGE_LENS_H

#include "image/image.h"

// Spreads `share` of the light over its neighbourhood, in place, in linear radiance: three blurs of
// increasing width, relative to the image's height. The sum over the image is preserved. excess:
// further light, of which only `share` is added, spread; 3 channels, or NULL.
bool lens_bloom(Image *image, const Image *excess, float share, Error *e);

// Factor on a pixel: 1 in the centre, 1 - strength in the corners, falling as cos^4.
float lens_vignette(const Image *image, int x, int y, float strength);

#endif
