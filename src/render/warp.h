// Maps from the unit square to discs and spheres.
#ifndef RAMIFY_RENDER_WARP_H
#define RAMIFY_RENDER_WARP_H

#include "base/vec.h"

// Uniform on the unit disc, keeping neighbours together (Shirley and Chiu 1997).
Vec2 warp_disc(float u, float v);

// Unit vector at cosine `c` from the unit axis, turned about it by `turn` (0..1 of a circle).
Vec3 warp_cone(Vec3 axis, float c, float sine, float turn);

#endif
