// Compound leaves: leaflets on a rachis, or from the end of the stalk.
#ifndef RAMIFY_MESH_LEAF_COMPOUND_H
#define RAMIFY_MESH_LEAF_COMPOUND_H

#include "mesh/leaf/blade.h"

// Adds the leaflets, widened by this factor. Of a bipinnate leaf each part is one leaflet if detail
// is BLADE_KITE, and its leaflets are kites if detail is BLADE_PLAIN.
void compound_add(Quads *quads, const LeafParams *params, BladeDetail detail, float widen,
                  uint64_t seed);

// Adds the rachis above the stalk, and those of a bipinnate leaf's parts.
void compound_add_rachis(Quads *quads, const LeafParams *params);

#endif
