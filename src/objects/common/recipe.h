// The protocol of a recipe: how a kind of object is grown, shown and placed.
//
//     bool KIND_grow(const void *params, const Recipe *recipe, Grown *whole, Error *e);
//     bool KIND_finish(const void *params, const Recipe *recipe, const Grown *whole,
//                      Grown *grown, Error *e);
//     bool KIND_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e);
//     bool KIND_measure(const void *params, const Grown *grown, const Recipe *recipe,
//                       MeasureList *list, Error *e);
//
// grow makes all of the growth, with births that tell when each node came. What shows at a time of
// the growth is cut from it by whoever calls (see kind_grow), which may keep the whole for other
// times. finish gives what is left its radii and finds what the geometry needs beside the out-tree.
// A recipe knows neither how much of it shows nor whether it has grown before.
#ifndef RAMIFY_OBJECTS_COMMON_RECIPE_H
#define RAMIFY_OBJECTS_COMMON_RECIPE_H

#include "base/measures.h"
#include "base/run.h"
#include "mesh/geometry.h"
#include "objects/common/surroundings.h"
#include "outtree/out_tree.h"

#include <stdint.h>

// What every recipe is told besides its own parameters.
typedef struct Recipe {
    uint64_t seed;     // the object's own
    const char *label; // names the object in warnings and errors: "object 'oak'"
    const Run *run;
} Recipe;

// What has grown. Begins as {0}.
typedef struct Grown {
    OutTree *tree; // owned
    void *state;   // owned: what else the kind keeps; NULL = nothing
    void (*free_state)(void *state);
} Grown;

void grown_clear(Grown *grown);

// Where an object's geometry goes.
typedef struct Placing {
    const Recipe *recipe;
    Geometry *geometry;
    const int *material; // indices into the world's list, by the kind's roles
    int object;          // index in the scene
    Surroundings around;
} Placing;

// Adds a part with the material of the role. Takes what the part owns, also when it fails; a part
// with neither mesh nor curves fails.
bool placing_add(const Placing *placing, Part part, int role, Error *e);

// Warns of the object, or of a part of it ("crown"; NULL = all of it).
void recipe_warn(const Recipe *recipe, const char *part, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

// Puts the names of the object and of its part before the error. Returns false.
bool recipe_fail(const Recipe *recipe, const char *part, Error *e);

// "object 'oak', crown"
enum { RECIPE_NAME_SIZE = 192 };
const char *recipe_name(const Recipe *recipe, const char *part, char name[RECIPE_NAME_SIZE]);

#endif
