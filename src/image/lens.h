// What a lens does to light before it is developed: glow and darker corners.
#ifndef RAMIFY_IMAGE_LENS_H
#define RAMIFY_IMAGE_LENS_H

#include "image/image.h"

// Spreads `share` of the light over its neighbourhood, in place, in linear radiance: three blurs of
// rising width, of image height each. The sum over the image stays as it was.
bool lens_bloom(Image *image, float share, Error *e);

// Factor on a pixel: 1 in the middle, 1 - strength in the corners (as cos^4 falls).
float lens_vignette(const Image *image, int x, int y, float strength);

#endif
