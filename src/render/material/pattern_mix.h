// Kinds of ground that a pattern mixes: rock, scree, turf.
#ifndef RAMIFY_RENDER_MATERIAL_PATTERN_MIX_H
#define RAMIFY_RENDER_MATERIAL_PATTERN_MIX_H

#include "base/vec.h"
#include "render/material/pattern.h"

typedef struct Ground {
    Vec3 color;
    Vec3 slope; // of its relief, per metre
} Ground;

// t: the share of b.
static inline Ground ground_blend(Ground a, const Ground *b, float t)
{
    a.color = vec3_lerp(a.color, b->color, t);
    a.slope = vec3_lerp(a.slope, b->slope, t);
    return a;
}

// Crowns of bushes or trees about `size` m wide, seen from above. height: of their relief, per
// metre of their width.
static inline Ground ground_crowns(const SurfacePoint *point, float size, Vec3 color, float height,
                                   uint32_t seed)
{
    PatternOctaves crowns = pattern_octaves(point, size, 5, 0.65f, 1.0f, seed);
    float tone = 1.0f + 0.35f * clampf(crowns.value, -1.2f, 1.2f);
    return (Ground){vec3_scale(color, tone), vec3_scale(crowns.slope, height)};
}

#endif
