// Crusts: what coral that creeps over a rock makes of its surface. Thick where the colony's nodes
// are, rounded to nothing at its margin, parted from other colonies by a bare seam.
#ifndef RAMIFY_MODEL_CORAL_CRUST_H
#define RAMIFY_MODEL_CORAL_CRUST_H

#include "base/mesh.h"
#include "base/run.h"
#include "tree/out_tree.h"

typedef struct CrustParams {
    float thickness; // m
    float reach;     // m: how far from its nodes a colony covers the rock
    float seam;      // m: half the width left bare between two colonies
    float pale;      // m: how far from its margin the crust is young
    float lump;      // m: wavelength of the crust's swellings
    uint64_t seed;
} CrustParams;

// The rock's surface raised to the crust's, a hair below the rock where there is none. Births tell
// the nearness of the margin: 1 there, 0 inside. Radii are 0. The same bits for any run->threads.
Mesh *crust_mesh(const Mesh *rock, const OutTree *tree, const CrustParams *params, const Run *run,
                 Error *e);

// Height of the crust over a point of the rock, m; negative where there is none. *margin: 0..1.
float crust_height(const OutTree *tree, const CrustParams *params, Vec3 p, float *margin);

#endif
