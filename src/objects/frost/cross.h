// Finds and removes crossing segments: crystals do not cross. Private to the frost's files.
#ifndef RAMIFY_OBJECTS_FROST_CROSS_H
#define RAMIFY_OBJECTS_FROST_CROSS_H

#include "base/run.h"
#include "outtree/out_tree.h"

// Drops every node whose segment crosses an earlier one (by birth, then by index), with its
// descendants. Segments that share a node do not cross.
bool frost_drop_crossings(OutTree *tree, const Run *run, Error *e);

#endif
