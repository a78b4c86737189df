// Strahler orders and Horton's ratios of an out-tree (Horton 1945, Strahler 1957).
#ifndef RAMIFY_OUTTREE_STRAHLER_H
#define RAMIFY_OUTTREE_STRAHLER_H

#include "outtree/out_tree.h"

// Fills order[tree->count]: 1 at the ends; a node has the highest order of its children, and one
// more where two or more of them have it.
void out_tree_strahler(const OutTree *tree, int32_t *order);

// A stream is a longest stretch of nodes of one order. The ratios are those of neighbouring orders'
// streams, from a least-squares line through their logarithms: number (order to the next higher),
// mean length and mean diameter (order to the next lower).
typedef struct HortonRatios {
    int32_t highest;                 // order; 0 = there are no nodes
    double number, length, diameter; // RB, RL, RD; NAN = fewer than two orders to compare
} HortonRatios;

bool out_tree_horton(const OutTree *tree, HortonRatios *ratios, Error *e);

#endif
