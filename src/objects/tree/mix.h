// The kinds of trees that a wood is made of, with their shares and materials.
#ifndef RAMIFY_OBJECTS_TREE_MIX_H
#define RAMIFY_OBJECTS_TREE_MIX_H

#include "objects/tree/tree.h"

typedef struct TreeShare {
    float share; // of the wood's trees, relative to the others'
    TreeParams *tree;
    char *material[TREE_ROLES]; // names by a tree's roles; NULL = a tree's own
} TreeShare;

extern const struct Table tree_share_table;

// Name of the material of role i % TREE_ROLES of tree i / TREE_ROLES; NULL past the last one.
const char *tree_mix_material(const TreeShare *mix, int count, int i);

// Gives all trees the state of leaves of a season, as tree: {season: ...} does; 0 = leaves them.
void tree_mix_set_season(TreeShare *mix, int count, float season);

// The tree that a random number u (0..1) chooses by the shares.
int tree_mix_choose(const TreeShare *mix, int count, float u);

#endif
