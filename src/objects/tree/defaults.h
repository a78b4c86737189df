// What a tree's elements are where the scene file leaves them open: envelopes, levels and pulls in
// proportion to the tree's height, so that a sapling and a giant need no other numbers.
#ifndef RAMIFY_OBJECTS_TREE_DEFAULTS_H
#define RAMIFY_OBJECTS_TREE_DEFAULTS_H

#include "objects/tree/tree.h"

// Most shapes and levels that a default element has.
#define TREE_DEFAULT_LEVELS 4
#define TREE_MOST_LOBES 32

// A tree's parameters with every open number filled in. The elements' lists point into the scene's
// own lists or into this struct, so it must stay where it is.
typedef struct TreePlan {
    TreeParams params;
    Shape trunk_shape, crown_shape[1 + TREE_MOST_LOBES], root_shape;
    GrowLevel trunk_level[1], crown_level[TREE_DEFAULT_LEVELS], root_level[2];
} TreePlan;

// seed: the tree's; the crown's lobes are laid out by it.
void tree_plan_make(TreePlan *plan, const TreeParams *params, uint64_t seed);

#endif
