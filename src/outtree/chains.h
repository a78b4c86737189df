// Decomposition of the out-tree into chains: unbranched paths from a fork to a tip. At every node
// the heaviest child continues the chain; the other children begin new chains.
#ifndef RAMIFY_OUTTREE_CHAINS_H
#define RAMIFY_OUTTREE_CHAINS_H

#include "base/error.h"
#include "outtree/out_tree.h"

typedef struct ChainSet {
    int64_t count;
    int64_t *first;  // count + 1 entries: chain i has the nodes first[i] .. first[i + 1] - 1
    int32_t *node;   // nodes in chain order; a side chain begins with the fork node that it leaves
    int32_t *parent; // the chain that it leaves, always of lower index; -1 from a root
    int32_t *order;  // 0 from a root, else the parent's plus 1
} ChainSet;

// The heaviest child is the thickest; ties (all nodes, before there are radii) go to the one with
// more nodes below it, then to the first. Memory O(nodes).
ChainSet *out_tree_chains(const OutTree *tree, Error *e);
void chains_free(ChainSet *chains); // NULL is fine

// Copies the tree with nodes about `segment` m apart. Roots, forks and tips stay where they are;
// new nodes are spaced evenly between them. Position, radius, normal and birth are interpolated
// linearly. ERROR_INPUT when segment is not positive or would give too many nodes. The caller frees
// the tree.
OutTree *out_tree_resample(const OutTree *tree, float segment, Error *e);

#endif
