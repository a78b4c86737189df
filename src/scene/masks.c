#include "scene/masks.h"

#include "base/memory.h"
#include "land/height_raster.h"
#include "land/where.h"
#include "objects/kind.h"

#include <stdlib.h>

typedef struct Maker {
    World *world;
    const Scene *scene;
    const Run *run;
} Maker;

static const Material *material_of(const World *world, const Part *part)
{
    return &world->material[part->material];
}

// Do both parts show one surface, so that the masks of one are the other's?
static bool share_masks(const World *world, const Part *a, const Part *b)
{
    bool whole = !a->instance && !b->instance;
    for (int64_t i = 0; !whole && i < world->geometry.count; i++) {
        const Part *part = &world->geometry.part[i];
        whole = part->object == a->object && part->land;
    }
    return a->object == b->object && a->material == b->material && whole;
}

// The number of an earlier part whose masks are this one's; -1 = there is none.
static int64_t find_alike(const World *world, int64_t number)
{
    const Part *part = &world->geometry.part[number];
    for (int64_t i = 0; i < number; i++) {
        if (world->masks.of_part[i] >= 0 && share_masks(world, part, &world->geometry.part[i])) {
            return i;
        }
    }
    return -1;
}

// ---- the surface from above

static const HeightField *find_land(const Geometry *geometry, int object)
{
    for (int64_t i = 0; i < geometry->count; i++) {
        if (geometry->part[i].object == object && geometry->part[i].land) {
            return geometry->part[i].land;
        }
    }
    return NULL;
}

// Of an instanced part its mesh, of another all of its object's meshes that are drawn once.
static HeightField *look_from_above(const Geometry *geometry, const Part *part, Error *e)
{
    if (part->instance) {
        return height_field_of_mesh(part->mesh, HEIGHT_MAP_SIDE, e);
    }
    Geometry own = {.part = memory_alloc(geometry->count, sizeof(Part), e)};
    for (int64_t i = 0; own.part && i < geometry->count; i++) {
        if (geometry->part[i].object == part->object) {
            own.part[own.count++] = geometry->part[i];
        }
    }
    Mesh *mesh = own.part ? geometry_surface(&own, e) : NULL;
    HeightField *field = mesh ? height_field_of_mesh(mesh, HEIGHT_MAP_SIDE, e) : NULL;
    mesh_free(mesh);
    free(own.part);
    return field;
}

// ---- masks

static bool draw_mask(Mask *mask, const MaterialLayer *layer, const HeightField *land,
                      const Run *run, Error *e)
{
    int64_t count = height_field_count(land);
    *mask = (Mask){land->columns, land->rows, land->cell, land->origin,
                   memory_alloc(count, sizeof *mask->share, e)};
    Where where = {0};
    bool done = mask->share && where_init(&where, layer->where, layer->where_count, land, run, e);
    for (int64_t i = 0; done && i < count; i++) {
        mask->share[i] = (uint8_t)(255.0f * where_share_of(&where, i) + 0.5f);
    }
    where_free(&where);
    return done;
}

static bool add_masks(const Maker *m, const Part *part, const HeightField *land, Error *e)
{
    const Material *material = material_of(m->world, part);
    MaskSet *masks = &m->world->masks;
    if (!memory_reserve(&masks->mask, &masks->capacity, masks->count + material->layer_count,
                        sizeof *masks->mask, e)) {
        return false;
    }
    for (int i = 0; i < material->layer_count; i++) {
        run_progress(m->run, "layers", (double)i / material->layer_count);
        Mask *mask = &masks->mask[masks->count++];
        if (!draw_mask(mask, &material->layers[i], land, m->run, e)) {
            error_prefix(e, "layer %d of material '%s' on object '%s': ", i + 1, material->name,
                         m->scene->objects[part->object].name);
            return error_key(e, "materials.%s.layers.%d", material->name, i);
        }
    }
    return true;
}

static bool make_masks(const Maker *m, int64_t number, Error *e)
{
    const Geometry *geometry = &m->world->geometry;
    const Part *part = &geometry->part[number];
    MaskSet *masks = &m->world->masks;
    if (material_of(m->world, part)->layer_count == 0 || !part->mesh) {
        return true;
    }
    int64_t alike = find_alike(m->world, number);
    if (alike >= 0) {
        masks->of_part[number] = masks->of_part[alike];
        return true;
    }
    const HeightField *land = find_land(geometry, part->object);
    HeightField *own = land ? NULL : look_from_above(geometry, part, e);
    int32_t first = (int32_t)masks->count;
    bool done = (land || own) && add_masks(m, part, land ? land : own, e);
    masks->of_part[number] = done ? first : -1;
    height_field_free(own);
    return done;
}

// ---- what they take

// The layers of the object's materials; those that its kind names for parameters alone count too.
static int count_layers(const Scene *scene, const SceneObject *object)
{
    int count = 0;
    for (int role = 0; role < OBJECT_MOST_MATERIALS; role++) {
        const char *own = kind_material(object->kind, object->params, role);
        const char *name = object->material[role] ? object->material[role] : own;
        const Material *material = name ? scene_material(scene, name) : NULL;
        count += material ? material->layer_count : 0;
    }
    return count;
}

double scene_mask_memory(const Scene *scene)
{
    enum { FIELD_BYTES = 60 }; // a sample, while maps are drawn
    double sum = 0.0, most = 0.0;
    for (int i = 0; i < scene->object_count; i++) {
        const SceneObject *object = &scene->objects[i];
        int layers = count_layers(scene, object);
        double side = HEIGHT_MAP_SIDE, samples = side * side;
        if (object->kind->samples) {
            samples = (double)object->kind->samples(object->params);
        }
        sum += layers * samples * (double)sizeof(uint8_t);
        most = layers > 0 && samples > most ? samples : most;
    }
    return sum + FIELD_BYTES * most;
}

// ----

static bool has_layers(const World *world)
{
    for (int i = 0; i < world->material_count; i++) {
        if (world->material[i].layer_count > 0 && world_uses_material(world, i)) {
            return true;
        }
    }
    return false;
}

bool scene_make_masks(World *world, const Scene *scene, const Run *run, Error *e)
{
    Maker m = {world, scene, run};
    MaskSet *masks = &world->masks;
    mask_set_clear(masks);
    if (!has_layers(world)) {
        return true;
    }
    masks->of_part = memory_alloc(world->geometry.count, sizeof *masks->of_part, e);
    masks->part_count = masks->of_part ? world->geometry.count : 0;
    for (int64_t i = 0; i < masks->part_count; i++) {
        masks->of_part[i] = -1;
    }
    bool done = masks->of_part;
    for (int64_t i = 0; done && i < masks->part_count; i++) {
        done = make_masks(&m, i, e);
    }
    return done;
}
