#include "scene/build.h"

#include "base/memory.h"
#include "base/random.h"
#include "scene/builtin.h"
#include "shape/import.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// ---- materials ----

static int find_material(const World *world, const char *name)
{
    for (int i = 0; i < world->material_count; i++) {
        if (strcmp(world->material[i].name, name) == 0) {
            return i;
        }
    }
    return -1;
}

// The scene's materials, then the built-in ones that it does not redefine.
static bool add_materials(World *world, const Scene *scene, Error *e)
{
    int builtin_count;
    const Material *builtin = builtin_materials(&builtin_count);
    world->material =
        memory_alloc((int64_t)scene->material_count + builtin_count, sizeof *world->material, e);
    if (!world->material) {
        return false;
    }
    for (int i = 0; i < scene->material_count; i++) {
        world->material[world->material_count++] = scene->materials[i];
    }
    for (int i = 0; i < builtin_count; i++) {
        if (find_material(world, builtin[i].name) < 0) {
            world->material[world->material_count++] = builtin[i];
        }
    }
    return true;
}

// Names were checked when the scene was read, and every default is built in.
static int material_index(const World *world, const char *name, const char *fallback)
{
    int index = find_material(world, name ? name : fallback);
    return index >= 0 ? index : 0;
}

static bool add_lights(World *world, const Scene *scene, Error *e)
{
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

// FNV-1a, then mixed with the scene's seed: an object keeps its form when others come and go.
static uint64_t object_seed(const Scene *scene, const SceneObject *object)
{
    uint64_t hash = 0xcbf29ce484222325ull;
    for (const char *c = object->name; *c; c++) {
        hash = (hash ^ (unsigned char)*c) * 0x100000001b3ull;
    }
    return object->seed ? object->seed : random_key(hash, scene->seed);
}

static OutTree *grow_object(const Scene *scene, const SceneObject *object, const Run *run, Error *e)
{
    char label[128];
    snprintf(label, sizeof label, "object '%s'", object->name);
    return tree_grow(object->tree, object_seed(scene, object), label, run, e);
}

OutTree *scene_grow_object(const Scene *scene, int index, const Run *run, Error *e)
{
    if (index < 0 || index >= scene->object_count) {
        error_set(e, ERROR_INPUT, "no object %d; the scene has %d, counted from 0", index,
                  scene->object_count);
        return NULL;
    }
    const SceneObject *object = &scene->objects[index];
    if (!object->tree) {
        error_set(e, ERROR_INPUT, "object '%s' does not grow; name one that is a tree",
                  object->name);
        return NULL;
    }
    return grow_object(scene, object, run, e);
}

OutTree **scene_grow(const Scene *scene, const Run *run, Error *e)
{
    OutTree **trees = memory_alloc_zero(scene->object_count, sizeof(OutTree *), e);
    bool done = trees;
    for (int i = 0; done && i < scene->object_count; i++) {
        if (scene->objects[i].tree) {
            trees[i] = grow_object(scene, &scene->objects[i], run, e);
            done = trees[i];
        }
    }
    if (done) {
        return trees;
    }
    for (int i = 0; trees && i < scene->object_count; i++) {
        out_tree_free(trees[i]);
    }
    free(trees);
    return NULL;
}

// One object on its way into the world.
typedef struct Placing {
    World *world;
    const Scene *scene;
    const SceneObject *object;
    int index;
    const Run *run;
    BuildStats *stats;
} Placing;

static bool add_tree(const Placing *p, Error *e)
{
    double start = run_seconds();
    OutTree *tree = grow_object(p->scene, p->object, p->run, e);
    if (!tree) {
        return false;
    }
    double grown = run_seconds();
    TreeMaterials materials = {.bark = material_index(p->world, p->object->material, "bark"),
                               .twig = material_index(p->world, p->object->twig_material, "twig"),
                               .leaf = material_index(p->world, p->object->leaf_material, "leaf")};
    bool done = tree_geometry(tree, p->object->tree, &materials, p->index,
                              object_seed(p->scene, p->object), &p->world->geometry, p->run, e);
    p->stats->nodes += tree->count;
    p->stats->grow_seconds += grown - start;
    p->stats->mesh_seconds += run_seconds() - grown;
    out_tree_free(tree);
    return done;
}

static bool add_ground(const Placing *p, Error *e)
{
    GroundMaterials materials = {
        .ground = material_index(p->world, p->object->material, "ground"),
        .grass = material_index(p->world, p->object->grass_material, "grass"),
        .fallen = material_index(p->world, p->object->leaf_material, "fallen"),
        .bark = material_index(p->world, NULL, "bark"),
        .foliage = material_index(p->world, NULL, "leaf")};
    return ground_geometry(p->object->ground, &materials, p->index,
                           object_seed(p->scene, p->object), &p->world->geometry, p->run, e);
}

static bool add_part(const Placing *p, Mesh *mesh, Error *e)
{
    Part part = {.kind = PART_MESH,
                 .mesh = mesh,
                 .material = material_index(p->world, p->object->material, "clay"),
                 .object = p->index};
    return geometry_add(&p->world->geometry, part, e);
}

static bool add_mesh(const Placing *p, Error *e)
{
    const SceneMesh *params = p->object->mesh;
    Mesh *mesh = mesh_import(params->file, e);
    if (!mesh) {
        return false;
    }
    if (!mesh_transform(mesh, &params->transform, e) ||
        (params->smooth && !mesh->normal && !mesh_compute_normals(mesh, e))) {
        mesh_free(mesh);
        return false;
    }
    return add_part(p, mesh, e);
}

static Mesh *copy_mesh(const Mesh *mesh, Error *e)
{
    int arrays = (mesh->normal ? MESH_NORMAL : 0) | (mesh->uv ? MESH_UV : 0);
    Mesh *copy = mesh_new(mesh->face_size, mesh->vertex_count, mesh->face_count, arrays, e);
    if (!copy) {
        return NULL;
    }
    size_t vertices = (size_t)mesh->vertex_count;
    size_t corners = (size_t)mesh->face_count * (size_t)mesh->face_size;
    memcpy(copy->index, mesh->index, sizeof *mesh->index * corners);
    memcpy(copy->position, mesh->position, sizeof *mesh->position * vertices);
    if (mesh->normal) {
        memcpy(copy->normal, mesh->normal, sizeof *mesh->normal * vertices);
    }
    if (mesh->uv) {
        memcpy(copy->uv, mesh->uv, sizeof *mesh->uv * vertices);
    }
    return copy;
}

static bool add_shape(const Placing *p, Error *e)
{
    const SceneShape *shape = p->object->shape;
    EnvelopeParams params = {shape->shapes, shape->shape_count, shape->voxel};
    Envelope *envelope = envelope_new(&params, p->run, e);
    if (!envelope) {
        return false;
    }
    Mesh *mesh = copy_mesh(envelope_surface(envelope), e);
    envelope_free(envelope);
    return mesh && add_part(p, mesh, e);
}

static bool add_object(const Placing *p, Error *e)
{
    if (run_is_cancelled(p->run)) {
        return run_cancel_error(e);
    }
    if (p->object->tree) {
        return add_tree(p, e);
    }
    double start = run_seconds();
    bool done =
        p->object->ground ? add_ground(p, e) : (p->object->mesh ? add_mesh(p, e) : add_shape(p, e));
    p->stats->mesh_seconds += run_seconds() - start;
    if (!done && e && e->code != ERROR_CANCELLED) {
        error_prefix(e, "object '%s': ", p->object->name); // trees name themselves
    }
    return done;
}

World *scene_build(const Scene *scene, const Run *run, BuildStats *stats, Error *e)
{
    BuildStats own = {0};
    stats = stats ? stats : &own;
    *stats = (BuildStats){0};
    World *world = world_new(e);
    if (!world) {
        return NULL;
    }
    world->camera = scene->camera;
    world->film = scene->film;
    world->render = scene->render;
    world->sky = scene->sky;
    bool done = add_materials(world, scene, e) && add_lights(world, scene, e);
    for (int i = 0; done && i < scene->object_count; i++) {
        Placing placing = {world, scene, &scene->objects[i], i, run, stats};
        done = add_object(&placing, e);
    }
    if (!done) {
        world_free(world);
        return NULL;
    }
    stats->geometry = geometry_counts(&world->geometry);
    return world;
}
