// How an out-tree branches, looked up once for everything that measures it: children, ends below
// each node, distances from the root.
#ifndef RAMIFY_OUTTREE_BRANCHING_H
#define RAMIFY_OUTTREE_BRANCHING_H

#include "outtree/out_tree.h"

// One entry a node. Owned by the Branching.
typedef struct Branching {
    int32_t *first_child, *next_child; // -1 = none; siblings in order of index
    int32_t *children;                 // how many
    int32_t *terminals;                // ends at or below the node; 1 at an end
    int32_t *root;                     // index of the root above (or at) the node
    double *path;                      // m along the branches from the root
} Branching;

bool branching_init(Branching *branching, const OutTree *tree, Error *e);
void branching_free(Branching *branching);

// The child that goes on with the branch: the thickest; where thickness does not tell, the one that
// bears most ends; then the lowest index. -1 at an end.
int32_t branching_main_child(const Branching *branching, const OutTree *tree, int32_t node);

// Direction (unit) of the branch that leaves `node` toward `child`, read off a few nodes so that
// one step's noise does not tell: up to `reach` steps, never past a fork or an end.
Vec3 branching_direction_after(const Branching *branching, const OutTree *tree, int32_t node,
                               int32_t child, int reach);

// The same for the branch that arrives at `node`; the zero vector at a root.
Vec3 branching_direction_before(const Branching *branching, const OutTree *tree, int32_t node,
                                int reach);

#endif
