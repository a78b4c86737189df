// Buttresses: the bark drawn out between trunk and main roots.
#ifndef RAMIFY_MODEL_TREE_BUTTRESS_H
#define RAMIFY_MODEL_TREE_BUTTRESS_H

#include "base/mesh.h"
#include "model/tree.h"

// Moves the vertices of a grown tree's skin about the foot outward to the smooth union of trunk and
// main roots, and computes the normals again. Does nothing where the tree has no flare or no roots.
bool tree_buttress(Mesh *skin, const OutTree *tree, const TreeParams *params, Error *e);

#endif
