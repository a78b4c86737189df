// What the years leave on a tree: dead limbs without bark, mistletoe, moss at the foot.
#ifndef RAMIFY_OBJECTS_TREE_VETERAN_H
#define RAMIFY_OBJECTS_TREE_VETERAN_H

#include "objects/tree/tree.h"

// Kills limbs of a grown tree that is older than its mature age, the highest first: their nodes
// become TREE_SNAGS, and their twigs fall. params: resolved, with the age.
bool tree_kill_limbs(OutTree *tree, const TreeParams *params, uint64_t seed, Error *e);

// The living wood of a tree, and its dead wood with the nodes in living wood that it begins at; no
// knots. *dead is NULL if there is none. The caller frees both, also after a failure.
bool tree_split_dead(const OutTree *tree, OutTree **living, OutTree **dead, Error *e);

// Share of the length of limbs, wood of 1 cm radius and more, that is dead.
double tree_dead_share(const OutTree *tree);

// Number of balls of mistletoe on the tree, and the nodes that bear them (at least that many
// entries, or NULL).
int tree_mistletoe(const OutTree *tree, const TreeParams *params, uint64_t seed, int32_t *node);

// Add the parts of these, if the tree has them. bark: its mesh.
bool tree_add_mistletoe(const OutTree *tree, const TreeParams *params, const Placing *placing,
                        Error *e);
bool tree_add_moss(const Mesh *bark, const TreeParams *params, const Placing *placing, Error *e);

// Adds the knots where shed limbs were overgrown (nodes of TREE_KNOTS): rings of callus about dead
// wood.
bool tree_add_knots(const OutTree *tree, const Placing *placing, Error *e);

#endif
