// The cells that a network of cracks on a body's surface makes of the body: what falls apart.
//
// A grown network leaves gaps, so cells are basins of the distance to the network, not its loops:
// cracks that end shortly before another one are led on to it, along the line farthest from
// all cell middles; a crack that ends in the midst of a wide face separates nothing. Inward a cell
// goes on as its surface does: a point belongs to the surface point s with the greatest
// (distance of s to the network) - (way through the body to s), which is exact on the surface,
// keeps thin parts whole and meets in the middle of thick ones (an Apollonius diagram of the
// cells' middles).
#ifndef RAMIFY_OBJECTS_FRACTURE_CRACK_CELLS_H
#define RAMIFY_OBJECTS_FRACTURE_CRACK_CELLS_H

#include "objects/fracture/body_grid.h"
#include "outtree/out_tree.h"

typedef struct CrackCellsParams {
    BodyDistance distance;
    const void *body;
    Aabb box;         // m: around the body
    float spacing;    // m: of the grid on which cells are told apart
    float least;      // m: cells that hold no ball of this radius join a neighbour
    float known;      // m: how far from a wall distances have to be right
    float roughness;  // m: height of the walls' largest bumps
    float wavelength; // m: of them
    uint64_t seed;
} CrackCellsParams;

typedef struct CrackCells CrackCells;

// The network is not kept.
CrackCells *crack_cells_new(const OutTree *network, const CrackCellsParams *params, const Run *run,
                            Error *e);
void crack_cells_free(CrackCells *cells); // NULL is fine

int32_t crack_cells_count(const CrackCells *cells);

// Cells that joined a neighbour because they were below `least`.
int32_t crack_cells_small(const CrackCells *cells);

Aabb crack_cells_bounds(const CrackCells *cells, int32_t cell);

// Signed distance of a point of the body to the wall of a cell, m, negative within it; *bound =
// what its magnitude is not below. Between two cells the one's is minus the other's. Safe to call
// from many threads.
double crack_cells_distance(const CrackCells *cells, int32_t cell, Vec3 p, double *bound);

#endif
