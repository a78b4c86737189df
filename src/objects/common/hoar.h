// Hoar frost on a plant: tufts of ice needles along its branches. In still air they grow all
// around; wind that brings droplets makes them grow against it (rime).
#ifndef RAMIFY_OBJECTS_COMMON_HOAR_H
#define RAMIFY_OBJECTS_COMMON_HOAR_H

#include "objects/common/branches.h"
#include "objects/common/recipe.h"

typedef struct HoarParams {
    float length;      // m, of the needles on thin twigs; 0 = none
    float density;     // 1 = as many tufts as stand free of each other
    float wind;        // degrees from +Z toward +X: where the wind blows
    float bias;        // 0 = all around; 1 = only against the wind
    float thickest;    // m: radius of branches on which needles are half as long
    int64_t max_count; // tufts
} HoarParams;

extern const struct Table hoar_table; // of HoarParams

HoarParams hoar_params_default(void); // none

// Adds the frost on all branches of an out-tree above the ground.
bool hoar_add(const OutTree *tree, const SkinningParams *skinning, const HoarParams *params,
              const Placing *placing, int role, Error *e);

#endif
