// Box-counting dimension: how fast the number of boxes that a form touches grows as they shrink.
#ifndef RAMIFY_OUTTREE_BOX_DIMENSION_H
#define RAMIFY_OUTTREE_BOX_DIMENSION_H

#include "outtree/out_tree.h"

// Of a set of points, by boxes from a quarter of its extent down to `finest` (m), each half the
// last. NAN when fewer than three sizes fit between, so that there is no line to fit.
bool points_box_dimension(const Vec3 *points, int64_t count, double finest, double *dimension,
                          Error *e);

// Of an out-tree's branches as lines without thickness, down to boxes of their mean segment.
bool out_tree_box_dimension(const OutTree *tree, double *dimension, Error *e);

#endif
