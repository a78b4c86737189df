// Reading and writing out-trees. A file is written beside the old one and then renamed, so that a
// failure never leaves half a file or harms an old one.
#ifndef RAMIFY_TREE_OUT_TREE_IO_H
#define RAMIFY_TREE_OUT_TREE_IO_H

#include "base/error.h"
#include "tree/out_tree.h"

// SWC (Cannon et al. 1998): one line a node: number from 1, type (0, undefined), x y z radius in
// metres, the parent's number or -1. Births and colonies are lost. ERROR_IO with the reason.
bool out_tree_write_swc(const OutTree *tree, const char *file, Error *e);

// Reads SWC strictly: every line a comment (#), blank, or exactly seven numbers; node numbers
// distinct, parents -1 or the number of some node before or after (no circles), radii not negative;
// coordinates are taken as metres. Nodes keep the file's order as far as parents come first. Births
// count the nodes from the root, colonies are the types, ids are made anew. ERROR_INPUT with file
// and line; the caller frees the tree. (swc_read.c)
OutTree *out_tree_read_swc(const char *file, Error *e);

// JSON: one object with the arrays position ([x, y, z] in metres), parent (-1 at roots), birth,
// colony, radius (metres) and id (hexadecimal strings). Numbers read back to the same bits.
bool out_tree_write_json(const OutTree *tree, const char *file, Error *e);

// By the file's ending, .swc or .json; ERROR_INPUT for any other.
bool out_tree_write(const OutTree *tree, const char *file, Error *e);

#endif
