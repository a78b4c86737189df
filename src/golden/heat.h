// Heat maps of differences.
#ifndef RAMIFY_GOLDEN_HEAT_H
#define RAMIFY_GOLDEN_HEAT_H

#include "image/image.h"

// Red where ours is larger than stored, blue where smaller, white where equal; each pixel shows its
// channel of largest difference. Both of one size with 3 channels. Full colour is at *scale, 1, 2
// or 5 times a power of ten, chosen so that nearly all pixels are within it. The caller frees the
// image.
Image *heat_of_difference(const Image *ours, const Image *stored, double *scale, Error *e);

// The same for z values of blocks of `block` pixels (noise_compare), as a picture of the given
// size; *scale is the z of full colour.
Image *heat_of_blocks(const Image *z, int block, int width, int height, double *scale, Error *e);

#endif
