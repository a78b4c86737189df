// Perceptual difference of two pictures viewed alternately: FLIP for low dynamic range (Andersson
// 2020).
#ifndef RAMIFY_IMAGE_FLIP_H
#define RAMIFY_IMAGE_FLIP_H

#include "image/image.h"

// Pixels per degree of a viewer 0.7 m from a screen 0.7 m and 3840 pixels wide.
#define FLIP_PIXELS_PER_DEGREE 67.0206f

// Difference map of two images of display values (sRGB, 0..1; 3 channels) of one size: one channel,
// 0 (invisible) to 1 (maximal). The caller frees it. ERROR_INPUT when sizes or channels do not
// match.
Image *image_flip(const Image *reference, const Image *test, float pixels_per_degree, Error *e);

// Mean of a map: the overall FLIP value.
double image_mean(const Image *map);

#endif
