// Buttresses: bark blended between trunk and main roots.
#ifndef RAMIFY_OBJECTS_TREE_BUTTRESS_H
#define RAMIFY_OBJECTS_TREE_BUTTRESS_H

#include "base/mesh.h"
#include "objects/tree/tree.h"

// Moves the skin's vertices near the foot outward to the smooth union of trunk and main roots, and
// recomputes normals. Does nothing if the tree has no flare or no roots.
bool tree_buttress(Mesh *skin, const OutTree *tree, const TreeParams *params, Error *e);

#endif
