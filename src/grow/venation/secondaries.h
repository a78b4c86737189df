// Secondary veins of a young blade: pinnate and brochidodromous, that is, they leave the midrib on
// both sides, bend toward the tip and end short of the margin in an arch to the next one (Hickey
// 1973).
#ifndef RAMIFY_GROW_VENATION_SECONDARIES_H
#define RAMIFY_GROW_VENATION_SECONDARIES_H

#include "shape/leaf_outline.h"

#include <stdint.h>

#define SECONDARY_JOIN 0.72f // share of the half width where the arch of the one below joins
#define SECONDARY_TURN 0.80f // ... and where a vein turns into its own arch

// In the blade's coordinates: u, the share of the half width from the midrib, v, of the length.
typedef struct Secondary {
    float side;    // -1 or 1
    float base;    // v where it leaves the midrib
    float rise;    // v that it would gain up to the margin
    Vec2 arch[3];  // control points of its arch (quadratic Bezier)
    bool has_arch; // not the one nearest to the tip
} Secondary;

// Secondary `number` (0 = nearest to the base) of `count` on a side (-1 or 1). key: for its random
// numbers, that of all of the leaf's.
Secondary secondary_make(const LeafOutline *outline, int number, int count, float side,
                         uint64_t key);

// A point on the way from the midrib, t = 0, to the turn, t = 1; m, on the full-grown blade.
Vec3 secondary_point(const LeafOutline *outline, const Secondary *vein, float t);

// A point on the arch, from the turn, t = 0, to the next vein, t = 1.
Vec3 secondary_arch_point(const LeafOutline *outline, const Secondary *vein, float t);

// Where a point lies among `count` secondary veins of its side, were they not uneven: k on vein k,
// k + 0.5 half-way to the next.
float secondary_number(const LeafOutline *outline, int count, Vec3 p);

#endif
