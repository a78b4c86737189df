// Flat crystals on a surface, such as frost's: a closed body along every chain of an out-tree, with
// a rib raised along the nodes' normals.
#ifndef RAMIFY_OBJECTS_COMMON_BLADES_H
#define RAMIFY_OBJECTS_COMMON_BLADES_H

#include "objects/common/recipe.h"
#include "outtree/out_tree.h"

typedef struct BladeParams {
    float relief;       // height of the rib over the half-width
    float white;        // 0..1: share of the side chains that are white; the others are clear
    float white_spines; // the same of the chains that start at a root
} BladeParams;

// Adds the blades as two triangle meshes, clear and white: closed pieces that overlap where a side
// leaves. A node's radius is the half-width. role: of the materials, clear and white.
bool blades_add(const OutTree *tree, const BladeParams *params, const Placing *placing,
                const int role[2], Error *e);

#endif
