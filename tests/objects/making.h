// What a kind of object makes of its parameters, without a scene.
#ifndef RAMIFY_TESTS_OBJECTS_MAKING_H
#define RAMIFY_TESTS_OBJECTS_MAKING_H

#include "objects/kinds.h"

// The out-tree of what has grown at grow_to. NULL and e on failure.
static inline OutTree *grow_kind(const Kind *kind, const void *params, const Recipe *recipe,
                                 float grow_to, Error *e)
{
    Grown grown;
    kind_grow(kind, params, recipe, grow_to, NULL, &grown, e);
    OutTree *tree = grown.tree;
    grown.tree = NULL;
    grown_clear(&grown);
    return tree;
}

// For a recipe that has no state beside its out-tree. Borrows it.
static inline Grown grown_of(const OutTree *tree)
{
    return (Grown){.tree = (OutTree *)tree};
}

// Materials 0, 1, 2, ... by role, nothing around.
static inline Placing placing_in(Geometry *geometry, const Recipe *recipe)
{
    static const int material[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
    return (Placing){.recipe = recipe, .geometry = geometry, .material = material};
}

#endif
