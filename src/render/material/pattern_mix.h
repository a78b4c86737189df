// Kinds of ground that a pattern mixes: rock, scree, turf.
#ifndef RAMIFY_RENDER_MATERIAL_PATTERN_MIX_H
#define RAMIFY_RENDER_MATERIAL_PATTERN_MIX_H

#include "base/vec.h"

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

#endif
