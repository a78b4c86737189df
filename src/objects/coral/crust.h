// Crusts of encrusting corals on a rock: thick over the colony's nodes, rounded off at the margin,
// with a bare seam between colonies.
#ifndef RAMIFY_OBJECTS_CORAL_CRUST_H
#define RAMIFY_OBJECTS_CORAL_CRUST_H

#include "base/mesh.h"
#include "base/run.h"
#include "outtree/out_tree.h"

typedef struct CrustParams {
    float thickness; // m
    float reach;     // m: how far from its nodes a colony covers the rock
    float seam;      // m: half the width left bare between two colonies
    float pale;      // m: width of the young crust along its margin
    float lump;      // m: wavelength of the crust's swellings
    uint64_t seed;
} CrustParams;

// The crust at a point of the rock.
typedef struct CrustPoint {
    float height;   // m above the rock; negative outside the crust
    float margin;   // 1 at the crust's margin .. 0 inside
    int32_t colony; // the nearest
} CrustPoint;

CrustPoint crust_at(const OutTree *tree, const CrustParams *params, Vec3 p);

// Calls crust_at at every vertex of the rock, which must have normals; the caller frees the result.
// The same bits for any run->threads.
CrustPoint *crust_points(const Mesh *rock, const OutTree *tree, const CrustParams *params,
                         const Run *run, Error *e);

// One colony's crust: the rock's surface raised by its height, its margin slightly below the rock.
// Births give the closeness to the margin. Without faces if the colony covers nothing.
Mesh *crust_mesh(const Mesh *rock, const CrustPoint *points, int32_t colony, Error *e);

#endif
