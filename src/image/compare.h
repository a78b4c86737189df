// Numerical differences of two images.
#ifndef RAMIFY_IMAGE_COMPARE_H
#define RAMIFY_IMAGE_COMPARE_H

#include "image/image.h"

typedef struct ImageDifference {
    double rmse, mean, maximum; // over all channels
    double failing;             // fraction of pixels with a channel over the threshold
    int worst_x, worst_y;       // the pixel with the largest difference, from the top left
} ImageDifference;

// Compares all channels. ERROR_INPUT when sizes or channel counts differ.
bool image_compare(const Image *a, const Image *b, double threshold, ImageDifference *difference,
                   Error *e);

#endif
