// Closing loops in an out-tree: tips that come near another branch are joined to it. An out-tree
// holds no loops, so a join is a node more: a child of the tip at the very place of the node it
// joins.
#ifndef RAMIFY_OUTTREE_JOIN_H
#define RAMIFY_OUTTREE_JOIN_H

#include "base/error.h"
#include "base/run.h"
#include "outtree/out_tree.h"

typedef struct JoinParams {
    float reach;        // m, from a tip to what it joins
    float least_path;   // m, between the two along the branches: no small loops
    float least_cosine; // of the angle between the tip's heading and the join
    bool all_one;       // then join what still hangs apart, at the nearest places, until all is one
} JoinParams;

// Joins each tip to the nearest node that suits (ties: the lowest index) and has a normal on the
// same side; two tips join once. A join's birth is one after the later of its ends. *joins = how
// many nodes were added; may be NULL. Takes time with tips x nodes.
bool out_tree_join_tips(OutTree *tree, const JoinParams *params, int64_t *joins, const Run *run,
                        Error *e);

// Pieces that the tree and its joins (nodes at the same place) make, and the loops in them that do
// not follow from one another (edges - places + pieces; may be NULL).
bool out_tree_count_pieces(const OutTree *tree, int64_t *pieces, int64_t *loops, Error *e);

// Is the way from a to b along the branches at least `least` long, m? Always so between two trees.
bool out_tree_path_exceeds(const OutTree *tree, int64_t a, int64_t b, float least);

#endif
