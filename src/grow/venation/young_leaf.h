// The state of a growing leaf, and how it begins.
#ifndef RAMIFY_GROW_VENATION_YOUNG_LEAF_H
#define RAMIFY_GROW_VENATION_YOUNG_LEAF_H

#include "grow/venation/venation.h"

// Sum of the sources' pulls on a node.
typedef struct Pull {
    Vec3 sum;       // of unit vectors to its sources
    Vec3 nearest;   // unit: to the nearest of them
    float distance; // m, to that
} Pull;

// State of a growing leaf.
typedef struct Leaf {
    const Run *run;
    const VeinParams *params;
    OutTree *tree;
    int32_t *children; // number of children, per node
    Pull *pull;        // per node
    int64_t child_capacity, pull_capacity;
    Vec3 *source; // sources alive
    int64_t source_count, source_capacity;
    PointSet *all_sources;
    VeinGrid nodes, darts;
    float scale; // relative size of the blade
    int32_t birth;
    VeinReport report;
} Leaf;

// Adds a node born now; parent -1: the root. Returns its index, or -1 and e when out of memory.
int64_t leaf_add_node(Leaf *leaf, Vec3 p, int64_t parent, Error *e);

// Plants the veins of the young blade, at leaf->scale: the midrib, then the secondary veins of each
// side from the tip down.
bool leaf_plant(Leaf *leaf, Error *e);

#endif
