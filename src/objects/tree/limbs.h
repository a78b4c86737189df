// Which of the branches that start on a trunk become limbs: limbs that would lie side by side are
// thinned out before the crown grows, as their shade would do.
#ifndef RAMIFY_OBJECTS_TREE_LIMBS_H
#define RAMIFY_OBJECTS_TREE_LIMBS_H

#include "objects/tree/tree.h"
#include "shape/envelope.h"

// Drops the starting pieces of branches whose limbs would come close to a stronger limb, not far
// from where they part: grows the crown's first level on copies of the tree until no limbs do.
// params: with all open numbers filled in. first: the first node of all starting pieces, which
// follow the trunk's nodes. envelope, seed: the crown's.
bool tree_thin_limbs(OutTree *tree, int64_t first, const TreeParams *params,
                     const Envelope *envelope, uint64_t seed, const Run *run, Error *e);

#endif
