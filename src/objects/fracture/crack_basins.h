// Basins of the distance to a network of cracks: which nodes of a body's grid belong together
// (watershed by flooding from the middles; Vincent and Soille 1991), merged where what parts them
// is open.
#ifndef RAMIFY_OBJECTS_FRACTURE_CRACK_BASINS_H
#define RAMIFY_OBJECTS_FRACTURE_CRACK_BASINS_H

#include "objects/fracture/body_grid.h"
#include "outtree/out_tree.h"

typedef struct CrackBasins {
    int32_t count; // of cells
    int32_t small; // basins that joined a neighbour for holding no ball of the least radius
    int32_t *cell; // per node
    float *far;    // per node: way through the body to the network, m; right at surface nodes
    float *peak;   // per cell: the greatest of them, m
} CrackBasins;

// least: m. Zero on failure; release with crack_basins_clear.
bool crack_basins_new(CrackBasins *basins, const BodyGrid *grid, const OutTree *network,
                      float least, const Run *run, Error *e);
void crack_basins_clear(CrackBasins *basins);

#endif
