// How a cloud's density depends on the depth inside its border, on the border's softness and on
// altitude: shared by lookups and by the bounds on them.
#ifndef RAMIFY_RENDER_CLOUD_PROFILE_H
#define RAMIFY_RENDER_CLOUD_PROFILE_H

#include "render/cloud/cloud_grid.h"

#include <math.h>

// Without the calls for NaN that fminf and fmaxf compile to.
static inline float smaller(float a, float b)
{
    return a < b ? a : b;
}

static inline float larger(float a, float b)
{
    return a > b ? a : b;
}

static inline float unit_clamp(float x)
{
    return larger(smaller(x, 1.0f), 0.0f);
}

// Where the border is soft, billows are lower, and droplets fewer: dry air is mixed in.
static inline float billows_at(float softness)
{
    return 1.0f - 0.6f * softness;
}

// Farthest from a coarse border of this softness that detail moves the cloud's, m.
static inline float reach_at(const Roughness *r, float softness)
{
    return billows_at(softness) * (r->billow[0] + r->billow[1]) +
           softness * (r->wisp[0] + r->wisp[1]);
}

static inline float density_limit(float softness)
{
    return 1.0f - 0.55f * softness;
}

// m over which the density rises.
static inline float edge_at(const Roughness *r, float softness)
{
    return r->edge[0] + softness * (r->edge[1] - r->edge[0]);
}

// Liquid water grows in proportion to the height above the condensation level; on as many droplets
// as below, so extinction grows like the power 2/3 of it (Brenguier et al. 2000); 3/4 is near
// enough and takes two square roots. share: of the thickness.
static inline float cloud_gain_at(float share)
{
    float x = unit_clamp(share / 0.25f);
    return sqrtf(x * sqrtf(x));
}

// What fog loses from its base to its top: dry air is mixed in from above.
static const float FOG_THINNING = 0.5f;

static inline float fog_gain_at(float share)
{
    return 1.0f - FOG_THINNING * unit_clamp(share);
}

// Share of the greatest extinction `above` m over the base, > 0, and `deep` m inside the coarse
// form.
static inline float gain_at(const CloudGrid *g, float above, float deep)
{
    if (g->pooled) {
        return fog_gain_at(1.0f - deep / g->thickness);
    }
    float share = above / g->thickness;
    return g->fog ? fog_gain_at(share) : cloud_gain_at(share);
}

// Ragged bases: what detail takes from the density `above` m over the condensation level.
static inline float raised_at(const Roughness *r, float above, float ragged)
{
    return r->base > 0.0f ? unit_clamp(above / r->base - 0.8f * ragged) : 1.0f;
}

// Raggedness: 0 .. 2 of the large detail, and the small one's share beside it.
static const float RAGGED_SMALL = 0.4f;

// Height in units of Roughness.base above which it takes nothing from the density.
static const float RAGGED_UP_TO = 3.3f;

// Share of the greatest density; share: of the edge, 0..1.
static inline float density_at(float share, float softness)
{
    return density_limit(softness) * share * lerpf(1.0f, share, softness);
}

#endif
