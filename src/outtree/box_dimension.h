// Box-counting dimension: how fast the number of boxes that a shape touches grows as they shrink.
#ifndef RAMIFY_OUTTREE_BOX_DIMENSION_H
#define RAMIFY_OUTTREE_BOX_DIMENSION_H

#include "outtree/out_tree.h"

// Box dimension of a point set, with boxes from a quarter of its extent down to `finest` (m), each
// half the last. NAN when fewer than three sizes fit between, too few to fit a line.
bool points_box_dimension(const Vec3 *points, int64_t count, double finest, double *dimension,
                          Error *e);

// Box dimension of an out-tree's branches, taken as lines, down to the mean segment length.
bool out_tree_box_dimension(const OutTree *tree, double *dimension, Error *e);

#endif
