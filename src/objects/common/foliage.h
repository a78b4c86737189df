// Leaves on twigs: placed by phyllotaxis, turned toward the light.
#ifndef RAMIFY_OBJECTS_COMMON_FOLIAGE_H
#define RAMIFY_OBJECTS_COMMON_FOLIAGE_H

#include "mesh/geometry.h"
#include "objects/common/branches.h"
#include "objects/common/leaf_place.h"

// Adds one part per leaf variant, with an instance for every leaf on the thin ends of the curves.
// bare: one entry per curve, true = without leaves; NULL = all bear leaves. The spacing is widened
// if there would be more than leaves->max_count. light: where they turn to. role: of their
// material.
bool foliage_add(const CurveSet *twigs, const bool *bare, const LeavesParams *leaves,
                 const LeafLight *light, uint64_t seed, const Placing *placing, int role, Error *e);

// Sets the mesh of leaf variant number `variant` and its coarse forms; after a failure none. piece:
// m, length of twig that a piece with needles covers.
void foliage_leaf_meshes(const LeavesParams *leaves, float piece, int variant, uint64_t seed,
                         Part *part, Error *e);

#endif
