// Cracks in a sheet of clear ice, as on frozen lakes: white faces that go down into dark ice. They
// open one after the other. A crack starts where the ice is farthest from older ones, in the
// direction that they leave, runs both ways with small turns, bends toward an older crack, along
// which tension has remained and across which it is gone, and ends on it at about a right angle
// (Bohn, Pauchard and Couder, Hierarchical crack pattern as formed by successive domain divisions,
// 2005). Where tension is the same in all directions, three cracks open at once, 120 degrees apart.
#ifndef RAMIFY_OBJECTS_ICE_CRACKS_ICE_CRACKS_H
#define RAMIFY_OBJECTS_ICE_CRACKS_ICE_CRACKS_H

#include "objects/common/recipe.h"

typedef struct IceCracksParams {
    Vec3 position; // m, middle of the ice's surface
    Vec3 rotation; // degrees, about x, then y, then z
    float size;    // m, side of the square
    float depth;   // m, of the deepest cracks
    float spacing; // m, mean distance from crack to crack along a line over the ice
    float stars;   // 0..1: share of cracks that open as three
    float loose;   // 0..1: share of ends that stop in the ice before they meet another crack
    float wander;  // degrees by which a crack turns over a spacing, rms
    float tilt;    // degrees of its faces from vertical, rms
    float healed;  // 0..1: share of the faces that have frozen together again and cannot be seen
    float grain;   // m, the finest structure of the faces; 0 = a hundredth of the spacing
} IceCracksParams;

enum { ICE_CRACK_ARMS = 3 }; // most that start at one place

extern const struct Table ice_cracks_table; // of its parameters

IceCracksParams ice_cracks_params_default(void);

// m, of the steps in which cracks grow, and of the faces' mesh.
float ice_cracks_step(const IceCracksParams *params);
float ice_cracks_grain(const IceCracksParams *params);

// Does this arm (0, 1, 2) of a crack end in the ice if it gets as far as *length (m)?
bool ice_cracks_arm_is_loose(const IceCracksParams *params, uint64_t seed, int32_t crack, int arm,
                             float *length);

// The recipe (see recipe.h), in its own space: the ice's surface is y = 0. A crack is a root and
// its two or three arms, which are its children number 0, 1, 2; its colony is its number in the
// order of time. Normal = horizontal, across the crack.
bool ice_cracks_grow(const void *params, const Recipe *recipe, Grown *whole, Error *e);

// One mesh: the faces of all cracks, from just below the surface down.
bool ice_cracks_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e);

// Appends cracks (number), crack_spacing (m, by Crofton's formula pi area / (2 length)),
// junction_angle (degrees, mean between a crack and the older one that it ends on).
bool ice_cracks_measure(const void *params, const Grown *grown, const Recipe *recipe,
                        MeasureList *list, Error *e);

#endif
