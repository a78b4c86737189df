// Ribs along trunk and arms, as those of a columnar cactus.
#ifndef RAMIFY_OBJECTS_TREE_RIBS_H
#define RAMIFY_OBJECTS_TREE_RIBS_H

#include "objects/tree/tree.h"

// Adds nodes to every end of the branches of a ribbed tree, so that it is a dome, not cut off.
bool tree_round_ends(OutTree *tree, const TreeParams *params, Error *e);

// Presses grooves between params->trunk.ribs rounded ribs into the skin, whose texture coordinates
// tell where around its branch each vertex lies (skin/skin.h). The ribs' crests keep the radius.
bool tree_ribs(Mesh *skin, const TreeParams *params, Error *e);

#endif
