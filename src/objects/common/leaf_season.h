// Leaves by the season: which have turned, which are shed, which of these lie on the ground.
#ifndef RAMIFY_OBJECTS_COMMON_LEAF_SEASON_H
#define RAMIFY_OBJECTS_COMMON_LEAF_SEASON_H

#include "objects/common/leaf_batch.h"
#include "objects/common/leaves.h"
#include "objects/common/surroundings.h"

// Turns, sheds and lays down leaves of `count` batches, of the crown's top and outside first.
bool leaf_season_apply(const LeavesParams *leaves, LeafBatch *batch, int count, const Land *land,
                       uint64_t seed, Error *e);

#endif
