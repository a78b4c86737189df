// Crystals do not cross: finding segments that do. Private to the frost's files.
#ifndef RAMIFY_OBJECTS_FROST_CROSS_H
#define RAMIFY_OBJECTS_FROST_CROSS_H

#include "base/run.h"
#include "outtree/out_tree.h"

// Drops every node whose way from its parent crosses one that was there before (by birth, then by
// index), with all that grew from it. Segments that share a node do not count.
bool frost_drop_crossings(OutTree *tree, const Run *run, Error *e);

#endif
