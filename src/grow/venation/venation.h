// Leaf veins (Runions, Fuhrer, Lane, Federl, Rolland-Lagan and Prusinkiewicz 2005): auxin sources
// appear in a blade that grows, and veins grow toward them. Open venation is a tree: a source pulls
// its nearest vein and goes when a vein is near. Closed venation has loops: a source pulls every
// vein of its relative neighbourhood, and goes when all of them have come, which joins them.
//
// A growth of its own beside colonize.h, because there the attractors are all known beforehand and
// each has one nearest node.
#ifndef RAMIFY_GROW_VENATION_VENATION_H
#define RAMIFY_GROW_VENATION_VENATION_H

#include "base/run.h"
#include "outtree/out_tree.h"
#include "shape/leaf_outline.h"
#include "shape/points.h"

// Lengths in metres of the grown leaf.
typedef struct VeinParams {
    LeafOutline outline;
    bool closed;
    bool marginal; // the blade grows at its margin and what there is stays; else it grows evenly
                   // everywhere and takes veins and sources along
    float birth;   // least distance of a new source from sources and veins
    float kill;    // a vein this near to a source has reached it
    float step;    // length of a new piece of vein
    float start;   // 0..1: size of the blade when the first sources appear
    float rate;    // by how much the blade grows between two rounds of darts, 0.03 = 3 %
    int pace;      // steps of the veins between those
    float midrib;  // 0..1: how far up the blade a midrib runs from the start
    float slant;   // pull of young veins toward the tip, against the unit pull of sources;
                   // fades as the blade grows
    uint64_t seed;
} VeinParams;

VeinParams vein_params_default(void); // a leaf of 0.1 m, open, even growth

typedef struct VeinReport {
    int64_t sources, sources_left; // thrown in all, and not reached in the end
    int64_t loops;                 // closed
} VeinReport;

// The veins, in the plane z = 0, rooted at the blade's base. Nodes that close a loop lie at the
// very place of another node (see outtree/join.h). sources (may be NULL) gets every source there
// was, where it ended up. report may be NULL. ERROR_INPUT for lengths that are not positive,
// ERROR_CANCELLED.
OutTree *veins_grow(const VeinParams *params, PointSet *sources, VeinReport *report, const Run *run,
                    Error *e);

// ---- nodes by cell, exposed for its tests ----

typedef struct VeinGrid {
    float cell; // m
    Vec3 low;
    int64_t size[2];
    int32_t *first; // size[0] * size[1] + 1: places in `node` where each cell begins
    int32_t *node;
    int64_t cell_capacity, node_capacity;
} VeinGrid;

// Sorts positions (those within the box) by cell.
bool vein_grid_fill(VeinGrid *grid, const Vec3 *position, int64_t count, Aabb box, float cell,
                    Error *e);
void vein_grid_free(VeinGrid *grid);

// The nearest node within reach of p, -1 = none; ties: the lowest index.
int32_t vein_nearest(const VeinGrid *grid, const Vec3 *position, Vec3 p, float reach);

enum { VEIN_MOST_NEIGHBOURS = 6 };

// The relative neighbours of p among the nodes within reach: those v with no other node nearer than
// |v - p| to both v and p. At most one in each sector of 60 degrees about p; returns how many.
int vein_relative_neighbours(const VeinGrid *grid, const Vec3 *position, Vec3 p, float reach,
                             int32_t neighbour[VEIN_MOST_NEIGHBOURS]);

#endif
