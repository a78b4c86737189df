// Grass tufts as small quad meshes, to be instanced by the hundred thousand.
#ifndef RAMIFY_MESH_GRASS_H
#define RAMIFY_MESH_GRASS_H

#include "base/mesh.h"

// A tuft of bent blades about the origin, growing along +Y.
typedef struct GrassParams {
    int blades;
    float height, width; // m, of the tallest and widest blade
    float spread;        // m, radius of the circle that holds the blades' bases
    float lean;          // degrees, largest angle to the vertical at the base
    float bend;          // degrees, largest further bend at the tip
} GrassParams;

// uv: u 0..1 across, v 0..1 from the root to the tip. The caller frees the mesh with mesh_free.
Mesh *grass_tuft_new(const GrassParams *params, uint64_t seed, Error *e);

// A simpler tuft of the same area (Cook et al., "Stochastic Simplification of Aggregate Detail",
// 2007): level 0 has one blade for every two, level 1 for every four, wider in proportion and of
// two quads. *error (m): mean width of the blades. The caller frees the mesh with mesh_free.
enum { GRASS_COARSE_LEVELS = 2 };
Mesh *grass_tuft_coarse(const GrassParams *params, uint64_t seed, int level, float *error,
                        Error *e);

#endif
