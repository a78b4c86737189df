// Kinds of objects: what a scene's object can be. One file kind_*.c a kind, one line in kinds.h;
// nothing else in scene/ or cli/ knows how many there are.
#ifndef RAMIFY_SCENE_KIND_H
#define RAMIFY_SCENE_KIND_H

#include "base/measures.h"
#include "config/table.h"
#include "land/height_field.h"
#include "mesh/cover.h"
#include "objects/common/recipe.h"
#include "render/world.h"
#include "scene/build.h"
#include "scene/needs.h"
#include "scene/own_space.h"

// One object on its way into the world.
typedef struct Placing {
    World *world;
    const Scene *scene;
    const SceneObject *object;
    int index;     // of the object in the scene
    Recipe recipe; // seed, label and run for the recipes of objects/
    BuildStats *stats;
} Placing;

typedef struct Kind {
    // The key of an object's mapping in the scene file, which is the kind's name for people, too;
    // the table of its parameters; the keys beside it, which all name materials.
    Variant variant;

    // What SceneObject.material is left out for: names of built-in materials, in the same order.
    const char *materials[OBJECT_MOST_MATERIALS];

    bool reads_scene; // its geometry depends on materials' values or on other objects
    bool reads_water; // it keeps out of the scene's water

    // Says where the object's own space is and takes its parameters (a copy) there; NULL = it is
    // the scene's space. grow, place and measure are given the object in its own space, and what
    // they make is carried into the scene.
    bool (*own_space)(OwnSpace *own, void *params, Error *e);

    // The out-tree, radii and all; NULL when nothing of this kind grows. The error names the
    // object (Recipe.label).
    OutTree *(*grow)(const void *params, const Recipe *recipe, Error *e);

    // Adds the object's parts to the world: from its out-tree where the kind grows one, else tree
    // is NULL.
    bool (*place)(const Placing *placing, const OutTree *tree, Error *e);

    // Heights of what is land, in the object's own space; NULL = the kind is none.
    HeightField *(*heights)(const void *params, const OutTree *tree, const Recipe *recipe,
                            Error *e);

    // Height of the ground that others stand on; NULL = the kind is none. seed: of the object.
    float (*ground)(const void *params, uint64_t seed, float x, float z);

    // Adds the object's surface to what may cover the ground, as water does; NULL = it does not.
    bool (*cover)(const void *params, Cover *cover, const Run *run, Error *e);

    // Adds what there is to measure beyond what every out-tree has; NULL = nothing.
    bool (*measure)(const void *params, const OutTree *tree, const Recipe *recipe,
                    MeasureList *list, Error *e);

    // Draws what the kind makes as a picture of one value a pixel, 0..1, row by row from the top
    // left (pixel: width * height floats); NULL = it makes no picture.
    bool (*paint)(const void *params, const OutTree *tree, int width, int height, float *pixel,
                  Error *e);

    // For `ramify info`: prints ", 14 m, ..." after the name of the kind; NULL = nothing to add.
    void (*describe)(const void *params, char *text, size_t size);

    // Fills a copy of the kind's parameters (of its table's struct) in which what follows from
    // other parameters is no longer 0, as the recipe uses it: for readers. Lists in it are not to
    // be looked at. NULL = nothing follows.
    void (*settle)(const void *params, void *settled);

    // Adds what the object's counts will take in memory; NULL = nothing worth telling beforehand.
    void (*needs)(const void *params, Needs *needs);

    // Attractors asked for, and copies (leaves, tufts) at most; NULL = none.
    int64_t (*attractors)(const void *params);
    int64_t (*copies)(const void *params);
} Kind;

// The start of a kind's variant: its key, table and documentation.
#define KIND_ROW(KEY, TABLE, DOC)                                                     \
    {                                                                                 \
        KEY_OF(SceneObject, params, KEY, KEY_POINTER), .table = (TABLE), .doc = (DOC) \
    }

// The row of a key that names material number INDEX of the kind.
#define MATERIAL_ROW(INDEX, KEY, DOC)                                     \
    {                                                                     \
        KEY_OF(SceneObject, material[INDEX], KEY, KEY_TEXT), .doc = (DOC) \
    }

// Rows that several kinds have.
#define OWN_MATERIAL_ROW(INDEX)                                                                 \
    MATERIAL_ROW(INDEX, "material",                                                             \
                 "Material of the whole, or of a tree's bark; left out: what the kind usually " \
                 "has, as bark, ground, coral, ice; clay for a mesh or a shape.")
#define TWIG_MATERIAL_ROW(INDEX) \
    MATERIAL_ROW(INDEX, "twig_material", "Material of a tree's twigs; left out: twig.")
#define LEAF_MATERIAL_ROW(INDEX)                                                               \
    MATERIAL_ROW(INDEX, "leaf_material",                                                       \
                 "Material of a tree's leaves, or of those that lie on the ground; left out: " \
                 "leaf, fallen.")
#define GRASS_MATERIAL_ROW(INDEX) \
    MATERIAL_ROW(INDEX, "grass_material", "Material of the ground's grass; left out: grass.")

// NULL from the number of kinds on.
const Kind *kind_at(int index);

static inline const char *kind_name(const Kind *kind)
{
    return kind->variant.row.key;
}

// Index in the world of the object's material number `index`, or of what the kind has in its place.
// Names were checked when the scene was read.
int placing_material(const Placing *placing, int index);

// Adds a mesh, drawn once, with the object's material number 0. Takes the mesh.
bool placing_add_mesh(const Placing *placing, Mesh *mesh, Error *e);

#endif
