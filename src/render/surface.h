// A point where a ray meets a surface, filled by accel_surface; materials are evaluated here.
#ifndef RAMIFY_RENDER_SURFACE_H
#define RAMIFY_RENDER_SURFACE_H

#include "base/vec.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct SurfacePoint {
    Vec3 position; // world
    Vec3 lifted;   // position raised from the facet to the smooth surface that the vertex normals
                   // tell of: where rays start that leave on normal's side (no shadow terminator)
    Vec3 object_position;       // in the part's own space, before displacement: where 3D patterns
                                // are looked up
    const Transform *transform; // from that space to the world; NULL = identity
    Vec3 facet_normal;     // unit, world, on the side of the ray's origin: of the flat face itself
    Vec3 geometric_normal; // unit, world, same side: of the surface before bumps, which is the
                           // smooth one where vertex normals tell of one; parts reflection from
                           // transmission
    Vec3 normal;           // unit, world: geometric_normal until a material bumps it
    Vec3 tangent_u,
        tangent_v; // world: dP/du, dP/dv of the uv parametrisation; some frame where there is no uv
    Vec2 uv;
    bool has_uv;  // both coordinates; of curves only v is set
    float radius; // m, of the branch; 0 when unknown
    float birth;
    float displaced;    // share of the relief that is in the geometry, 0..1; bumps make the rest
    float coarsening;   // the geometry shows that relief as of pixels so many times as wide; bumps
                        // make what is finer. At most 1 = as fine as the pixel
    Vec3 smooth_normal; // of diced meshes: unit, world, on the side of normal, of the surface
                        // before displacement; else 0
    Vec3 along;         // of diced meshes: unit, world, the way in which v grows; else 0
    Vec2 site;          // of land: altitude and wetness, 0..1 each
    float shore;        // of land: m by which it lies lower than MESH_SHORE above water near it
    float foam;         // of water: share that is white with air, 0..1
    const struct Strata *strata; // of land: its beds of rock, in the part's space; NULL = none
    const struct Waves *waves;   // of a sea; NULL = none
    float variation;             // 0..1 per instance
    float season;                // of a leaf, -1..1: see InstanceLook
    float young;                 // of a leaf: 1 = this part of it grew this year, 0 = it is older
    float withered;              // of a leaf: see Mesh.withered
    bool backface;               // the ray met the side away from the mesh's own orientation
    float
        epsilon; // m: how far along facet_normal a ray starts so as not to meet this surface again
    float footprint; // m: rough width of the pixel here, for fading fine patterns; 0 = unknown
    int material, object, part;
} SurfacePoint;

// Of the surface before bumps and displacement.
static inline Vec3 surface_smooth_normal(const SurfacePoint *point)
{
    bool diced = vec3_dot(point->smooth_normal, point->smooth_normal) > 0.5f;
    return diced ? point->smooth_normal : point->geometric_normal;
}

#endif
