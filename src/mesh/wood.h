// Weathered wood as a solid: fibres along +Y about a pith near the y axis, knots that they flow
// around, and checks, which open from the outside toward the pith when wood dries. A function of
// the place alone, by + - * / and sqrt, for both geometry and colour.
#ifndef RAMIFY_MESH_WOOD_H
#define RAMIFY_MESH_WOOD_H

#include "base/vec.h"

typedef struct WoodPlace {
    Vec3 grain;   // m: p with the fibres unbent, where noise of the grain is looked up
    float radius; // m, from the pith
    float check;  // 0 = whole wood .. 1 in the middle of a check
    float depth;  // of that check, relative to the deepest
    float knot;   // 0 beside a knot .. 1 at its heart
} WoodPlace;

WoodPlace wood_place(Vec3 p);

// How much a surface with this unit normal cuts across the fibres, 0..1.
float wood_end(Vec3 normal);

// Height of the surface left by rain and frost, m, about its mean: soft early wood is worn out
// between ridges of late wood, some as fine as `finest`, m; ends wear less. Without checks.
float wood_grain_height(const WoodPlace *place, float end, float finest);

// The same with checks this deep, m, and hollows and swellings of the whole stem.
float wood_relief(Vec3 p, Vec3 normal, float finest, float check_depth);

#endif
