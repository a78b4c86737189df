// Builds the world of a scene: grows, skins and places every object.
#ifndef RAMIFY_SCENE_BUILD_H
#define RAMIFY_SCENE_BUILD_H

#include "base/measures.h"
#include "land/tiles.h"
#include "mesh/geometry.h"
#include "objects/common/recipe.h"
#include "outtree/out_tree.h"
#include "render/cloud/cloud.h"
#include "scene/scene.h"

typedef struct World World;

// What is made once for several objects of a scene; borrowed.
typedef struct Shared {
    Grown *growths; // whole growths, an entry per object ({0} at first), in which those of an
                    // object and its rivals are found and kept; NULL = contests are the scene's
    struct Surfaces *surfaces; // of obstacles; NULL = the object makes its own
} Shared;

typedef struct BuildStats {
    int64_t nodes;
    double grow_seconds, mesh_seconds;
    GeometryCounts geometry;
} BuildStats;

// The out-tree of object number index alone. ERROR_INPUT when it does not grow or does not exist.
OutTree *scene_grow_object(const Scene *scene, int index, const Run *run, Error *e);

// Heights of object number index from its out-tree, in its own space. ERROR_INPUT when it is not
// land.
HeightField *scene_heights(const Scene *scene, int index, const OutTree *tree, const Run *run,
                           Error *e);

// Tile (column, row) of object number index from the heights of its whole, or a map of the tile;
// map: NULL = heights. ERROR_INPUT when the object has no such tile or no such map.
HeightField *scene_tile(const Scene *scene, int index, const HeightField *world,
                        const HeightMap *map, int column, int row, const Run *run, Error *e);

// Seed of object number index: its own, or one derived from the scene's seed and its name.
uint64_t scene_object_seed(const Scene *scene, int index);

// Measures of object number index: those of its out-tree and its kind. A kind that has neither is
// measured by its geometry.
bool scene_measure(const Scene *scene, int index, const Run *run, MeasureList *list, Error *e);

// The same of all objects for which `wanted` is true (NULL = all). What several stand on is grown
// once for them. list: an entry per object, which the caller clears, also after a failure.
bool scene_measure_objects(const Scene *scene, const bool *wanted, const Run *run,
                           MeasureList *list, Error *e);

// Builds the whole world. It borrows strings from the scene: free the world first.
// stats may be NULL.
World *scene_build(const Scene *scene, const Run *run, BuildStats *stats, Error *e);

// The steps of scene_build. Sets everything but the geometry, replacing what the world had. The
// world borrows strings from the scene.
bool scene_give_settings(const Scene *scene, World *world, Error *e);

// Grows, skins and places object number index and adds to stats.
bool scene_place_object(World *world, const Scene *scene, int index, Shared shared, const Run *run,
                        BuildStats *stats, Error *e);

// Will maps be drawn of the object, should it be a terrain: for layers of materials, for objects on
// it or for fog in its valleys?
bool scene_keeps_land(const Scene *scene, int index);

// Does a cloud show the spray that the object throws up, or its falling water?
bool scene_keeps_spray(const Scene *scene, int index, SprayOf of);

// Places the objects for which `placed` is false (NULL = all) in an order in which obstacles come
// first, then puts the world's parts into the order of the scene's objects. growths: see Shared.
// keep: keep the growths also of objects that do not contend.
bool scene_place_objects(World *world, const Scene *scene, const bool *placed, Grown *growths,
                         bool keep, const Run *run, BuildStats *stats, Error *e);

#endif
