// Reconstruction filters by importance sampling: the position of a sample on the film is drawn from
// the filter around its pixel, so all weights are one and each sample counts for one pixel (Ernst
// et al. 2006).
#ifndef RAMIFY_RENDER_FILTER_H
#define RAMIFY_RENDER_FILTER_H

#include "base/vec.h"
#include "render/film_params.h"

enum { FILTER_STEPS = 256 };

typedef struct Filter {
    float offset[FILTER_STEPS + 1]; // pixels: inverse of the cumulated profile at i / FILTER_STEPS
} Filter;

void filter_fill(Filter *filter, FilterKind kind, float radius);

// The filter's profile at x in units of its radius, |x| <= 1, not normalised.
float filter_profile(FilterKind kind, float x);

// Distance in pixels from the pixel's centre for a uniform number u in [0, 1).
static inline float filter_sample(const Filter *filter, float u)
{
    float x = u * (float)FILTER_STEPS;
    int i = (int)x;
    return lerpf(filter->offset[i], filter->offset[i + 1], x - (float)i);
}

#endif
