// Crusts: what coral that creeps over a rock makes of its surface. Thick where the colony's nodes
// are, rounded to nothing at its margin, parted from other colonies by a bare seam.
#ifndef RAMIFY_OBJECTS_CORAL_CRUST_H
#define RAMIFY_OBJECTS_CORAL_CRUST_H

#include "base/mesh.h"
#include "base/run.h"
#include "outtree/out_tree.h"

typedef struct CrustParams {
    float thickness; // m
    float reach;     // m: how far from its nodes a colony covers the rock
    float seam;      // m: half the width left bare between two colonies
    float pale;      // m: how far from its margin the crust is young
    float lump;      // m: wavelength of the crust's swellings
    uint64_t seed;
} CrustParams;

// What covers the rock at a point.
typedef struct CrustPoint {
    float height;   // m above the rock; negative where there is none
    float margin;   // 1 at the crust's margin .. 0 inside
    int32_t colony; // the nearest
} CrustPoint;

CrustPoint crust_at(const OutTree *tree, const CrustParams *params, Vec3 p);

// crust_at every vertex of the rock, which must have normals; the caller frees it. The same bits
// for any run->threads.
CrustPoint *crust_points(const Mesh *rock, const OutTree *tree, const CrustParams *params,
                         const Run *run, Error *e);

// One colony's crust: the rock's surface raised to it, its margin a hair below the rock. Births
// tell the nearness of the margin. Empty (no faces) where the colony covers nothing.
Mesh *crust_mesh(const Mesh *rock, const CrustPoint *points, int32_t colony, Error *e);

#endif
