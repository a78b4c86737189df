// Start points of growth on a surface: the roots of out-trees.
#ifndef RAMIFY_OBJECTS_COMMON_STARTS_H
#define RAMIFY_OBJECTS_COMMON_STARTS_H

#include "base/run.h"
#include "outtree/out_tree.h"
#include "shape/points.h"

// Adds `count` roots at points that lie as far as possible from all nodes and from each other
// (farthest-point sampling, Gonzalez 1985), with the points' normals; in a tree without nodes the
// first is the farthest point in `direction`. Colonies continue those of the tree's nodes. Fewer if
// there are fewer points. seed: of the roots' ids.
bool starts_spread(OutTree *tree, const PointSet *points, Vec3 direction, int count, uint64_t seed,
                   const Run *run, Error *e);

#endif
