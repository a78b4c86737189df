// Cylinders of a quantitative structure model (QSM) and the out-tree made of them.
#ifndef RAMIFY_OUTTREE_QSM_H
#define RAMIFY_OUTTREE_QSM_H

#include "outtree/out_tree.h"

typedef struct Cylinder {
    double start[3]; // m, z up
    double axis[3];  // unit
    double radius, length;
    int64_t parent, extension;                     // row; -1 = none
    int32_t line, parent_column, extension_column; // in the file, for errors
} Cylinder;

// Makes an out-tree of cylinders: y up, the first root at the origin, a node at the end of each
// cylinder, with its radius, and one at the start of each root. An extension begins at the end of
// its parent, a side branch where its axis, prolonged backward, comes nearest to the parent's axis,
// which gets a node there. ERROR_INPUT, located in `file`, if cylinders are their own ancestors.
OutTree *qsm_make_tree(const Cylinder *cylinder, int64_t count, const char *file, Error *e);

#endif
