// The angle that branches sweep about an axis, from base to tip.
#ifndef RAMIFY_OBJECTS_COMMON_SWEPT_H
#define RAMIFY_OBJECTS_COMMON_SWEPT_H

#include "base/measures.h"
#include "outtree/out_tree.h"

typedef struct SweptAxis {
    Vec3 center, direction; // direction: unit
} SweptAxis;

// The axis of the branches that grow from a base.
typedef SweptAxis SweptAxisOf(const void *context, const OutTree *tree, int64_t base);

// Appends the mean angle (degrees, positive by the right-hand rule) over the leaders among the
// nodes with is_in set: the paths from a base, a node whose parent is not in, to a tip, a node
// without children in, that are at least half as long as the longest. Steps nearer to the axis than
// a tenth of the greatest distance of all nodes from it do not count, since an angle has no meaning
// there. NAN if there are no leaders.
bool swept_measure(const OutTree *tree, const bool *is_in, SweptAxisOf *axis_of,
                   const void *context, const char *name, MeasureList *list, Error *e);

#endif
