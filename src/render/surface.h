// A point where a ray meets a surface: what materials are evaluated at. Filled by the world's
// intersection code.
#ifndef RAMIFY_RENDER_SURFACE_H
#define RAMIFY_RENDER_SURFACE_H

#include "base/vec.h"

#include <stdint.h>

typedef struct SurfacePoint {
    Vec3 position;         // world
    Vec3 object_position;  // in the part's own space: where 3D patterns are looked up
    Vec3 geometric_normal; // unit, world, on the side of the ray's origin
    Vec3 normal; // unit, world, interpolated, same side as geometric_normal (before bumps)
    Vec3 tangent_u,
        tangent_v; // world: dP/du, dP/dv of the uv parametrisation; some frame where there is no uv
    Vec2 uv;
    float radius; // m, of the branch; 0 when unknown
    float birth;
    float variation; // 0..1 per instance
    bool backface;   // the ray met the side away from the mesh's own orientation
    float footprint; // m: rough width of the pixel here, for fading fine patterns; 0 = unknown
    int material, object, part;
} SurfacePoint;

#endif
