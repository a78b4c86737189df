// From the scene to a world: grows, skins and places every object.
#ifndef RAMIFY_SCENE_BUILD_H
#define RAMIFY_SCENE_BUILD_H

#include "base/measures.h"
#include "land/height_field.h"
#include "mesh/geometry.h"
#include "objects/common/recipe.h"
#include "outtree/out_tree.h"
#include "scene/scene.h"

typedef struct World World;

typedef struct BuildStats {
    int64_t nodes;
    double grow_seconds, mesh_seconds;
    GeometryCounts geometry;
} BuildStats;

// The out-tree of object number index alone. ERROR_INPUT when it does not grow or does not exist.
OutTree *scene_grow_object(const Scene *scene, int index, const Run *run, Error *e);

// Heights of object number index from its out-tree, in its own space. ERROR_INPUT when it is no
// land.
HeightField *scene_heights(const Scene *scene, int index, const OutTree *tree, const Run *run,
                           Error *e);

// The seed of object number index: its own, or one made from the scene's and its name.
uint64_t scene_object_seed(const Scene *scene, int index);

// Measures of object number index: of its out-tree, and its kind's own. Of its geometry
// where a kind neither grows nor has measures of its own.
bool scene_measure(const Scene *scene, int index, const Run *run, MeasureList *list, Error *e);

// Everything. The world borrows strings from the scene: free the world first.
// stats may be NULL.
World *scene_build(const Scene *scene, const Run *run, BuildStats *stats, Error *e);

// The steps of scene_build. Everything but geometry, in place of what the world had; the world
// borrows strings from the scene.
bool scene_give_settings(const Scene *scene, World *world, Error *e);

// Grows, skins and places object number index and adds to stats. memory: see kind_grow; may be
// NULL.
bool scene_place_object(World *world, const Scene *scene, int index, Grown *memory, const Run *run,
                        BuildStats *stats, Error *e);

#endif
