// Outline of a leaf's blade in the plane, from its base at the origin up the y axis to its tip.
#ifndef RAMIFY_SHAPE_LEAF_OUTLINE_H
#define RAMIFY_SHAPE_LEAF_OUTLINE_H

#include "base/vec.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct LeafOutline {
    float length, width; // m, of the blade
    float widest; // 0..1 of the length, where the blade is widest: below 0.5 ovate, above obovate
    float tip;    // shape of base and tip: 1 = elliptic, 2 = pointed

    // The margin: with all of these 0 it is that smooth curve itself.
    int teeth;         // on each side; 0 = an entire margin
    float tooth_depth; // m, from notch to point; 0 = 0.4 of a tooth's length
    float tooth_round; // 0..1: from saw teeth that point to the tip to round scallops
    bool double_teeth; // three small ones on each
    float uneven;      // 0..1: how much teeth, and the two sides of the blade, differ
    uint64_t key;      // of the random numbers of that
} LeafOutline;

// Half of the blade's width at height y without teeth, m; 0 below and above the blade.
float leaf_half_width(const LeafOutline *outline, float y);

// Does the margin differ from that width?
bool leaf_has_margin(const LeafOutline *outline);

// Distance of the margin from the midrib at height y on a side, -1 or 1; m. At least two thirds of
// leaf_half_width, at most four thirds.
float leaf_margin(const LeafOutline *outline, float side, float y);

// The point of tooth 0 <= number < teeth on a side, counted from the base.
Vec3 leaf_tooth(const LeafOutline *outline, float side, int number);

// Whether the point lies within the margin of the blade scaled by `scale` about its base.
bool leaf_contains(const LeafOutline *outline, float scale, Vec3 p);

#endif
