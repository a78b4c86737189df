// Statistics of a pixel: samples are summed in double and merged into the film's means and
// variance.
#ifndef RAMIFY_RENDER_FILM_MERGE_H
#define RAMIFY_RENDER_FILM_MERGE_H

#include "render/film.h"
#include "render/integrator.h"

typedef struct PixelSum {
    double color[3], light[3], sky[3], light_share, sky_share;
    double alpha, albedo[3], normal[3], position[3], depth, luminance, luminance_squared;
    int hits, object; // object + 1 of the first hit
    int64_t rays;
} PixelSum;

void pixel_sum_add(PixelSum *sum, const PathResult *path);

// Merges the sum of samples_added samples into pixel i, whose values are of samples_before.
void film_merge(Film *film, int64_t i, int samples_before, int samples_added, const PixelSum *sum);

#endif
