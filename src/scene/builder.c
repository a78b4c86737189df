#include "scene/builder.h"

#include "base/memory.h"
#include "config/compare.h"
#include "render/world.h"
#include "scene/cloud_grounds.h"
#include "scene/masks.h"
#include "scene/needs.h"
#include "scene/place.h"
#include "scene/scene_flood.h"
#include "scene/spec.h"

#include <stdlib.h>
#include <string.h>

struct SceneBuilder {
    World *world;
    bool remember;
    bool built;    // false at first and after a failure
    Scene scene;   // the scene that was built; borrows everything it points to
    Grown *memory; // the whole growth of each object; owned
    int count;     // of objects
};

SceneBuilder *scene_builder_new(bool remember, Error *e)
{
    SceneBuilder *builder = memory_alloc_zero(1, sizeof *builder, e);
    if (builder) {
        builder->remember = remember;
        builder->world = world_new(e);
    }
    if (!builder || !builder->world) {
        free(builder);
        return NULL;
    }
    return builder;
}

static void clear_objects(SceneBuilder *builder)
{
    for (int i = 0; i < builder->count; i++) {
        grown_clear(&builder->memory[i]);
    }
    free(builder->memory);
    builder->memory = NULL;
    builder->count = 0;
}

void scene_builder_free(SceneBuilder *builder)
{
    if (builder) {
        clear_objects(builder);
        world_free(builder->world);
        free(builder);
    }
}

// ---- what can be kept

// Is the object unchanged, including its random numbers?
static bool same_object(const Scene *a, const Scene *b, int index)
{
    return table_equal(&object_table, &a->objects[index], &b->objects[index], NULL) &&
           scene_object_seed(a, index) == scene_object_seed(b, index);
}

// Is its growth unchanged?
static bool same_growth(const Scene *a, const Scene *b, int index)
{
    return table_equal(&object_table, &a->objects[index], &b->objects[index], "deform") &&
           scene_object_seed(a, index) == scene_object_seed(b, index);
}

// Does a kind that depends on the scene see a change in it?
static bool same_surroundings(const Scene *a, const Scene *b)
{
    for (int i = 0; i < a->object_count; i++) {
        if (!same_object(a, b, i)) {
            return false;
        }
    }
    return key_equal(table_find(&scene_table, "materials"), a, b);
}

static bool same_spray(const Scene *a, const Scene *b, int index)
{
    return scene_keeps_spray(a, index, SPRAY_MIST) == scene_keeps_spray(b, index, SPRAY_MIST) &&
           scene_keeps_spray(a, index, SPRAY_WATER) == scene_keeps_spray(b, index, SPRAY_WATER);
}

// Can the object's parts be kept?
static bool object_fits(const SceneBuilder *builder, const Scene *scene, int index, bool alike)
{
    const Scene *old = &builder->scene;
    const Kind *kind = scene->objects[index].kind;
    bool reads_scene = kind->reads_scene || scene_object_has_neighbours(&scene->objects[index]);
    return same_object(old, scene, index) &&
           scene_keeps_land(old, index) == scene_keeps_land(scene, index) &&
           same_spray(old, scene, index) && (alike || !reads_scene) &&
           (!kind->reads_water || scene_flood_hash(old) == scene_flood_hash(scene)) &&
           (!kind->grow || old->grow_to == scene->grow_to);
}

// Can any part be kept? Parts refer to materials by number, and the scene's own come first, so
// these must have the same names.
static bool same_kind_of_scene(const SceneBuilder *builder, const Scene *scene)
{
    const Scene *old = &builder->scene;
    bool same = builder->built && old->object_count == scene->object_count &&
                old->material_count == scene->material_count;
    for (int i = 0; same && i < scene->material_count; i++) {
        same = strcmp(old->materials[i].name, scene->materials[i].name) == 0;
    }
    return same;
}

bool scene_builder_fits(const SceneBuilder *builder, const Scene *scene)
{
    if (!same_kind_of_scene(builder, scene)) {
        return false;
    }
    bool alike = same_surroundings(&builder->scene, scene);
    for (int i = 0; i < scene->object_count; i++) {
        if (!object_fits(builder, scene, i, alike)) {
            return false;
        }
    }
    return true;
}

// ---- building

// Forgets the growths that the new scene changes.
static void forget(SceneBuilder *builder, const Scene *scene, bool alike)
{
    for (int i = 0; builder->built && i < scene->object_count; i++) {
        bool lone = !scene_object_has_neighbours(&scene->objects[i]);
        if (!same_growth(&builder->scene, scene, i) || !(lone || alike)) {
            grown_clear(&builder->memory[i]);
        }
    }
}

// Moves the parts of object index out of `from`, which continues to own the others.
static bool move_parts(Geometry *from, int index, Geometry *to, Error *e)
{
    for (int64_t i = 0; i < from->count; i++) {
        Part part = from->part[i];
        if (part.object == index) {
            from->part[i] = (Part){.object = -1};
            if (!geometry_add(to, part, e)) {
                return false;
            }
        }
    }
    return true;
}

static bool build_objects(SceneBuilder *builder, const Scene *scene, const bool *stays,
                          const Run *run, BuildStats *stats, Error *e)
{
    World *world = builder->world;
    Geometry before = world->geometry, gone = {0};
    world->geometry = (Geometry){0};
    bool done = true;
    for (int i = 0; done && i < scene->object_count; i++) { // make room first
        done = stays[i] || move_parts(&before, i, &gone, e);
    }
    geometry_clear(&gone);
    for (int i = 0; done && i < scene->object_count; i++) {
        done = !stays[i] || move_parts(&before, i, &world->geometry, e);
    }
    geometry_clear(&before);
    return done && scene_place_objects(world, scene, stays, builder->memory, builder->remember, run,
                                       stats, e);
}

static bool begin_anew(SceneBuilder *builder, const Scene *scene, Error *e)
{
    clear_objects(builder);
    geometry_clear(&builder->world->geometry);
    builder->memory = memory_alloc_zero(scene->object_count, sizeof *builder->memory, e);
    builder->count = builder->memory ? scene->object_count : 0;
    builder->built = false;
    return builder->memory;
}

World *scene_builder_build(SceneBuilder *builder, const Scene *scene, const Run *run,
                           BuildStats *stats, Error *e)
{
    if (!scene_check_memory(scene, -1, e)) {
        return NULL;
    }
    bool anew = !same_kind_of_scene(builder, scene);
    bool *stays = memory_alloc_zero(scene->object_count, sizeof *stays, e);
    if (!stays || (anew && !begin_anew(builder, scene, e))) {
        free(stays);
        return NULL;
    }
    bool alike = !anew && same_surroundings(&builder->scene, scene), all = true;
    for (int i = 0; i < scene->object_count; i++) {
        stays[i] = !anew && object_fits(builder, scene, i, alike);
        all = all && stays[i];
    }
    forget(builder, scene, alike);
    bool masked = all && key_equal(table_find(&scene_table, "materials"), &builder->scene, scene);
    bool done =
        scene_give_settings(scene, builder->world, e) &&
        (all || build_objects(builder, scene, stays, run, stats, e)) &&
        (scene_ground_clouds(builder->world, scene, run, e) || scene_fail_at(scene, "", e)) &&
        (masked || scene_make_masks(builder->world, scene, run, e) || scene_fail_at(scene, "", e));
    free(stays);
    builder->scene = *scene;
    builder->built = done;
    stats->geometry = geometry_counts(&builder->world->geometry);
    return done ? builder->world : NULL;
}
