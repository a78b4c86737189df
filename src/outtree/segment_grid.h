// The segments of an out-tree as capsules in a uniform grid, for proximity queries. A segment runs
// from a node's parent to the node and has the node's radius.
#ifndef RAMIFY_OUTTREE_SEGMENT_GRID_H
#define RAMIFY_OUTTREE_SEGMENT_GRID_H

#include "outtree/out_tree.h"

typedef struct SegmentGrid SegmentGrid;

// Copies the tree's positions and radii; NULL and e when out of memory. A tree without segments
// gives an empty grid.
SegmentGrid *segment_grid_new(const OutTree *tree, Error *e);
void segment_grid_free(SegmentGrid *grid); // NULL is fine

// Whether a segment of at least least_radius (m) comes nearer to the segment a-b than `reach` plus
// its own radius, m.
bool segment_grid_touches(const SegmentGrid *grid, Vec3 a, Vec3 b, float reach, float least_radius);

// Least distance (m) between the surface of the capsule a-b and those of the grid, at most `limit`.
// Negative where they overlap.
float segment_grid_gap(const SegmentGrid *grid, Vec3 a, Vec3 b, float radius, float limit);

// Distance between the segments a0-a1 and b0-b1, m (Ericson 2005, 5.1.9).
float segment_distance(Vec3 a0, Vec3 a1, Vec3 b0, Vec3 b1);

#endif
