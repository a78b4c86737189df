// Kinds of objects: what an object of a scene can be. A folder a kind, one line in kinds.h; nothing
// outside a kind's folder knows how many there are, and a kind knows nothing of scenes.
#ifndef RAMIFY_OBJECTS_KIND_H
#define RAMIFY_OBJECTS_KIND_H

#include "config/table.h"
#include "land/height_field.h"
#include "mesh/cover.h"
#include "objects/common/needs.h"
#include "objects/common/own_space.h"
#include "objects/common/recipe.h"

enum { OBJECT_MOST_MATERIALS = 6 };

typedef struct SceneObject {
    char *name;
    uint64_t seed; // 0 = from the scene's seed and the name
    const struct Kind *kind;
    void *params; // of the kind
    // Names of materials by the kind's roles; NULL = the kind's own choice (Kind.materials).
    char *material[OBJECT_MOST_MATERIALS];
} SceneObject;

typedef struct Kind {
    // The key of an object's mapping in the scene file, which is the kind's name for people, too;
    // the table of its parameters; the keys beside it, which all name materials.
    Variant variant;

    // Built-in materials by role, for those of SceneObject.material that are left out; NULL = as
    // the first role's.
    const char *materials[OBJECT_MOST_MATERIALS];

    // The built-in materials that this kind alone uses by itself, ended by one without a name; NULL
    // = none.
    const struct Material *builtin;

    bool reads_scene; // its geometry depends on materials' values or on other objects
    bool reads_water; // it keeps out of the scene's water

    // Says where the object's own space is and takes its parameters (a copy) there; NULL = it is
    // the scene's space. The recipe is given the object in its own space, and what it makes is
    // carried into the scene.
    bool (*own_space)(OwnSpace *own, void *params, Error *e);

    // The recipe: see objects/common/recipe.h. NULL where a kind has none of it. tip_radius: m,
    // what nodes begin with, where they thicken as they age; NULL = they show as they are, or not.
    bool (*grow)(const void *params, const Recipe *recipe, Grown *whole, Error *e);
    float (*tip_radius)(const void *params, const OutTree *whole);
    bool (*finish)(const void *params, const Recipe *recipe, const Grown *whole, Grown *grown,
                   Error *e);
    bool (*geometry)(const void *params, const Grown *grown, const Placing *placing, Error *e);
    bool (*measure)(const void *params, const Grown *grown, const Recipe *recipe, MeasureList *list,
                    Error *e);

    // Heights of what is land, in the object's own space; NULL = the kind is none.
    HeightField *(*heights)(const void *params, const Grown *grown, const Run *run, Error *e);

    // Height of the ground that others stand on; NULL = the kind is none. seed: of the object.
    float (*ground)(const void *params, uint64_t seed, float x, float z);

    // Adds the object's surface to what may cover the ground, as water does; NULL = it does not.
    bool (*cover)(const void *params, Cover *cover, const Run *run, Error *e);

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

// Grows what shows at grow_to (0..1) of the growth; a kind that does not grow has nothing. memory,
// if not NULL, keeps the whole growth ({0} at first), so that another grow_to need not grow again.
// Clear both with grown_clear, also on failure.
bool kind_grow(const Kind *kind, const void *params, const Recipe *recipe, float grow_to,
               Grown *memory, Grown *grown, Error *e);

#endif
