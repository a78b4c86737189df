// Strahler orders and Horton's ratios of an out-tree (Horton 1945, Strahler 1957).
#ifndef RAMIFY_OUTTREE_STRAHLER_H
#define RAMIFY_OUTTREE_STRAHLER_H

#include "outtree/out_tree.h"

// Fills order[tree->count]: 1 at the ends; a node has the highest order of its children, plus one
// if two or more of them share it.
void out_tree_strahler(const OutTree *tree, int32_t *order);

// A stream is a maximal path of nodes of equal order. The ratios compare streams of consecutive
// orders, by a least-squares line through the logarithms: number (order to the next higher), mean
// length and mean diameter (order to the next lower).
typedef struct HortonRatios {
    int32_t highest;                 // order; 0 = there are no nodes
    double number, length, diameter; // RB, RL, RD; NAN if there are fewer than two orders
} HortonRatios;

bool out_tree_horton(const OutTree *tree, HortonRatios *ratios, Error *e);

#endif
