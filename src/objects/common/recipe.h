// What every recipe is told besides its own parameters.
#ifndef RAMIFY_OBJECTS_COMMON_RECIPE_H
#define RAMIFY_OBJECTS_COMMON_RECIPE_H

#include "base/run.h"
#include "outtree/out_tree.h"

#include <stdint.h>

// What a recipe has grown, before anything was cut off it: so that the same object at another time
// of its growth need not grow again. Begins as {0}; cleared by whoever made it.
typedef struct RecipeMemory {
    OutTree *tree[2]; // owned; NULL = nothing yet
    uint64_t *id;     // owned: names of nodes that the recipe has to find again; or NULL
} RecipeMemory;

typedef struct Recipe {
    uint64_t seed;     // the object's own
    const char *label; // names the object in warnings and errors: "object 'oak'"
    float grow_to;     // 0..1: how much of the growth shows; 1 = all. Recipes cut their out-tree
                       // with out_tree_keep_births before they give it radii.
    const Run *run;
    RecipeMemory *memory; // NULL = the object is grown once only
} Recipe;

// Has the recipe grown its tree number `index` (0 or 1) before?
static inline bool recipe_remembers(const Recipe *recipe, int index)
{
    return recipe->memory && recipe->memory->tree[index];
}

// A copy of that tree as it was kept.
OutTree *recipe_recall(const Recipe *recipe, int index, Error *e);

// Keeps a copy of a tree for recipe_recall. Does nothing where there is no memory.
bool recipe_keep(const Recipe *recipe, int index, const OutTree *tree, Error *e);

// The same with count ids.
bool recipe_keep_ids(const Recipe *recipe, const uint64_t *id, int64_t count, Error *e);

void recipe_memory_clear(RecipeMemory *memory);

#endif
