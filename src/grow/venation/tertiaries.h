// Tertiary veins of a young blade that run from one secondary vein to the next, as rungs of a
// ladder (percurrent, Hickey 1973): of beech, hazel, lime, maple and most leaves with toothed
// margins.
#ifndef RAMIFY_GROW_VENATION_TERTIARIES_H
#define RAMIFY_GROW_VENATION_TERTIARIES_H

#include "grow/venation/secondaries.h"

// Places along a secondary vein are shares of its way from the midrib, 0, to its turn, 1.
typedef struct Tertiary {
    float from, to;   // where it leaves the lower vein and meets the upper one
    float bow, swing; // how far its course leaves the straight one: to one side, and as an S
} Tertiary;

// Tertiary `number` (0 = nearest to the midrib) of `count` between two secondary veins. key: of the
// random numbers of these two.
Tertiary tertiary_make(int number, int count, uint64_t key);

// A point on its way from the lower vein, t = 0, to the upper one, t = 1; m, on the full-grown
// blade.
Vec3 tertiary_point(const LeafOutline *outline, const Secondary *lower, const Secondary *upper,
                    const Tertiary *vein, float t);

#endif
