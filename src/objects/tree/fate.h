// What is in store for one tree, drawn from its seed.
#ifndef RAMIFY_OBJECTS_TREE_FATE_H
#define RAMIFY_OBJECTS_TREE_FATE_H

#include "objects/tree/tree.h"

enum { MOST_NEIGHBOURS = 3 };

// Of the angle's deviation: that of a tree, and that of each of its limbs.
#define FATE_OWN_PITCH 0.7f

typedef struct Neighbour {
    float sine, cosine; // of its azimuth
    float top;          // its height, share of the tree's
    float strength;     // 0..1
} Neighbour;

typedef struct Fate {
    float width; // factor on the length of its limbs
    float pitch; // degrees by which they hang
    float bare;  // height (share) below which limbs are dead
    float lost;  // share of its limbs
    float fork;  // height of the fork, share; 0 = none
    float top;   // height from which the top is dead, share; 0 = it lives
    bool dead;
    float broken; // height above which a dead tree has broken off, share
    Neighbour neighbour[MOST_NEIGHBOURS];
    int neighbours;
} Fate;

// seed: of the tree's hazards. height shares are of the tree's.
Fate fate_draw(const HazardParams *hazards, uint64_t seed);

#endif
