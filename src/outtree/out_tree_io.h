// Reading and writing out-trees. A file is written beside the old one and then renamed, so that a
// failure never leaves half a file or harms an old one.
#ifndef RAMIFY_OUTTREE_OUT_TREE_IO_H
#define RAMIFY_OUTTREE_OUT_TREE_IO_H

#include "base/run.h"
#include "outtree/out_tree.h"

// Types of SWC's nodes; there may be others.
typedef enum SwcType {
    SWC_UNDEFINED = 0,
    SWC_SOMA = 1,
    SWC_AXON = 2,
    SWC_BASAL = 3, // dendrites
    SWC_APICAL = 4
} SwcType;

// SWC (Cannon et al. 1998): one line a node: number from 1, type (the colony of typed trees, 0 =
// undefined of others), x y z radius in metres, the parent's number or -1. Births are lost.
// ERROR_IO with the reason.
bool out_tree_write_swc(const OutTree *tree, const char *file, Error *e);

// Reads SWC strictly: every line a comment (#), blank, or exactly seven numbers with perhaps a
// comment behind them; node numbers distinct, parents -1 or the number of some node before or after
// (no circles), radii not negative; coordinates are taken as metres. Nodes keep the file's order as
// far as parents come first. Births count the nodes from the root, colonies are the types, ids are
// made anew. ERROR_INPUT with file and line; the caller frees the tree. (swc_read.c)
OutTree *out_tree_read_swc(const char *file, Error *e);

// The same in a child process with limits (base/child.h), for files that come from anywhere.
// (swc_import.c)
OutTree *out_tree_import_swc(const char *file, const Run *run, Error *e);

// GraphML (Brandes et al. 2002): a directed graph for each of `count` trees that is not NULL, named
// name[i], with an edge from each node to its children. Nodes have x, y, z, radius (m), birth,
// colony and key (the id as hexadecimal text), edges their length (m); numbers read back to the
// same bits. (graphml_write.c)
bool out_trees_write_graphml(const OutTree *const *tree, const char *const *name, int count,
                             const char *file, Error *e);

// By the file's ending, .swc, .json or .graphml; ERROR_INPUT for any other.
bool out_tree_write(const OutTree *tree, const char *file, Error *e);

#endif
