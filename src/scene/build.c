#include "scene/build.h"

#include "base/hash.h"
#include "base/memory.h"
#include "base/random.h"
#include "land/height_measure.h"
#include "mesh/geometry_measure.h"
#include "outtree/measure.h"
#include "render/world.h"
#include "scene/builtin.h"
#include "scene/carry.h"
#include "scene/cloud_grounds.h"
#include "scene/making.h"
#include "scene/masks.h"
#include "scene/needs.h"
#include "scene/place.h"
#include "scene/scene_flood.h"
#include "scene/surfaces.h"

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
    int builtin_count = 0;
    while (builtin_material_at(builtin_count)) {
        builtin_count++;
    }
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
        const Material *builtin = builtin_material_at(i);
        if (!names_material(scene, builtin->name)) {
            world->material[world->material_count++] = *builtin;
        }
    }
    return true;
}

// A copy of a list of the scene, which replaces that of the world. False when out of memory.
static bool copy_list(void **to, int *to_count, const void *from, int count, size_t size, Error *e)
{
    free(*to);
    *to_count = 0;
    *to = memory_alloc(count, size, e);
    if (!*to) {
        return false;
    }
    if (count > 0) {
        memcpy(*to, from, size * (size_t)count);
    }
    *to_count = count;
    return true;
}

static bool add_lights(World *world, const Scene *scene, Error *e)
{
    void *list = world->light;
    bool done = copy_list(&list, &world->light_count, scene->lights, scene->light_count,
                          sizeof *world->light, e);
    world->light = list;
    return done;
}

static bool add_clouds(World *world, const Scene *scene, Error *e)
{
    cloud_grounds_free(world->cloud, world->cloud_count);
    void *list = world->cloud;
    bool done = copy_list(&list, &world->cloud_count, scene->clouds, scene->cloud_count,
                          sizeof *world->cloud, e);
    world->cloud = list;
    world->cloud_seed = scene->seed;
    return done;
}

static bool add_showers(World *world, const Scene *scene, Error *e)
{
    void *list = world->shower;
    bool done = copy_list(&list, &world->shower_count, scene->showers, scene->shower_count,
                          sizeof *world->shower, e);
    world->shower = list;
    return done;
}

// ---- objects ----

// Derived from its name and the scene's seed, so that it does not depend on other objects.
uint64_t scene_object_seed(const Scene *scene, int index)
{
    const SceneObject *object = &scene->objects[index];
    uint64_t name = hash_bytes(HASH_START, object->name, strlen(object->name));
    uint64_t own = object->kind->seed ? object->kind->seed(object->params) : 0;
    own = own ? own : object->seed;
    return own ? own : random_key(name, scene->seed);
}

OutTree *scene_grow_object(const Scene *scene, int index, const Run *run, Error *e)
{
    if (index < 0 || index >= scene->object_count) {
        error_set(e, ERROR_INPUT, "no object %d; the scene has %d, counted from 0", index,
                  scene->object_count);
        return NULL;
    }
    const Kind *kind = scene->objects[index].kind;
    if (!kind->grow) {
        error_set(e, ERROR_INPUT, "it does not grow; objects of kind %s have no growth",
                  kind_name(kind));
        scene_fail_object(scene, index, e);
        return NULL;
    }
    if (!scene_check_memory(scene, index, e)) {
        return NULL;
    }
    Making m;
    OutTree *tree = NULL;
    bool done = making_begin(&m, scene, index, run, e) && making_grow(&m, (Shared){0}, e) &&
                own_space_carry_tree(&m.own, m.grown.tree, e);
    if (done) {
        tree = m.grown.tree;
        m.grown.tree = NULL;
    }
    making_end(&m, done, e);
    return tree;
}

HeightField *scene_heights(const Scene *scene, int index, const OutTree *tree, const Run *run,
                           Error *e)
{
    const Kind *kind = scene->objects[index].kind;
    if (!kind->heights) {
        error_set(e, ERROR_INPUT, "it is not land; only a terrain has heights");
        scene_fail_object(scene, index, e);
        return NULL;
    }
    if (!scene_check_memory(scene, index, e)) {
        return NULL;
    }
    Making m;
    HeightField *field = NULL;
    if (making_begin(&m, scene, index, run, e)) {
        m.grown.tree = out_tree_copy(tree, e);
        field = m.grown.tree && kind->finish(m.params, &m.recipe, NULL, &m.grown, e)
                    ? kind->heights(m.params, &m.grown, run, e)
                    : NULL;
    }
    making_end(&m, field, e);
    return field;
}

HeightField *scene_tile(const Scene *scene, int index, const HeightField *world,
                        const HeightMap *map, int column, int row, const Run *run, Error *e)
{
    const SceneObject *object = &scene->objects[index];
    TileGrid grid;
    HeightField *tile = NULL;
    if (!object->kind->tiles || !object->kind->tiles(object->params, &grid)) {
        error_set(e, ERROR_INPUT, "it is not cut into tiles; a terrain with the key tiles is");
    } else {
        grid.seed = scene_object_seed(scene, index);
        tile = map ? tile_map(world, &grid, column, row, map, run, e)
                   : tile_land(world, &grid, column, row, run, e);
    }
    if (!tile) {
        scene_fail_object(scene, index, e);
    }
    return tile;
}

// Measures of the land; only kinds with heights have them.
static bool measure_land(const Making *m, MeasureList *list, Error *e)
{
    if (!m->kind->heights) {
        return true;
    }
    HeightField *field = m->kind->heights(m->params, &m->grown, m->recipe.run, e);
    bool done = field && height_field_measure(field, 0.0, list, e);
    height_field_free(field);
    return done;
}

// A kind that neither grows nor has its own measures is built and measured by its geometry.
static bool measure_built(const Scene *scene, int index, Shared shared, const Run *run,
                          MeasureList *list, Error *e)
{
    BuildStats stats = {0};
    World *world = world_new(e);
    bool done = world && scene_give_settings(scene, world, e) &&
                scene_place_object(world, scene, index, shared, run, &stats, e) &&
                geometry_measure(&world->geometry, list, e);
    world_free(world);
    return done;
}

static bool measure_object(const Scene *scene, int index, Shared shared, const Run *run,
                           MeasureList *list, Error *e)
{
    const Kind *kind = scene->objects[index].kind;
    if (!kind->grow && !kind->measure) {
        return measure_built(scene, index, shared, run, list, e);
    }
    Making m;
    bool done = making_begin(&m, scene, index, run, e) && making_grow(&m, shared, e) &&
                (!m.grown.tree || out_tree_measure(m.grown.tree, list, e)) &&
                measure_land(&m, list, e) &&
                (!kind->measure || kind->measure(m.params, &m.grown, &m.recipe, list, e));
    return making_end(&m, done, e);
}

bool scene_measure(const Scene *scene, int index, const Run *run, MeasureList *list, Error *e)
{
    return measure_object(scene, index, (Shared){0}, run, list, e);
}

bool scene_measure_objects(const Scene *scene, const bool *wanted, const Run *run,
                           MeasureList *list, Error *e)
{
    Surfaces *surfaces = surfaces_new(scene, NULL, e);
    bool done = surfaces;
    for (int i = 0; done && i < scene->object_count; i++) {
        done = (wanted && !wanted[i]) ||
               measure_object(scene, i, (Shared){.surfaces = surfaces}, run, &list[i], e);
    }
    surfaces_free(surfaces);
    return done;
}

static int find_material(const World *world, const char *name)
{
    for (int i = 0; name && i < world->material_count; i++) {
        if (strcmp(world->material[i].name, name) == 0) {
            return i;
        }
    }
    return -1;
}

// Materials by role. Their names were checked when the scene was read.
static void find_materials(const World *world, const Making *m, int material[OBJECT_MOST_MATERIALS])
{
    for (int i = 0; i < OBJECT_MOST_MATERIALS; i++) {
        const char *name = m->scene->objects[m->index].material[i];
        int found = find_material(world, name ? name : kind_material(m->kind, m->params, i));
        material[i] = found >= 0 ? found : material[0];
    }
}

// Materials that the parameters name: *material is NULL if there are none. The caller frees it.
static bool find_further(const World *world, const Making *m, int **material, Error *e)
{
    int count = 0;
    *material = NULL;
    while (m->kind->further_material && m->kind->further_material(m->params, count)) {
        count++;
    }
    if (count == 0) {
        return true;
    }
    *material = memory_alloc(count, sizeof **material, e);
    for (int i = 0; *material && i < count; i++) {
        int found = find_material(world, m->kind->further_material(m->params, i));
        (*material)[i] = found >= 0 ? found : 0;
    }
    return *material;
}

typedef struct GroundObject {
    const Kind *kind;
    const void *params;
    uint64_t seed;
    const OwnSpace *own; // of the object that stands on it
} GroundObject;

// Height of the land, in the own space of the object that stands on it.
static float ground_height_of(const void *user, float x, float z)
{
    const GroundObject *ground = user;
    Vec3 p = vec3(x, 0, z);
    if (ground->own->moved) {
        p = transform_point(&ground->own->to_scene, p);
    }
    return ground->kind->ground(ground->params, ground->seed, p.x, p.z) - p.y;
}

// The first ground of the scene; without one level land at the object's own place. own: of the
// object on it.
static Land find_land(const Scene *scene, const OwnSpace *own, GroundObject *ground)
{
    scene = scene->whole ? scene->whole : scene;
    for (int i = 0; i < scene->object_count; i++) {
        const SceneObject *object = &scene->objects[i];
        if (object->kind->ground) {
            *ground =
                (GroundObject){object->kind, object->params, scene_object_seed(scene, i), own};
            return (Land){ground_height_of, ground};
        }
    }
    return (Land){0};
}

// Is there a cloud of the kind over the object of that name? of: what of spray it shows.
static bool has_cloud_over(const Scene *scene, const char *name, CloudKind kind, SprayOf of)
{
    for (int i = 0; i < scene->cloud_count; i++) {
        const Cloud *cloud = &scene->clouds[i];
        bool over = cloud->over && strcmp(cloud->over, name) == 0;
        if (over && cloud->kind == kind && cloud->of == of) {
            return true;
        }
    }
    return false;
}

bool scene_keeps_spray(const Scene *scene, int index, SprayOf of)
{
    const char *name = scene->objects[index].name;
    return has_cloud_over(scene->whole ? scene->whole : scene, name, CLOUD_SPRAY, of);
}

bool scene_keeps_land(const Scene *scene, int index)
{
    const char *name = scene->objects[index].name;
    scene = scene->whole ? scene->whole : scene;
    for (int i = 0; i < scene->material_count; i++) {
        if (scene->materials[i].layer_count > 0) {
            return true;
        }
    }
    if (has_cloud_over(scene, name, CLOUD_FOG, SPRAY_MIST)) {
        return true;
    }
    for (int i = 0; i < scene->object_count; i++) {
        const char *over = scene_object_over(&scene->objects[i]);
        if (over && strcmp(over, name) == 0) {
            return true;
        }
    }
    return false;
}

static bool add_geometry(World *world, const Making *m, Error *e)
{
    int material[OBJECT_MOST_MATERIALS] = {0};
    find_materials(world, m, material);
    GroundObject ground;
    SceneFlood water = {0};
    int *further = NULL;
    if (!find_further(world, m, &further, e) ||
        (m->kind->reads_water && !scene_flood_init(&water, m->scene, m->recipe.run, e))) {
        free(further);
        return false;
    }
    Placing placing = {.recipe = &m->recipe,
                       .geometry = &world->geometry,
                       .material = material,
                       .further = further,
                       .object = m->index,
                       .keep_land = scene_keeps_land(m->scene, m->index),
                       .keep_spray = scene_keeps_spray(m->scene, m->index, SPRAY_MIST),
                       .keep_water = scene_keeps_spray(m->scene, m->index, SPRAY_WATER),
                       .around = {.eye = &world->camera.position,
                                  .material = world->material,
                                  .flood = m->kind->reads_water ? &water.flood : NULL,
                                  .land = find_land(m->scene, &m->own, &ground)}};
    bool done = m->kind->geometry(m->params, &m->grown, &placing, e);
    scene_flood_clear(&water);
    free(further);
    return done;
}

// Grows and meshes the object in its own space, and carries its parts into the scene.
static bool place(World *world, Making *m, Shared shared, BuildStats *stats, Error *e)
{
    if (run_is_cancelled(m->recipe.run)) {
        return run_cancel_error(e);
    }
    int64_t first = world->geometry.count;
    double start = run_seconds();
    if (!making_grow(m, shared, e)) {
        return false;
    }
    double grown = run_seconds();
    bool done = add_geometry(world, m, e) &&
                own_space_carry_parts(&m->own, &world->geometry, first, e) &&
                (!m->deformation || m->kind->grow ||
                 carry_parts(m->deformation, &world->geometry, first, m->recipe.run, e));
    stats->nodes += m->grown.tree ? m->grown.tree->count : 0;
    stats->grow_seconds += grown - start;
    stats->mesh_seconds += run_seconds() - grown;
    return done;
}

bool scene_place_object(World *world, const Scene *scene, int index, Shared shared, const Run *run,
                        BuildStats *stats, Error *e)
{
    Making m;
    bool done = making_begin(&m, scene, index, run, e) && place(world, &m, shared, stats, e);
    return making_end(&m, done, e);
}

bool scene_give_settings(const Scene *scene, World *world, Error *e)
{
    world->camera = scene->camera;
    world->film = scene->film;
    world->render = scene->render;
    world->sky = scene->sky;
    world->medium = scene->medium ? *scene->medium : (Medium){0};
    return add_materials(world, scene, e) && add_lights(world, scene, e) &&
           add_clouds(world, scene, e) && add_showers(world, scene, e);
}

bool scene_place_objects(World *world, const Scene *scene, const bool *placed, Grown *growths,
                         bool keep, const Run *run, BuildStats *stats, Error *e)
{
    Surfaces *surfaces = surfaces_new(scene, &world->geometry, e);
    int *order = memory_alloc(scene->object_count, sizeof *order, e);
    bool done = surfaces && order && surfaces_order(scene, order, e);
    for (int i = 0; done && i < scene->object_count; i++) {
        int index = order[i];
        bool kept = keep || scene->objects[index].contest;
        Shared shared = {.growths = kept ? growths : NULL, .surfaces = surfaces};
        done = (placed && placed[index]) ||
               scene_place_object(world, scene, index, shared, run, stats, e);
    }
    surfaces_free(surfaces);
    free(order);
    return done && geometry_order(&world->geometry, scene->object_count, e);
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
    bool done =
        scene_give_settings(scene, world, e) &&
        scene_place_objects(world, scene, NULL, NULL, false, run, stats, e) &&
        ((scene_ground_clouds(world, scene, run, e) && scene_make_masks(world, scene, run, e)) ||
         scene_fail_at(scene, "", e));
    if (!done) {
        world_free(world);
        return NULL;
    }
    stats->geometry = geometry_counts(&world->geometry);
    return world;
}
