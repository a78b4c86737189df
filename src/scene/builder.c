#include "scene/builder.h"

#include "base/memory.h"
#include "scene/kind.h"
#include "scene/scene_flood.h"
#include "scene/sections.h"

#include <stdlib.h>
#include <string.h>

// What an object's parts were made from.
typedef struct Built {
    char *text; // its entry in Scene.resolved; owned
    uint64_t seed;
    float grow_to;
    uint64_t flood; // hash of the scene's water
    RecipeMemory memory;
} Built;

struct SceneBuilder {
    World *world;
    bool remember;
    Built *object;
    int count;
    char *materials;    // section of Scene.resolved; owned, NULL before the first scene
    int material_count; // of that scene
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
        free(builder->object[i].text);
        recipe_memory_clear(&builder->object[i].memory);
    }
    free(builder->object);
    free(builder->materials);
    builder->object = NULL;
    builder->materials = NULL;
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

static TextPart part_of(const char *text)
{
    return (TextPart){text, (int64_t)strlen(text)};
}

static char *copy_part(TextPart part, Error *e)
{
    char *copy = memory_alloc_zero(part.length + 1, 1, e);
    if (copy && part.length > 0) {
        memcpy(copy, part.text, (size_t)part.length);
    }
    return copy;
}

// ---- what fits

// Parts name their materials by number: the scene's own come first, so those must be the same.
static bool same_materials(const SceneBuilder *builder, const Scene *scene)
{
    const World *world = builder->world;
    bool same = builder->material_count == scene->material_count;
    for (int i = 0; same && i < scene->material_count; i++) {
        same = strcmp(world->material[i].name, scene->materials[i].name) == 0;
    }
    return same;
}

static bool same_text(const SceneBuilder *builder, TextPart objects, int index)
{
    return section_same(section_entry(objects, index), part_of(builder->object[index].text));
}

// Does the object see anything of the scene change?
static bool same_surroundings(const SceneBuilder *builder, const Scene *scene)
{
    TextPart objects = section_find(scene->resolved, "objects");
    for (int i = 0; i < builder->count; i++) {
        if (!same_text(builder, objects, i)) {
            return false;
        }
    }
    return section_same(section_find(scene->resolved, "materials"), part_of(builder->materials));
}

static bool same_growth(const SceneBuilder *builder, const Scene *scene, int index)
{
    TextPart objects = section_find(scene->resolved, "objects");
    return same_text(builder, objects, index) &&
           scene_object_seed(scene, index) == builder->object[index].seed;
}

// Do the object's parts stay as they are?
static bool object_fits(const SceneBuilder *builder, const Scene *scene, int index, bool alike)
{
    const Kind *kind = scene->objects[index].kind;
    return same_growth(builder, scene, index) && (alike || !kind->reads_scene) &&
           (!kind->reads_water || builder->object[index].flood == scene_flood_hash(scene)) &&
           (!kind->grow || builder->object[index].grow_to == scene->grow_to);
}

// Can anything stay?
static bool same_kind_of_scene(const SceneBuilder *builder, const Scene *scene)
{
    return builder->materials && builder->count == scene->object_count &&
           same_materials(builder, scene);
}

bool scene_builder_fits(const SceneBuilder *builder, const Scene *scene)
{
    if (!same_kind_of_scene(builder, scene)) {
        return false;
    }
    bool alike = same_surroundings(builder, scene);
    for (int i = 0; i < scene->object_count; i++) {
        if (!object_fits(builder, scene, i, alike)) {
            return false;
        }
    }
    return true;
}

// ---- building

// Writes down what an object is made from.
static bool note_object(SceneBuilder *builder, const Scene *scene, int index, Error *e)
{
    Built *built = &builder->object[index];
    char *text = copy_part(section_entry(section_find(scene->resolved, "objects"), index), e);
    if (!text) {
        return false;
    }
    free(built->text);
    built->text = text;
    built->seed = scene_object_seed(scene, index);
    built->grow_to = scene->grow_to;
    built->flood = scene_flood_hash(scene);
    return true;
}

static bool place_object(SceneBuilder *builder, const Scene *scene, int index, const Run *run,
                         BuildStats *stats, Error *e)
{
    Built *built = &builder->object[index];
    if (built->text && !same_growth(builder, scene, index)) {
        recipe_memory_clear(&built->memory);
    }
    return scene_place_object(builder->world, scene, index,
                              builder->remember ? &built->memory : NULL, run, stats, e);
}

// Moves the parts of object index out of `from`, which stays the owner of the others.
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
        done = (stays[i] ? move_parts(&before, i, &world->geometry, e)
                         : place_object(builder, scene, i, run, stats, e)) &&
               note_object(builder, scene, i, e);
    }
    geometry_clear(&before);
    return done;
}

static bool begin_anew(SceneBuilder *builder, const Scene *scene, Error *e)
{
    clear_objects(builder);
    geometry_clear(&builder->world->geometry);
    builder->object = memory_alloc_zero(scene->object_count, sizeof *builder->object, e);
    builder->count = builder->object ? scene->object_count : 0;
    return builder->object;
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
    bool alike = !anew && same_surroundings(builder, scene), all = true;
    for (int i = 0; i < scene->object_count; i++) {
        stays[i] = !anew && object_fits(builder, scene, i, alike);
        all = all && stays[i];
    }
    bool done = scene_give_settings(scene, builder->world, e) &&
                (all || build_objects(builder, scene, stays, run, stats, e));
    free(stays);
    if (done) {
        free(builder->materials);
        builder->materials = copy_part(section_find(scene->resolved, "materials"), e);
        builder->material_count = scene->material_count;
        done = builder->materials;
    }
    stats->geometry = geometry_counts(&builder->world->geometry);
    return done ? builder->world : NULL;
}
