// Pictures of differences.
#ifndef RAMIFY_GOLDEN_HEAT_H
#define RAMIFY_GOLDEN_HEAT_H

#include "image/image.h"

// Red where ours is larger than stored, blue where it is smaller, white where they are the same; of
// a pixel the channel that differs most. Both of one size with 3 channels. The full colour is at a
// difference of *scale, chosen so that nearly all pixels are within it: 1, 2 or 5 times a power of
// ten.
Image *heat_of_difference(const Image *ours, const Image *stored, double *scale, Error *e);

// The same of z values of blocks of `block` pixels (noise_compare), as a picture of the size given;
// *scale is the z of the full colour.
Image *heat_of_blocks(const Image *z, int block, int width, int height, double *scale, Error *e);

#endif
