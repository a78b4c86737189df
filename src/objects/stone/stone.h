// A stone: a block with flat faces, more or less rounded.
#ifndef RAMIFY_OBJECTS_STONE_STONE_H
#define RAMIFY_OBJECTS_STONE_STONE_H

#include "objects/common/recipe.h"

typedef struct StoneParams {
    Vec3 position;   // m: of the middle of its underside, before it is sunk
    Vec3 rotation;   // degrees, about x, then y, then z
    float size;      // m, its largest extent
    float width;     // relative to its length
    float height;    // relative to its length
    int faces;       // planes that cut it
    float roundness; // 0 = sharp edges .. 1 = a pebble
    float roughness; // height of the bumps, relative to the size
    float sink;      // share of its height that is below the ground
    int resolution;  // faces of its mesh along each side of a cube
} StoneParams;

extern const struct Table stone_table; // of its parameters

StoneParams stone_params_default(void);

// The stone as a closed mesh of quads, in its own space: its foot at the origin. The caller frees
// it with mesh_free.
Mesh *stone_mesh(const StoneParams *params, uint64_t seed, Error *e);

#endif
