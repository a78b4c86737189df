// Foam on water: patches that fray and are torn into lace, coarse and fine.
#ifndef RAMIFY_RENDER_MATERIAL_FOAM_H
#define RAMIFY_RENDER_MATERIAL_FOAM_H

#include "base/vec.h"

// Share of a pixel of this width, m, that is foam at a place of the water, m, where foam covers
// this share of the water about it; 0 where that is 0.
float foam_share(float cover, Vec2 at, float width);

#endif
