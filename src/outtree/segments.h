// Vessel segments: the unbranched runs of an out-tree between roots, forks and ends.
#ifndef RAMIFY_OUTTREE_SEGMENTS_H
#define RAMIFY_OUTTREE_SEGMENTS_H

#include "outtree/out_tree.h"

// One run of nodes. It begins at `from` (a root or a fork) and ends at `to` (a fork or an end).
typedef struct Segment {
    int32_t from, to;      // nodes
    int32_t parent;        // segment that ends at `from`, of lower index; -1 at a root
    int32_t children;      // segments that begin at `to`
    double length, radius; // m; the radius is the mean over the length
} Segment;

typedef struct SegmentList {
    int64_t count;
    Segment *segment;
    int32_t *of_node; // segment of the piece that ends at the node; -1 at a root; one for each node
} SegmentList;

// Node i's piece runs from its parent to it and has its radius. Memory O(nodes).
bool segments_init(SegmentList *list, const OutTree *tree, Error *e);
void segments_free(SegmentList *list);

#endif
