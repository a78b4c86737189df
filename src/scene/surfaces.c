#include "scene/surfaces.h"

#include "base/memory.h"
#include "mesh/geometry_measure.h"
#include "render/world.h"
#include "scene/build.h"

#include <stdlib.h>

typedef struct Surface {
    Nearest *nearest; // NULL = not made yet
    float size;
} Surface;

struct Surfaces {
    const Scene *scene;
    const Geometry *placed;
    Surface *of; // each object
};

Surfaces *surfaces_new(const Scene *scene, const Geometry *placed, Error *e)
{
    Surfaces *surfaces = memory_alloc_zero(1, sizeof *surfaces, e);
    if (surfaces) {
        surfaces->scene = scene;
        surfaces->placed = placed;
        surfaces->of = memory_alloc_zero(scene->object_count, sizeof *surfaces->of, e);
    }
    if (!surfaces || !surfaces->of) {
        free(surfaces);
        return NULL;
    }
    return surfaces;
}

void surfaces_free(Surfaces *surfaces)
{
    if (surfaces) {
        for (int i = 0; i < surfaces->scene->object_count; i++) {
            nearest_free(surfaces->of[i].nearest);
        }
        free(surfaces->of);
        free(surfaces);
    }
}

static bool make(Surface *surface, const Geometry *geometry, const Run *run, Error *e)
{
    Aabb box = geometry_bounds(geometry, 0);
    surface->size = aabb_is_empty(box) ? 0.0f : vec3_distance(box.low, box.high);
    surface->nearest = nearest_new(geometry, run, e);
    return surface->nearest;
}

static bool build(Surfaces *surfaces, int index, const Run *run, Error *e)
{
    Run quiet = *run; // the object's own turn reports its warnings
    quiet.warn = NULL;
    quiet.observer = NULL;
    BuildStats stats = {0};
    World *world = world_new(e);
    bool done = world && scene_give_settings(surfaces->scene, world, e) &&
                scene_place_object(world, surfaces->scene, index, (Shared){.surfaces = surfaces},
                                   &quiet, &stats, e) &&
                make(&surfaces->of[index], &world->geometry, run, e);
    world_free(world);
    return done;
}

// Lists the object's parts among those placed, which continue to own what they hold.
static bool find_placed(const Surfaces *surfaces, int index, Geometry *parts, Error *e)
{
    *parts = (Geometry){0};
    for (int64_t i = 0; surfaces->placed && i < surfaces->placed->count; i++) {
        const Part *part = &surfaces->placed->part[i];
        if (part->object == index) {
            if (!memory_reserve(&parts->part, &parts->capacity, parts->count + 1, sizeof *part,
                                e)) {
                return false;
            }
            parts->part[parts->count++] = *part;
        }
    }
    return true;
}

const Nearest *surfaces_of(Surfaces *surfaces, int index, float *size, const Run *run, Error *e)
{
    Surface *surface = &surfaces->of[index];
    if (!surface->nearest) {
        Geometry parts;
        bool done =
            find_placed(surfaces, index, &parts, e) &&
            (parts.count > 0 ? make(surface, &parts, run, e) : build(surfaces, index, run, e));
        free(parts.part);
        if (!done) {
            return NULL;
        }
    }
    *size = surface->size;
    return surface->nearest;
}

// ---- order

typedef struct Order {
    const Scene *scene;
    bool *listed;
    int *order, count;
} Order;

// Lists what the object and its rivals, which grow with it, are clear of, then the object.
static void list_object(Order *o, int index)
{
    if (index < 0 || o->listed[index]) { // a part of a scene may lack objects
        return;
    }
    o->listed[index] = true;
    for (int i = 0; i < o->scene->object_count; i++) {
        const SceneObject *mate = &o->scene->objects[i];
        if (i == index || scene_objects_contend(&o->scene->objects[index], mate)) {
            for (int k = 0; k < mate->clear_of_count; k++) {
                list_object(o, scene_find_object(o->scene, mate->clear_of[k].object));
            }
        }
    }
    o->order[o->count++] = index;
}

bool surfaces_order(const Scene *scene, int *order, Error *e)
{
    Order o = {.scene = scene,
               .listed = memory_alloc_zero(scene->object_count, sizeof *o.listed, e),
               .order = order};
    for (int i = 0; o.listed && i < scene->object_count; i++) {
        list_object(&o, i);
    }
    bool done = o.listed;
    free(o.listed);
    return done;
}
