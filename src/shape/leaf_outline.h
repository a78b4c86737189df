// Outline of a leaf's blade in the plane, from its base at the origin up the y axis to its tip.
#ifndef RAMIFY_SHAPE_LEAF_OUTLINE_H
#define RAMIFY_SHAPE_LEAF_OUTLINE_H

#include "base/vec.h"

#include <stdbool.h>

typedef struct LeafOutline {
    float length, width; // m, of the blade
    float widest; // 0..1 of the length, where the blade is widest: below 0.5 ovate, above obovate
    float tip;    // shape of base and tip: 1 = elliptic, 2 = pointed
} LeafOutline;

// Half of the blade's width at height y, m; 0 below and above the blade.
float leaf_half_width(const LeafOutline *outline, float y);

// Whether the point lies within the blade scaled by `scale` about its base.
bool leaf_contains(const LeafOutline *outline, float scale, Vec3 p);

#endif
