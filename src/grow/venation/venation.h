// Leaf venation (Runions 2005): auxin sources appear in a growing blade, and veins grow toward
// them. Open venation is a tree: a source pulls its nearest vein and is removed when a vein is
// near. Closed venation has loops: a source pulls every vein in its relative neighbourhood and is
// removed when all of them have arrived, which joins them.
//
// Separate from colonize.h, where all attractors exist from the start and each has one nearest
// node.
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
    bool marginal;   // the blade grows at its margin and its contents stay; else it grows uniformly
                     // and carries veins and sources along
    float birth;     // least distance of a new source from sources and veins
    float kill;      // a vein this near to a source has reached it
    float step;      // length of a vein segment
    float start;     // 0..1: relative size of the blade when the first sources appear
    float rate;      // relative growth of the blade per round of darts, 0.03 = 3 %
    int pace;        // vein steps per round
    float midrib;    // 0..1: length of the initial midrib, relative to the blade
    float slant;     // pull of young veins toward the tip, relative to the unit pull of sources;
                     // fades as the blade grows
    int secondaries; // secondary veins of the young blade on each side, which arch to one another;
                     // 0 = they, too, grow toward sources
    int tertiaries;  // veins from each secondary vein to the next; 0 = they, too, grow
    uint64_t seed;
} VeinParams;

VeinParams vein_params_default(void); // a leaf of 0.1 m, open, even growth

typedef struct VeinReport {
    int64_t sources, sources_left; // sources created, and those never reached
    int64_t loops;                 // loops closed
} VeinReport;

// Grows the veins in the plane z = 0, rooted at the blade's base. Nodes that close a loop lie
// exactly at another node's position (see outtree/join.h). sources (may be NULL) receives every
// source at its final position. report may be NULL. ERROR_INPUT for lengths that are not positive;
// ERROR_CANCELLED. The caller frees the tree.
OutTree *veins_grow(const VeinParams *params, PointSet *sources, VeinReport *report, const Run *run,
                    Error *e);

// The id of the root of the veins that grow from this seed.
uint64_t veins_root_id(uint64_t seed);

// ---- nodes by cell, exposed for tests ----

typedef struct VeinGrid {
    float cell; // m
    Vec3 low;
    int64_t size[2];
    int32_t *first; // size[0] * size[1] + 1 entries: first index in `node` of each cell
    int32_t *node;
    int64_t cell_capacity, node_capacity;
} VeinGrid;

// Sorts the positions inside the box by cell.
bool vein_grid_fill(VeinGrid *grid, const Vec3 *position, int64_t count, Aabb box, float cell,
                    Error *e);
void vein_grid_free(VeinGrid *grid);

// The nearest node within reach of p, or -1; ties go to the lowest index.
int32_t vein_nearest(const VeinGrid *grid, const Vec3 *position, Vec3 p, float reach);

enum { VEIN_MAX_NEIGHBOURS = 6 };

// Relative neighbours of p among the nodes within reach: those v with no other node nearer than |v
// - p| to both v and p. At most one in each sector of 60 degrees about p; returns how many.
int vein_relative_neighbours(const VeinGrid *grid, const Vec3 *position, Vec3 p, float reach,
                             int32_t neighbour[VEIN_MAX_NEIGHBOURS]);

#endif
