// Nearest of a fixed set of points: a k-d tree.
#ifndef RAMIFY_FIELD_POINT_TREE_H
#define RAMIFY_FIELD_POINT_TREE_H

#include "base/error.h"
#include "base/vec.h"

#include <stdint.h>

typedef struct TreePoint {
    Vec3 position;
    int32_t index; // in the array that the tree was made of
    int32_t axis;  // 0, 1, 2: along which this point splits its range
} TreePoint;

// The middle of a range of points splits it: coordinates along its axis are not greater before it
// and not less after it.
typedef struct PointTree {
    TreePoint *point; // owned
    int64_t count;
} PointTree;

// Copies the points; at most 2^31 - 1. Takes O(n log^2 n). Free with point_tree_free.
bool point_tree_init(PointTree *tree, const Vec3 *position, int64_t count, Error *e);
void point_tree_free(PointTree *tree);

// The point nearest to p, of equally near ones that of the lowest index. skip: index of a point
// that does not count, -1 = none. NULL if there is no point.
const TreePoint *point_tree_nearest(const PointTree *tree, Vec3 p, int64_t skip);

#endif
