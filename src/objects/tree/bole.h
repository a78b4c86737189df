// The bole: growth of the trunk beyond its envelope if the crown begins out of reach.
#ifndef RAMIFY_OBJECTS_TREE_BOLE_H
#define RAMIFY_OBJECTS_TREE_BOLE_H

#include "objects/tree/tree.h"

// If no attractor of the crown's first level is within its influence distance of the tree, extends
// the trunk's highest node toward them until one is within half that distance. Warns if the
// extension is longer than the tree's height. params: resolved. envelope, seed: the crown's.

bool tree_grow_bole(OutTree *tree, const TreeParams *params, const Envelope *envelope,
                    uint64_t seed, const Recipe *recipe, Error *e);

// The highest node; -1 in a tree without nodes.
int64_t tree_highest_node(const OutTree *tree);

#endif
