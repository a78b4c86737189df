// Settings of the path tracer: samples, depth, noise.
#ifndef RAMIFY_RENDER_RENDER_PARAMS_H
#define RAMIFY_RENDER_RENDER_PARAMS_H

#include <stdbool.h>
#include <stdint.h>

typedef struct RenderParams {
    int samples;         // per pixel
    int planned_samples; // for which the noise is laid out; 0 = samples
    int first_sample;    // the samples that are taken of these: from this one on,
    int end_sample;      // to the one before this; 0 = all further ones
    int max_depth;       // bounces
    int roulette_depth;  // bounces before Russian roulette may end a path; max_depth = never
    uint64_t seed;
    uint64_t noise_seed; // changes the pattern of noise and nothing else
    float clamp;         // upper bound on a sample's indirect luminance; 0 = none (unbiased)
    float max_noise; // adaptive: a tile stops when its estimated relative error is below this; 0 =
                     // off
    float detail;    // pixels: how far off the coarse forms of leaves, blades and twigs may be; 0 =
                     // full detail everywhere
    bool lamp_field; // light of lamps in clouds from a field of photons, as the renderer was
                     // built; else by paths alone
    double max_seconds; // 0 = no limit
} RenderParams;

static inline int render_planned(const RenderParams *params)
{
    return params->planned_samples > 0 ? params->planned_samples : params->samples;
}

// One past the last sample that is taken.
static inline int render_end(const RenderParams *params)
{
    return params->end_sample > 0 ? params->end_sample : params->samples;
}

// Not all samples are to be taken?
static inline bool render_is_range(const RenderParams *params)
{
    return params->first_sample > 0 || render_end(params) < params->samples;
}

#endif
