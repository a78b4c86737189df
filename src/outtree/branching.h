// Topology of an out-tree, computed once for all measures: children, terminals below each node,
// path lengths from the root.
#ifndef RAMIFY_OUTTREE_BRANCHING_H
#define RAMIFY_OUTTREE_BRANCHING_H

#include "outtree/out_tree.h"

// One entry per node. Arrays owned by the Branching.
typedef struct Branching {
    int32_t *first_child, *next_child; // -1 = none; siblings in order of index
    int32_t *children;                 // number of children
    int32_t *terminals;                // number of ends at or below the node; 1 at an end
    int32_t *root;                     // index of the root above (or at) the node
    double *path;                      // m from the root along the branches
} Branching;

bool branching_init(Branching *branching, const OutTree *tree, Error *e);
void branching_free(Branching *branching);

// The child that continues the branch: the thickest; ties go to the one with most terminals, then
// to the lowest index. -1 at an end.
int32_t branching_main_child(const Branching *branching, const OutTree *tree, int32_t node);

// Unit direction of the branch that leaves `node` toward `child`, averaged over up to `reach` steps
// to suppress the noise of single steps, without passing a fork or an end.
Vec3 branching_direction_after(const Branching *branching, const OutTree *tree, int32_t node,
                               int32_t child, int reach);

// The same for the branch that arrives at `node`; the zero vector at a root.
Vec3 branching_direction_before(const Branching *branching, const OutTree *tree, int32_t node,
                                int reach);

#endif
