// Anastomosis: joins tips to nearby branches, closing loops. An out-tree has no cycles, so a join
// adds a node: a child of the tip at exactly the position of the node it joins.
#ifndef RAMIFY_OUTTREE_JOIN_H
#define RAMIFY_OUTTREE_JOIN_H

#include "base/error.h"
#include "base/run.h"
#include "outtree/out_tree.h"

typedef struct JoinParams {
    float reach;        // m, largest distance from a tip to the node it joins
    float least_path;   // m, least path length between the two along the branches; prevents small
                        // loops
    float least_cosine; // of the angle between the tip's direction and the join
    float spacing; // m along a branch between bridges that grow from its sides, within reach, to
                   // other branches; 0 = tips alone join
    bool all_one;  // then connect the remaining components at their nearest nodes until there
                   // is one
} JoinParams;

// Joins each tip to the nearest suitable node (ties: the lowest index) whose normal is on the same
// side; two tips join once. Then, with a spacing, does the same from the sides of branches, which
// makes a net of them. A join's birth is one after the later of its ends. *joins (may be NULL) is
// set to the number of nodes added. Takes O(tips x nodes) time, with a spacing O(nodes^2).
bool out_tree_join_tips(OutTree *tree, const JoinParams *params, int64_t *joins, const Run *run,
                        Error *e);

// Counts the connected components of the tree with its joins (nodes at equal positions), and its
// independent loops (edges - places + components; may be NULL).
bool out_tree_count_pieces(const OutTree *tree, int64_t *pieces, int64_t *loops, Error *e);

// Which nodes lie at exactly another node's position: tree->count flags, which the caller frees.
bool *out_tree_find_joined(const OutTree *tree, Error *e);

// Whether the path from a to b along the branches is at least `least` m long; always true between
// two trees.
bool out_tree_path_exceeds(const OutTree *tree, int64_t a, int64_t b, float least);

#endif
