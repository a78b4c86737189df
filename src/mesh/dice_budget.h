// How much longer all edges must be for a limit on faces. Private to mesh/dice.c.
#ifndef RAMIFY_MESH_DICE_BUDGET_H
#define RAMIFY_MESH_DICE_BUDGET_H

#include "mesh/dice.h"

// The triangles to dice, 3 indices each, and their points with and without height.
typedef struct DiceTriangles {
    const uint32_t *index;
    int64_t count;
    const DicePoint *point;
    const Vec3 *displaced;
} DiceTriangles;

// Estimates the factor (>= 1) by which edges may be longer so that about rule->most_faces faces
// result. It counts the faces of a coarser dicing, about a sixteenth as many, and takes their
// number as inverse to the square of the factor.
float dice_coarsening(const DiceTriangles *triangles, const DiceRule *rule, const Run *run);

#endif
