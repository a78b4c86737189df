// Crystals do not cross: finding segments that do. Private to the frost's files.
#ifndef RAMIFY_MODEL_FROST_CROSS_H
#define RAMIFY_MODEL_FROST_CROSS_H

#include "base/run.h"
#include "tree/out_tree.h"

// Do the segments a0-a1 and b0-b1 cross, seen along the normal? Touching ends count.
bool frost_segments_cross(Vec3 a0, Vec3 a1, Vec3 b0, Vec3 b1, Vec3 normal);

// Drops every node whose way from its parent crosses one that was there before (by birth, then by
// index), with all that grew from it. Segments that share a node do not count.
bool frost_drop_crossings(OutTree *tree, const Run *run, Error *e);

#endif
