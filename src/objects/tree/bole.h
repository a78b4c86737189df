// The bole: what a trunk grows beyond its own envelope when the crown begins out of its reach.
#ifndef RAMIFY_OBJECTS_TREE_BOLE_H
#define RAMIFY_OBJECTS_TREE_BOLE_H

#include "objects/tree/tree.h"

// Where no attractor of the crown's first level is within its influence of the tree, the trunk's
// highest node grows on toward them until one is within half of it. Warns when that takes more than
// the whole tree's height. params: with all open numbers filled in. envelope, seed: the crown's.

bool tree_grow_bole(OutTree *tree, const TreeParams *params, const Envelope *envelope,
                    uint64_t seed, const Recipe *recipe, Error *e);

// The node that stands highest; -1 in a tree without nodes.
int64_t tree_highest_node(const OutTree *tree);

#endif
