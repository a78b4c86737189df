// Settings of the path tracer: samples, depth, noise.
#ifndef RAMIFY_RENDER_RENDER_PARAMS_H
#define RAMIFY_RENDER_RENDER_PARAMS_H

#include <stdbool.h>
#include <stdint.h>

typedef struct RenderParams {
    int samples;         // per pixel
    int planned_samples; // for which the noise is laid out; 0 = samples
    int max_depth;       // bounces
    int roulette_depth;  // bounces before Russian roulette may end a path; max_depth = never
    uint64_t seed;
    uint64_t noise_seed; // changes the pattern of noise and nothing else
    float clamp;         // upper bound on a sample's indirect luminance; 0 = none (unbiased)
    float max_noise; // adaptive: a tile stops when its estimated relative error is below this; 0 =
                     // off
    float detail;    // pixels: how far off the coarse forms of leaves, blades and twigs may be; 0 =
                     // full detail everywhere
    double max_seconds; // 0 = no limit
} RenderParams;

#endif
