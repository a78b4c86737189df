// Boughs of an out-tree: what grows from its main axis, each with all that grows from it.
#ifndef RAMIFY_OBJECTS_COMMON_BOUGHS_H
#define RAMIFY_OBJECTS_COMMON_BOUGHS_H

#include "objects/common/plant_cells.h"
#include "outtree/out_tree.h"

typedef struct Boughs {
    const OutTree *tree;
    int32_t *bough;   // per node: the first node of its bough; the root's index on the main axis
    PlantCells cells; // of the nodes
    int64_t *first;   // per cell, and one more: into node
    int32_t *node;    // by cells
} Boughs;

// Keeps the tree's address. Clear with boughs_free, also on failure.
bool boughs_init(Boughs *boughs, const OutTree *tree, Error *e);
void boughs_free(Boughs *boughs);

// The bough of the node nearest to p, by its first node; -1 without one in the cells about p.
int32_t boughs_nearest(const Boughs *boughs, Vec3 p);

#endif
