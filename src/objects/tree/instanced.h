// A tree that stands in many places.
#ifndef RAMIFY_OBJECTS_TREE_INSTANCED_H
#define RAMIFY_OBJECTS_TREE_INSTANCED_H

#include "objects/common/instanced.h"
#include "objects/tree/tree.h"

typedef struct InstancedTree {
    Instanced at;        // if distant, organs are left out
    const int *material; // indices into the world's list, by a tree's roles
} InstancedTree;

// Adds the parts of a grown tree at all places, without fallen leaves.
bool tree_add_instanced(const TreeParams *params, const Grown *grown, const InstancedTree *how,
                        const Placing *placing, Error *e);

#endif
