// Reads and writes out-trees. Files are written to a temporary name and renamed, so a failure
// leaves no partial file and an old one unchanged.
#ifndef RAMIFY_OUTTREE_OUT_TREE_IO_H
#define RAMIFY_OUTTREE_OUT_TREE_IO_H

#include "base/run.h"
#include "outtree/out_tree.h"

#include <stdio.h>

// Node types of SWC; files may hold others.
typedef enum SwcType {
    SWC_UNDEFINED = 0,
    SWC_SOMA = 1,
    SWC_AXON = 2,
    SWC_BASAL = 3, // dendrites
    SWC_APICAL = 4
} SwcType;

// Writes SWC (Cannon 1998), one line per node: number from 1, type (the colony of typed trees, else
// 0 = undefined), x y z and radius in metres, the parent's number or -1. Births are lost. ERROR_IO
// with the reason.
bool out_tree_write_swc(const OutTree *tree, const char *file, Error *e);

// Reads SWC strictly: every line is a comment (#), blank, or exactly seven numbers with an optional
// comment after them; node numbers are distinct, parents -1 or any node's number without cycles,
// radii not negative. Coordinates are taken as metres. Nodes keep the file's order as far as
// parents come first. Births count the nodes from the root, colonies are the types, ids are
// generated. ERROR_INPUT with file and line; the caller frees the tree. (swc_read.c)
OutTree *out_tree_read_swc(const char *file, Error *e);

// The same from a stream that no other thread uses, whose name `file` is for errors alone; the
// caller closes it. (swc_read.c)
OutTree *out_tree_parse_swc(FILE *stream, const char *file, Error *e);

// Reads a quantitative structure model: the table of cylinders that TreeQSM (Raumonen 2013) writes
// as text, in metres with z up. A row is a line of 14, 15 (2.3) or 17 numbers (2.4), separated by
// blanks or commas: radius, length, start x y z, unit axis x y z, parent and extension (rows from
// 1, 0 = none), and others, which are ignored. Comments (#), blank lines and a first line of names
// that begins with "radius" are skipped. See qsm.h for the tree. ERROR_INPUT with file, line and
// column; the caller frees the tree. (qsm_read.c)
OutTree *out_tree_read_qsm(const char *file, Error *e);

// The same from a stream, as out_tree_parse_swc. (qsm_read.c)
OutTree *out_tree_parse_qsm(FILE *stream, const char *file, Error *e);

// The same as out_tree_read_swc in a child process with limits (base/child.h), for untrusted files.
// (import.c)
OutTree *out_tree_import_swc(const char *file, const Run *run, Error *e);

// Reads .qsm, .txt and .csv as a QSM, any other file as SWC, also in a child process.
OutTree *out_tree_import(const char *file, const Run *run, Error *e);

// Writes GraphML (Brandes 2002): a directed graph named name[i] for each of `count` trees that is
// not NULL, with an edge from each node to its children. Nodes have x, y, z, radius (m), birth,
// colony and key (the id in hexadecimal), edges their length (m); numbers read back to the same
// bits. (graphml_write.c)
bool out_trees_write_graphml(const OutTree *const *tree, const char *const *name, int count,
                             const char *file, Error *e);

// Writes the format of the file's extension, .swc, .json or .graphml; ERROR_INPUT for any other.
bool out_tree_write(const OutTree *tree, const char *file, Error *e);

#endif
