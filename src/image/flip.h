// How different two pictures look to a person who flips between them: FLIP (Andersson et al.,
// "FLIP: A Difference Evaluator for Alternating Images", Proc. ACM CGIT 3(2), 2020), the metric for
// low dynamic range.
#ifndef RAMIFY_IMAGE_FLIP_H
#define RAMIFY_IMAGE_FLIP_H

#include "image/image.h"

// Pixels per degree of a person 0.7 m before a screen that is 0.7 m and 3840 pixels wide.
#define FLIP_PIXELS_PER_DEGREE 67.0206f

// The map of differences, one channel, 0 (none seen) to 1 (as far apart as can be), of two images
// of display values (sRGB, 0..1; 3 channels) of one size; the caller frees it. ERROR_INPUT when the
// sizes or channels do not fit.
Image *image_flip(const Image *reference, const Image *test, float pixels_per_degree, Error *e);

// Mean of a map's values: the number that stands for both pictures.
double image_mean(const Image *map);

#endif
