// What every recipe is told besides its own parameters.
#ifndef RAMIFY_MODEL_RECIPE_H
#define RAMIFY_MODEL_RECIPE_H

#include "base/run.h"

#include <stdint.h>

typedef struct Recipe {
    uint64_t seed;     // the object's own
    const char *label; // names the object in warnings and errors: "object 'oak'"
    float grow_to;     // 0..1: how much of the growth shows; 1 = all. Recipes cut their out-tree
                       // with out_tree_keep_births before they give it radii.
    const Run *run;
} Recipe;

#endif
