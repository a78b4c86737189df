// Buttresses: the bark drawn out between trunk and main roots.
#ifndef RAMIFY_OBJECTS_TREE_BUTTRESS_H
#define RAMIFY_OBJECTS_TREE_BUTTRESS_H

#include "base/mesh.h"
#include "objects/tree/tree.h"

// Moves the vertices of a grown tree's skin about the foot outward to the smooth union of trunk and
// main roots, and computes the normals again. Does nothing where the tree has no flare or no roots.
bool tree_buttress(Mesh *skin, const OutTree *tree, const TreeParams *params, Error *e);

#endif
