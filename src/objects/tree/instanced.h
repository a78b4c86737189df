// A tree that stands in many places: its leaves become one mesh, which traces faster than many
// small instances and can be instanced again.
#ifndef RAMIFY_OBJECTS_TREE_INSTANCED_H
#define RAMIFY_OBJECTS_TREE_INSTANCED_H

#include "objects/tree/tree.h"

typedef struct InstancedTree {
    const Transform *place; // from the tree at the origin
    int64_t count;
    const int *material; // indices into the world's list, by a tree's roles
    int64_t most_leaves; // of more, some are left out and the others enlarged to the same area
    int64_t most_faces;  // of all leaves: their coarser forms are taken if there would be more
    bool distant;        // the coarsest forms are enough, and organs are left out
    uint64_t seed;
} InstancedTree;

// Adds the parts of a grown tree at all places. Leaves keep their colours in a few groups each of
// one season and variation. Adds nothing for 0 places.
bool tree_add_instanced(const TreeParams *params, const Grown *grown, const InstancedTree *how,
                        const Placing *placing, Error *e);

#endif
