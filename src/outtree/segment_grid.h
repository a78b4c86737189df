// The segments of an out-tree as capsules in a grid of cells: which of them come near a given one.
// A segment runs from a node's parent to the node and has the node's radius.
#ifndef RAMIFY_OUTTREE_SEGMENT_GRID_H
#define RAMIFY_OUTTREE_SEGMENT_GRID_H

#include "outtree/out_tree.h"

typedef struct SegmentGrid SegmentGrid;

// Keeps the tree's positions and radii as they are now; NULL and e when memory is short. A tree
// without segments makes an empty grid.
SegmentGrid *segment_grid_new(const OutTree *tree, Error *e);
void segment_grid_free(SegmentGrid *grid); // NULL is fine

// Whether a segment of the grid with at least least_radius (m) comes nearer to the segment a-b than
// `reach` plus its own radius, m.
bool segment_grid_touches(const SegmentGrid *grid, Vec3 a, Vec3 b, float reach, float least_radius);

// The least distance (m) between the surface of the capsule about a-b and the grid's segments', as
// far as it is below `limit`; else limit. Negative where they overlap.
float segment_grid_gap(const SegmentGrid *grid, Vec3 a, Vec3 b, float radius, float limit);

// Distance between the segments a0-a1 and b0-b1, m (Ericson, Real-Time Collision Detection, 5.1.9).
float segment_distance(Vec3 a0, Vec3 a1, Vec3 b0, Vec3 b1);

#endif
