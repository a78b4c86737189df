// Selects the branches of a trunk that become limbs: limbs that would grow side by side are thinned
// out before the crown grows, as shading would do.
#ifndef RAMIFY_OBJECTS_TREE_LIMBS_H
#define RAMIFY_OBJECTS_TREE_LIMBS_H

#include "objects/tree/tree.h"
#include "shape/envelope.h"

// Drops the starting pieces of branches whose limbs would run close to a stronger limb near their
// fork: grows the crown's first level on copies of the tree until none does. params: resolved.
// first: first node of the starting pieces, which follow the trunk's nodes. envelope, seed: the
// crown's.
bool tree_thin_limbs(OutTree *tree, int64_t first, const TreeParams *params,
                     const Envelope *envelope, uint64_t seed, const Run *run, Error *e);

#endif
