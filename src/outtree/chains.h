// The out-tree as chains: unbranched ways from a fork to a tip. From every node its heaviest child
// goes on the chain, the other children begin chains of their own.
#ifndef RAMIFY_OUTTREE_CHAINS_H
#define RAMIFY_OUTTREE_CHAINS_H

#include "base/error.h"
#include "outtree/out_tree.h"

typedef struct ChainSet {
    int64_t count;
    int64_t *first;  // count + 1 entries: chain i has the nodes first[i] .. first[i + 1] - 1
    int32_t *node;   // along the chains. A chain that leaves another begins with the node it leaves
    int32_t *parent; // the chain that it leaves, always an earlier one; -1 from a root
    int32_t *order;  // 0 from a root, else the parent's + 1
} ChainSet;

// The heaviest child is the thickest; of equally thick ones (all, before there are radii) the one
// that bears more nodes; then the first. Memory O(nodes).
ChainSet *out_tree_chains(const OutTree *tree, Error *e);
void chains_free(ChainSet *chains); // NULL is fine

// A copy of the tree with nodes about `segment` m apart: between the nodes that matter (roots,
// forks, tips), which stay as they are, new ones stand evenly along the way. Position, radius,
// normal and birth run linearly from old node to old node. ERROR_INPUT when segment is not above 0
// or asks for too many nodes.
OutTree *out_tree_resample(const OutTree *tree, float segment, Error *e);

#endif
