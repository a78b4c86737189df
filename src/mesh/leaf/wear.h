// Holes and bites that insects leave in a blade.
#ifndef RAMIFY_MESH_LEAF_WEAR_H
#define RAMIFY_MESH_LEAF_WEAR_H

#include "mesh/quads.h"

#include <stdint.h>

// Cuts round holes into the faces from number first on; wear 0..1: number and size. size: m, of the
// leaf. Holes smaller than the faces leave no trace.
void wear_cut(Quads *quads, int64_t first, float wear, float size, uint64_t seed);

#endif
