// Leaves and grass tufts as small quad meshes, to be instanced by the hundred thousand.
#ifndef RAMIFY_MESH_LEAF_H
#define RAMIFY_MESH_LEAF_H

#include "base/mesh.h"

// A leaf whose stalk starts at the origin, with the blade along +Y, upper side facing +Z. Lengths
// in metres.
typedef struct LeafParams {
    float length, width; // of the blade
    float petiole;       // length of the stalk; its base is the origin
    float fold;          // degrees by which each half is folded up about the midrib
    float curl;          // degrees by which the blade bends down from base to tip
    float wave;          // ripple amplitude of the edge, relative to the width
    int lobes;           // per side, rounded as an oak's; 0 = a plain oval
    float lobe_depth;    // depth of the bays between lobes, relative to the half width
    int detail;          // 1 = about 25 quads, for whole trees; 2 = about 110, for close-ups
} LeafParams;

// uv: u 0..1 across (0.5 = midrib), v 0..1 along the blade (0 on the stalk). seed varies the
// outline slightly. The caller frees the mesh with mesh_free.
Mesh *leaf_mesh_new(const LeafParams *params, uint64_t seed, Error *e);

// A simpler leaf of the same area, without stalk and lobes, for leaves of a few pixels. level: 0 =
// a smooth outline of 8 quads, 1 = one quad folded along the midrib. *error (m): how far the leaf's
// vertices are from it. The caller frees the mesh with mesh_free.
enum { LEAF_COARSE_LEVELS = 2 };
Mesh *leaf_mesh_coarse(const LeafParams *params, uint64_t seed, int level, float *error, Error *e);

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
