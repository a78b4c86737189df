// The attractors of growth in a uniform grid, each with its nearest node so far (Tanaka eq.
// (3)-(5), (8)). The nearest node changes only near new nodes: every cell keeps the largest of its
// attractors' best distances, and a new node visits only the cells it can still improve.
#ifndef RAMIFY_GROW_ATTRACTOR_GRID_H
#define RAMIFY_GROW_ATTRACTOR_GRID_H

#include "base/run.h"
#include "grow/lanes.h"
#include "outtree/out_tree.h"
#include "shape/points.h"

#include <stdint.h>

enum { ATTRACTOR_MAX_SLABS = 256, NEAREST_RIVAL = -2 };

// Eight attractors of one cell; lanes beyond the cell's count have best = -1, below any distance,
// and nearest = -1. Three cache lines.
typedef struct AttractorBlock {
    _Alignas(64) FloatLanes x;
    FloatLanes y, z;
    FloatLanes best;  // m^2: squared distance to the nearest node, or reach^2
    IntLanes nearest; // that node; -1: none is within reach; NEAREST_RIVAL: not ours
    IntLanes source;  // index in the point set
} AttractorBlock;

typedef struct AttractorCell {
    int32_t first_block;
    int32_t count; // attractors alive
} AttractorCell;

// The active cells of a slice across the grid's axis: those with an attractor within reach of a
// node.
typedef struct ActiveCells {
    int32_t *cell;        // part of the grid's table
    int32_t count, empty; // length of the list, and how many listed cells are empty now
} ActiveCells;

typedef struct AttractorGrid {
    Vec3 low;
    float cell, slack; // m: cell width; how far outside its cell rounding may put a point
    int size[3];       // cells along each axis; z is contiguous in memory
    int64_t cell_count;
    float reach, reach2, kill2; // m, m^2
    AttractorCell *cells;
    uint8_t *state;        // per cell, bits: searched in this step, listed as active
    float *furthest;       // per cell: the largest best; -1 in empty cells
    int32_t *touched;      // scratch: cells a search changed
    int64_t *work;         // scratch: estimated work, for load balancing
    float *gap2;           // scratch: distances to the cells along each axis
    int32_t *active_table; // room for all cells
    ActiveCells *active;   // per slice
    int64_t active_count;  // length of these lists together
    AttractorBlock *block;
    int32_t *removed; // borrowed: per attractor, set to `now` when it is removed; NULL = not wanted
    int32_t now;
    int64_t alive;
    int axis;                                      // 0 or 1: threads own slabs of slices along it
    int slab_count, slab_end[ATTRACTOR_MAX_SLABS]; // in the last update
} AttractorGrid;

// A set of nodes as a bit mask, written by many threads.
typedef struct NodeBits {
    uint64_t *word;
    int64_t capacity; // words
} NodeBits;

// reach: influence radius R_m; kill: D_k; m. ERROR_INPUT names the first attractor that is not
// finite.
bool attractor_grid_init(AttractorGrid *grid, const PointSet *points, float reach, float kill,
                         const Run *run, Error *e);
void attractor_grid_free(AttractorGrid *grid);

// Starts loading the first attractors of a cell. Loops over cells do so this many cells ahead.
enum { ATTRACTOR_AHEAD = 8 };
static inline void attractor_grid_prefetch(const AttractorGrid *grid, int32_t cell)
{
    const AttractorBlock *block = &grid->block[grid->cells[cell].first_block];
    __builtin_prefetch(&block->x, 1);
    __builtin_prefetch(&block->z, 1);
    __builtin_prefetch(&block->nearest, 1);
}

// Cell along an axis of a point at this offset from the grid's low corner, m; clamped.
int attractor_grid_cell_along(const AttractorGrid *grid, int axis, float offset);

// Nodes that are new to the grid.
typedef struct NewNodes {
    const OutTree *tree;
    int64_t first;     // first .. tree->count - 1
    const Vec3 *rival; // nodes of other out-trees: they take attractors, but are never pulled
    int64_t rival_count;
} NewNodes;

// Updates the nearest nodes, removes attractors closer than kill to any node, and sets the bits in
// `changed` of all the tree's nodes that gained or lost a living attractor. Ties go to the tree's
// lowest node index, then to rivals; the result does not depend on the number of threads. If
// cancelled (check run), it stops early and the grid is no longer valid.
void attractor_grid_update(AttractorGrid *grid, const NewNodes *nodes, const Run *run, int threads,
                           const NodeBits *changed);

#endif
