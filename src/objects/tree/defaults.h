// Defaults of a tree's elements: envelopes, levels and field weights in proportion to the tree's
// height, for trees of any size.
#ifndef RAMIFY_OBJECTS_TREE_DEFAULTS_H
#define RAMIFY_OBJECTS_TREE_DEFAULTS_H

#include "objects/tree/tree.h"

// Largest numbers of levels and lobes of a default element.
#define TREE_DEFAULT_LEVELS 4
#define TREE_MOST_LOBES 32

// A tree's resolved parameters. The elements' lists point into the scene's lists or into this
// struct, so it must not be moved or copied.
typedef struct TreePlan {
    TreeParams params;
    GrownBy grown_by; // never GROWN_BY_AUTO
    int seasons;      // of growth by light
    bool bounded;     // the crown's envelope bounds growth by light
    float bole;       // m: height that the crown's base was given; 0 = none
    Shape trunk_shape, crown_shape[1 + TREE_MOST_LOBES], root_shape;
    GrowLevel trunk_level[1], crown_level[TREE_DEFAULT_LEVELS], root_level[2];
} TreePlan;

// seed: the tree's; places the crown's lobes.
void tree_plan_make(TreePlan *plan, const TreeParams *params, uint64_t seed);

#endif
