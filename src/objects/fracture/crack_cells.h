// The cells into which a network of surface cracks divides a body.
//
// A grown network leaves gaps, so cells are basins of the distance to the network, not its loops:
// a crack that ends near another one is extended to it, along the line farthest from all cell
// middles; a crack that ends in the middle of a wide face separates nothing. Cells extend inward
// from the surface: a point belongs to the surface point s with the greatest (distance of s to the
// network) - (path length in the body to s). This is exact on the surface, keeps thin parts whole
// and meets in the middle of thick ones (an Apollonius diagram of the cells' middles).
#ifndef RAMIFY_OBJECTS_FRACTURE_CRACK_CELLS_H
#define RAMIFY_OBJECTS_FRACTURE_CRACK_CELLS_H

#include "objects/fracture/body_grid.h"
#include "outtree/out_tree.h"

typedef struct CrackCellsParams {
    BodyDistance distance;
    const void *body;
    Aabb box;         // m: around the body
    float spacing;    // m: spacing of the grid of the cells
    float least;      // m: cells in which no ball of this radius fits are merged
    float known;      // m: distances must be exact up to this far from a wall
    float roughness;  // m: height of the walls' largest bumps
    float wavelength; // m: of them
    uint64_t seed;
} CrackCellsParams;

typedef struct CrackCells CrackCells;

// The network is not referenced afterwards.
CrackCells *crack_cells_new(const OutTree *network, const CrackCellsParams *params, const Run *run,
                            Error *e);
void crack_cells_free(CrackCells *cells); // NULL is fine

int32_t crack_cells_count(const CrackCells *cells);

// Cells merged with a neighbour because they were below `least`.
int32_t crack_cells_small(const CrackCells *cells);

Aabb crack_cells_bounds(const CrackCells *cells, int32_t cell);

// Signed distance (m) from a point of the body to the wall of a cell, negative inside; *bound:
// lower bound of its magnitude. Between two cells one is minus the other. Thread-safe.
double crack_cells_distance(const CrackCells *cells, int32_t cell, Vec3 p, double *bound);

#endif
