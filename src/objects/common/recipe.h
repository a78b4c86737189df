// The protocol of a recipe: how a kind of object is grown, shown and placed.
//
//     bool KIND_grow(const void *params, const Recipe *recipe, Grown *whole, Error *e);
//     bool KIND_finish(const void *params, const Recipe *recipe, const Grown *whole,
//                      Grown *grown, Error *e);
//     bool KIND_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e);
//     bool KIND_measure(const void *params, const Grown *grown, const Recipe *recipe,
//                       MeasureList *list, Error *e);
//
// grow makes the whole growth; births give the step at which each node appeared. The caller (see
// kind_grow) cuts it at a time of the growth and may keep the whole for other times. finish
// computes the radii of the cut tree and what the geometry needs besides the out-tree. A recipe
// does not know the time of the cut or whether it has grown before.
#ifndef RAMIFY_OBJECTS_COMMON_RECIPE_H
#define RAMIFY_OBJECTS_COMMON_RECIPE_H

#include "base/measures.h"
#include "base/run.h"
#include "land/height_field.h"
#include "mesh/geometry.h"
#include "objects/common/surroundings.h"
#include "outtree/out_tree.h"

#include <stdint.h>

// Carries a cut growth, in the object's own space, from its rest to its present form.
typedef struct Carrier {
    bool (*carry)(const void *user, OutTree *tree, Error *e);
    const void *user;
} Carrier;

// Arguments of every recipe besides its parameters.
typedef struct Recipe {
    uint64_t seed;     // the object's own
    const char *label; // names the object in warnings and errors: "object 'oak'"
    const Run *run;
    const struct Room *room;            // obstacles and rivals (grow/room.h); NULL = it grows alone
    const Carrier *carrier;             // NULL = it stays at rest
    const struct ShapeSurface *surface; // that it grows over (Kind.over); NULL = none
    const HeightField *land;            // the same as a terrain's heights; NULL = it is none
} Recipe;

// The result of growth. Initialize to {0}.
typedef struct Grown {
    OutTree *tree; // owned
    void *state;   // owned: further data of the kind; NULL = none
    void (*free_state)(void *state);
} Grown;

void grown_clear(Grown *grown);

// Where an object's geometry is added, and with which materials.
typedef struct Placing {
    const Recipe *recipe;
    Geometry *geometry;
    const int *material; // indices into the world's list, by the kind's roles
    const int *further;  // the same of Kind.further_material; NULL = it has none
    int object;          // index in the scene
    bool keep_land;      // maps of the land will be drawn: its heights stay with its first part
    bool keep_spray;     // a cloud shows the spray: it stays with the parts that throw it up
    bool keep_water;     // the same of falling water that is white
    Surroundings around;
} Placing;

// Adds a part with the material of the role. Takes ownership of the part's data, also on failure.
// Fails if the part has neither mesh nor curves.
bool placing_add(const Placing *placing, Part part, int role, Error *e);

// Warns about the object or a part of it ("crown"; NULL = the whole object).
void recipe_warn(const Recipe *recipe, const char *part, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

// Prefixes the error with the names of the object and of its part. Returns false.
bool recipe_fail(const Recipe *recipe, const char *part, Error *e);

// "object 'oak', crown"
enum { RECIPE_NAME_SIZE = 192 };
const char *recipe_name(const Recipe *recipe, const char *part, char name[RECIPE_NAME_SIZE]);

#endif
