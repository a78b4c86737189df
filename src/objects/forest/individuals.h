// The different trees that a forest of species is made of: grown in stands whose shade goes on
// beyond their borders, at an edge of the wood, and in the open.
#ifndef RAMIFY_OBJECTS_FOREST_INDIVIDUALS_H
#define RAMIFY_OBJECTS_FOREST_INDIVIDUALS_H

#include "objects/forest/forest.h"

typedef enum Situation { SITUATION_INNER, SITUATION_EDGE, SITUATION_OPEN } Situation;

typedef struct Individual {
    int species; // index in the forest's list
    Situation situation;
    bool kept;         // not only there to shade others
    int stand;         // those of one number grow together
    Vec3 foot;         // m, in the grown out-tree; an edge is open toward +Z
    TreeParams params; // at the origin
    uint64_t seed;
} Individual;

typedef struct Individuals {
    Individual *one;
    int count, stands;
    Vec3 tile, edge_tile; // m: extents of an inner stand and of an edge along x and z
} Individuals;

// What a forest with species will grow; the same for the same forest and seed. Free with
// individuals_free.
bool individuals_init(Individuals *all, const ForestParams *forest, uint64_t seed, Error *e);
void individuals_free(Individuals *all);

// Grows them as one out-tree: node colonies are COLONIES * (index of the individual) + that of a
// tree.
enum { INDIVIDUAL_COLONIES = TREE_COLONIES };
bool individuals_grow(const Individuals *all, const Recipe *recipe, OutTree *into, Error *e);

// The nodes of one individual, moved to the origin, with a tree's colonies.
OutTree *individuals_tree(const Individuals *all, const OutTree *grown, int index, Error *e);

#endif
