// Which edges are halved, and how a triangle is divided whose edges are. Private to mesh/dice*.c.
#ifndef RAMIFY_MESH_DICE_SPLIT_H
#define RAMIFY_MESH_DICE_SPLIT_H

#include "mesh/dice.h"

// The parts of a triangle: corners 0..2 are its own, 3 + k is the middle of edge (k, k + 1).
typedef struct DiceSplit {
    int count;
    uint8_t corner[4][3];
} DiceSplit;

// Is the edge between two points longer than the rule wants, or than `coarsening` times that?
// *_displaced: the points with their height.
bool dice_is_long(const DiceRule *rule, float coarsening, const DicePoint *a, Vec3 a_displaced,
                  const DicePoint *b, Vec3 b_displaced);

// mark: bit k = edge k is halved; not 0. position: of the corners and of the middles of such edges,
// on the smooth surface.
DiceSplit dice_split(unsigned mark, const Vec3 position[6]);

#endif
