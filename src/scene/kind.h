// Kinds of objects: what a scene's object can be. One file kind_*.c a kind, one line in kinds.c;
// nothing else in scene/ or cli/ knows how many there are.
#ifndef RAMIFY_SCENE_KIND_H
#define RAMIFY_SCENE_KIND_H

#include "base/measures.h"
#include "land/height_field.h"
#include "objects/common/recipe.h"
#include "render/world.h"
#include "scene/build.h"
#include "scene/needs.h"
#include "scene/own_space.h"

enum { KIND_MOST_MATERIALS = 6 };

// One object on its way into the world.
typedef struct Placing {
    World *world;
    const Scene *scene;
    const SceneObject *object;
    int index;     // of the object in the scene
    Recipe recipe; // seed, label and run for the recipes of model/
    BuildStats *stats;
} Placing;

typedef struct Kind {
    const char *key;  // of SceneObject's mapping in the scene file, and its name for people
    size_t offset;    // of its pointer in SceneObject
    bool reads_scene; // its geometry depends on materials' values or on other objects
    bool reads_water; // it keeps out of the scene's water
    const char *materials[KIND_MOST_MATERIALS]; // keys of the object that name materials; NULL ends

    // Says where the object's own space is and puts own->object, so far the scene's, into it; NULL
    // = it is the scene's space. grow, place and measure are given the object in its own space, and
    // what they make is carried into the scene.
    bool (*own_space)(OwnSpace *own, Error *e);

    // The out-tree, radii and all; NULL when nothing of this kind grows. The error names the
    // object (Recipe.label).
    OutTree *(*grow)(const SceneObject *object, const Recipe *recipe, Error *e);

    // Adds the object's parts to the world: from its out-tree where the kind grows one, else tree
    // is NULL.
    bool (*place)(const Placing *placing, const OutTree *tree, Error *e);

    // Heights of what is land, in the object's own space; NULL = the kind is none.
    HeightField *(*heights)(const SceneObject *object, const OutTree *tree, const Recipe *recipe,
                            Error *e);

    // Adds what there is to measure beyond what every out-tree has; NULL = nothing.
    bool (*measure)(const SceneObject *object, const OutTree *tree, const Recipe *recipe,
                    MeasureList *list, Error *e);

    // Draws what the kind makes as a picture of one value a pixel, 0..1, row by row from the top
    // left (pixel: width * height floats); NULL = it makes no picture.
    bool (*paint)(const SceneObject *object, const OutTree *tree, int width, int height,
                  float *pixel, Error *e);

    // For `ramify info`: prints ", 14 m, ..." after the name of the kind; NULL = nothing to add.
    void (*describe)(const SceneObject *object, char *text, size_t size);

    // Fills a copy of the kind's parameters (of its table's struct) in which what follows from
    // other parameters is no longer 0, as the recipe uses it: for readers. Lists in it are not to
    // be looked at. NULL = nothing follows.
    void (*settle)(const SceneObject *object, void *params);

    // Adds what the object's counts will take in memory; NULL = nothing worth telling beforehand.
    void (*needs)(const SceneObject *object, Needs *needs);

    // Attractors asked for, and copies (leaves, tufts) at most; NULL = none.
    int64_t (*attractors)(const SceneObject *object);
    int64_t (*copies)(const SceneObject *object);
} Kind;

int kind_count(void);
const Kind *kind_at(int index);

// The kind of an object of a checked scene.
const Kind *kind_of(const SceneObject *object);

// Index in the world of the material called name, or of the built-in fallback when name is NULL.
// Names were checked when the scene was read.
int placing_material(const Placing *placing, const char *name, const char *fallback);

// Adds a mesh, drawn once, with the object's `material` (or the built-in fallback). Takes the mesh.
bool placing_add_mesh(const Placing *placing, Mesh *mesh, const char *fallback, Error *e);

#endif
