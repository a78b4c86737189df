#include "scene/build.h"

#include "base/hash.h"
#include "base/memory.h"
#include "base/random.h"
#include "land/height_measure.h"
#include "mesh/geometry_measure.h"
#include "outtree/measure.h"
#include "scene/builtin.h"
#include "scene/kind.h"
#include "scene/place.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// ---- materials and lights ----

static bool names_material(const Scene *scene, const char *name)
{
    for (int i = 0; i < scene->material_count; i++) {
        if (strcmp(scene->materials[i].name, name) == 0) {
            return true;
        }
    }
    return false;
}

// The scene's materials, then the built-in ones that it does not redefine.
static bool add_materials(World *world, const Scene *scene, Error *e)
{
    int builtin_count;
    const Material *builtin = builtin_materials(&builtin_count);
    free(world->material);
    world->material_count = 0;
    world->material =
        memory_alloc((int64_t)scene->material_count + builtin_count, sizeof *world->material, e);
    if (!world->material) {
        return false;
    }
    for (int i = 0; i < scene->material_count; i++) {
        world->material[world->material_count++] = scene->materials[i];
    }
    for (int i = 0; i < builtin_count; i++) {
        if (!names_material(scene, builtin[i].name)) {
            world->material[world->material_count++] = builtin[i];
        }
    }
    return true;
}

static bool add_lights(World *world, const Scene *scene, Error *e)
{
    free(world->light);
    world->light_count = 0;
    world->light = memory_alloc(scene->light_count, sizeof *world->light, e);
    if (!world->light) {
        return false;
    }
    if (scene->light_count > 0) {
        memcpy(world->light, scene->lights, sizeof *world->light * (size_t)scene->light_count);
    }
    world->light_count = scene->light_count;
    return true;
}

// ---- objects ----

// From its name and the scene's seed: an object keeps its form when others come and go.
uint64_t scene_object_seed(const Scene *scene, int index)
{
    const SceneObject *object = &scene->objects[index];
    uint64_t name = hash_bytes(HASH_START, object->name, strlen(object->name));
    return object->seed ? object->seed : random_key(name, scene->seed);
}

enum { LABEL_SIZE = 128 };

static Recipe make_recipe(const Scene *scene, const SceneObject *object, const Run *run,
                          char label[LABEL_SIZE])
{
    snprintf(label, LABEL_SIZE, "object '%s'", object->name);
    return (Recipe){scene_object_seed(scene, (int)(object - scene->objects)), label, scene->grow_to,
                    run, NULL};
}

OutTree *scene_grow_object(const Scene *scene, int index, const Run *run, Error *e)
{
    if (index < 0 || index >= scene->object_count) {
        error_set(e, ERROR_INPUT, "no object %d; the scene has %d, counted from 0", index,
                  scene->object_count);
        return NULL;
    }
    const SceneObject *object = &scene->objects[index];
    const Kind *kind = object->kind;
    if (!kind->grow) {
        error_set(e, ERROR_INPUT, "it does not grow; a %s never does", kind_name(kind));
        scene_fail_object(scene, index, e);
        return NULL;
    }
    char label[LABEL_SIZE];
    Recipe recipe = make_recipe(scene, object, run, label);
    if (!scene_check_memory(scene, index, e)) {
        return NULL;
    }
    OwnSpace own;
    if (!own_space_enter(&own, object, e)) {
        return NULL;
    }
    OutTree *tree = kind->grow(own.object.params, &recipe, e);
    if (tree && !own_space_carry_tree(&own, tree, e)) {
        out_tree_free(tree);
        tree = NULL;
    }
    own_space_leave(&own);
    if (!tree) {
        scene_fail_object(scene, index, e);
    }
    // cppcheck-suppress returnDanglingLifetime ; the tree keeps nothing of the recipe
    return tree;
}

HeightField *scene_heights(const Scene *scene, int index, const OutTree *tree, const Run *run,
                           Error *e)
{
    const SceneObject *object = &scene->objects[index];
    const Kind *kind = object->kind;
    if (!kind->heights) {
        error_set(e, ERROR_INPUT, "it is no land; a terrain would be");
        scene_fail_object(scene, index, e);
        return NULL;
    }
    char label[LABEL_SIZE];
    Recipe recipe = make_recipe(scene, object, run, label);
    if (!scene_check_memory(scene, index, e)) {
        return NULL;
    }
    HeightField *field = kind->heights(object->params, tree, &recipe, e);
    if (!field) {
        scene_fail_object(scene, index, e);
    }
    // cppcheck-suppress returnDanglingLifetime ; neither does the land
    return field;
}

// Measures of the land that a kind with heights makes; others have none.
static bool measure_land(const Scene *scene, int index, const OutTree *tree, const Run *run,
                         MeasureList *list, Error *e)
{
    if (!scene->objects[index].kind->heights) {
        return true;
    }
    char label[LABEL_SIZE];
    Recipe recipe = make_recipe(scene, &scene->objects[index], run, label);
    HeightField *field =
        scene->objects[index].kind->heights(scene->objects[index].params, tree, &recipe, e);
    bool done = field && height_field_measure(field, 0.0, list, e);
    height_field_free(field);
    return done;
}

// What neither grows nor has measures of its own is built and measured by its geometry.
static bool measure_built(const Scene *scene, int index, const Run *run, MeasureList *list,
                          Error *e)
{
    BuildStats stats = {0};
    World *world = world_new(e);
    bool done = world && scene_give_settings(scene, world, e) &&
                scene_place_object(world, scene, index, NULL, run, &stats, e) &&
                geometry_measure(&world->geometry, list, e);
    world_free(world);
    return done;
}

bool scene_measure(const Scene *scene, int index, const Run *run, MeasureList *list, Error *e)
{
    const SceneObject *object = &scene->objects[index];
    const Kind *kind = object->kind;
    if (!kind->grow && !kind->measure) {
        return measure_built(scene, index, run, list, e);
    }
    char label[LABEL_SIZE];
    Recipe recipe = make_recipe(scene, object, run, label);
    OwnSpace own;
    if (!own_space_enter(&own, object, e)) {
        return false;
    }
    OutTree *tree = kind->grow ? kind->grow(own.object.params, &recipe, e) : NULL;
    bool done = (tree || !kind->grow) && (!tree || out_tree_measure(tree, list, e)) &&
                measure_land(scene, index, tree, run, list, e) &&
                (!kind->measure || kind->measure(own.object.params, tree, &recipe, list, e));
    out_tree_free(tree);
    own_space_leave(&own);
    return done || scene_fail_object(scene, index, e);
}

// Grows and meshes the object in its own space, and carries its parts into the scene.
static bool place(const Placing *p, const OwnSpace *own, Error *e)
{
    if (run_is_cancelled(p->recipe.run)) {
        return run_cancel_error(e);
    }
    const Kind *kind = p->object->kind;
    int64_t first = p->world->geometry.count;
    double start = run_seconds();
    OutTree *tree = kind->grow ? kind->grow(p->object->params, &p->recipe, e) : NULL;
    if (kind->grow && !tree) {
        return false;
    }
    double grown = run_seconds();
    bool done = kind->place(p, tree, e);
    done = done && own_space_carry_parts(own, &p->world->geometry, first, e);
    p->stats->nodes += tree ? tree->count : 0;
    p->stats->grow_seconds += grown - start;
    p->stats->mesh_seconds += run_seconds() - grown;
    out_tree_free(tree);
    return done;
}

bool scene_place_object(World *world, const Scene *scene, int index, RecipeMemory *memory,
                        const Run *run, BuildStats *stats, Error *e)
{
    char label[LABEL_SIZE];
    OwnSpace own;
    if (!own_space_enter(&own, &scene->objects[index], e)) {
        return false;
    }
    Placing placing = {.world = world,
                       .scene = scene,
                       .object = &own.object,
                       .index = index,
                       .recipe = make_recipe(scene, &scene->objects[index], run, label),
                       .stats = stats};
    placing.recipe.memory = memory;
    bool done = place(&placing, &own, e);
    own_space_leave(&own);
    return done || scene_fail_object(scene, index, e);
}

bool scene_give_settings(const Scene *scene, World *world, Error *e)
{
    world->camera = scene->camera;
    world->film = scene->film;
    world->render = scene->render;
    world->sky = scene->sky;
    world->medium = scene->medium ? *scene->medium : (Medium){0};
    return add_materials(world, scene, e) && add_lights(world, scene, e);
}

World *scene_build(const Scene *scene, const Run *run, BuildStats *stats, Error *e)
{
    BuildStats own = {0};
    stats = stats ? stats : &own;
    *stats = (BuildStats){0};
    World *world = scene_check_memory(scene, -1, e) ? world_new(e) : NULL;
    if (!world) {
        return NULL;
    }
    bool done = scene_give_settings(scene, world, e);
    for (int i = 0; done && i < scene->object_count; i++) {
        done = scene_place_object(world, scene, i, NULL, run, stats, e);
    }
    if (!done) {
        world_free(world);
        return NULL;
    }
    stats->geometry = geometry_counts(&world->geometry);
    return world;
}
