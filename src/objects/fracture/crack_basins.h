// Basins of the distance to a network of cracks: which nodes of a body's grid belong together
// (watershed by flooding from the middles; Vincent and Soille 1991). Basins are merged where the
// border between them is open.
#ifndef RAMIFY_OBJECTS_FRACTURE_CRACK_BASINS_H
#define RAMIFY_OBJECTS_FRACTURE_CRACK_BASINS_H

#include "objects/fracture/body_grid.h"
#include "outtree/out_tree.h"

typedef struct CrackBasins {
    int32_t count; // of cells
    int32_t small; // basins merged because no ball of the least radius fits in
    int32_t *cell; // per node
    float *far;    // per node: path length in the body to the network, m; exact at surface nodes
    float *peak;   // per cell: the greatest `far`, m
} CrackBasins;

// least: m. Zero on failure; release with crack_basins_clear.
bool crack_basins_new(CrackBasins *basins, const BodyGrid *grid, const OutTree *network,
                      float least, const Run *run, Error *e);
void crack_basins_clear(CrackBasins *basins);

#endif
