// Leaves on twigs: where phyllotaxis puts them and how they turn.
#ifndef RAMIFY_OBJECTS_COMMON_FOLIAGE_H
#define RAMIFY_OBJECTS_COMMON_FOLIAGE_H

#include "mesh/geometry.h"
#include "objects/tree/tree.h"

// Adds one part per leaf variant with an instance for every leaf on the thin ends of the curves,
// but for those that are bare (one entry a curve; NULL = none is). Where they would be more than
// leaves->max_count they stand farther apart. center: of the crown, from which leaves turn outward
// to the light. role: of their material.
bool foliage_add(const CurveSet *twigs, const bool *bare, const LeavesParams *leaves, Vec3 center,
                 uint64_t seed, const Placing *placing, int role, Error *e);

// The mesh of leaf variant number `variant`.
Mesh *foliage_leaf_mesh(const LeavesParams *leaves, int variant, uint64_t seed, Error *e);

#endif
