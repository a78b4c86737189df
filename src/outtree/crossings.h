// Finds and removes crossing segments of growth on a surface: crystals do not cross.
#ifndef RAMIFY_OUTTREE_CROSSINGS_H
#define RAMIFY_OUTTREE_CROSSINGS_H

#include "base/run.h"
#include "outtree/out_tree.h"

// Drops every node whose segment crosses an earlier one (by birth, then by index), seen along the
// node's normal, with its descendants. Segments that share a node do not cross.
bool out_tree_drop_crossings(OutTree *tree, const Run *run, Error *e);

#endif
