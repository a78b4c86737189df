// What befalls a tree in its life: neighbours that hold limbs back, storms, shade, death. Each
// individual has, by its seed, a fortune of its own, so that no two of a stand are alike.
#ifndef RAMIFY_OBJECTS_TREE_HAZARDS_H
#define RAMIFY_OBJECTS_TREE_HAZARDS_H

#include "objects/tree/tree.h"

// May anything befall the tree? If not, tree_befall changes nothing.
bool tree_has_hazards(const HazardParams *hazards);

// Makes of a tree that is grown by light, with radii and without roots, what its seed has in store:
// limbs are shortened, lengthened and killed, the top is forked or dead, or all of it. Dead nodes
// become TREE_SNAGS, without thin twigs. params: resolved (defaults.h); the tree stands at
// params->position.
bool tree_befall(OutTree *tree, const TreeParams *params, uint64_t seed, Error *e);

// Is all of a grown tree dead, so that it bears neither leaves nor organs?
bool tree_is_dead(const OutTree *tree, const HazardParams *hazards);

#endif
