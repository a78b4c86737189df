#include "scene/surfaces.h"

#include "base/memory.h"
#include "mesh/geometry_measure.h"
#include "render/world.h"
#include "scene/build.h"
#include "shape/mesh_close.h"

#include <stdlib.h>

typedef struct Surface {
    Nearest *nearest; // NULL = not made yet
    float size;
    Mesh *mesh; // of `over`; NULL = not made yet
    ShapeSurface over;
    SurfaceCopy *copy;       // of `over`; owned
    Mesh *water;             // likewise
    const HeightField *land; // NULL = it is no terrain
    HeightField *own_land;   // that one, unless a placed part owns it
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
            mesh_free(surfaces->of[i].mesh);
            free(surfaces->of[i].copy);
            mesh_free(surfaces->of[i].water);
            height_field_free(surfaces->of[i].own_land);
        }
        free(surfaces->of);
        free(surfaces);
    }
}

static void find_nearest(const void *user, Vec3 *p, Vec3 *normal)
{
    nearest_point(user, p, normal);
}

// Lists where the surface is seen again, with the water there if these places are in its mesh.
static bool find_copies(Surface *surface, const SceneObject *object, const Geometry *parts,
                        Error *e)
{
    const Kind *kind = object->kind;
    int count = kind->surface_copies ? kind->surface_copies(object->params, NULL) : 0;
    if (count == 0) {
        return true;
    }
    surface->copy = memory_alloc(count, sizeof *surface->copy, e);
    if (!surface->copy) {
        return false;
    }
    kind->surface_copies(object->params, surface->copy);
    surface->water = surface->copy->in_mesh ? geometry_water(parts, e) : NULL;
    surface->over.copy = surface->copy;
    surface->over.copy_count = count;
    surface->over.water = surface->water;
    return surface->water || !surface->copy->in_mesh;
}

// Makes what is missing of the object's surface; the mesh only if it is wanted.
static bool make(Surface *surface, const SceneObject *object, const Geometry *geometry, bool mesh,
                 const Run *run, Error *e)
{
    if (!surface->nearest) {
        Aabb box = geometry_bounds(geometry, 0);
        surface->size = aabb_is_empty(box) ? 0.0f : vec3_distance(box.low, box.high);
        surface->nearest = nearest_new(geometry, run, e);
    }
    if (surface->nearest && mesh) {
        surface->mesh = geometry_surface(geometry, e);
        surface->over = (ShapeSurface){
            .mesh = surface->mesh, .nearest = find_nearest, .user = surface->nearest};
    }
    return surface->nearest &&
           (!mesh || (surface->mesh && find_copies(surface, object, geometry, e)));
}

static bool build(Surfaces *surfaces, int index, bool mesh, const Run *run, Error *e)
{
    Run quiet = *run; // the object's own turn reports its warnings
    quiet.warn = NULL;
    quiet.observer = NULL;
    BuildStats stats = {0};
    const SceneObject *object = &surfaces->scene->objects[index];
    World *world = world_new(e);
    bool done = world && scene_give_settings(surfaces->scene, world, e) &&
                scene_place_object(world, surfaces->scene, index, (Shared){.surfaces = surfaces},
                                   &quiet, &stats, e) &&
                make(&surfaces->of[index], object, &world->geometry, mesh, run, e);
    for (int64_t i = 0; done && i < world->geometry.count; i++) {
        Part *part = &world->geometry.part[i];
        if (part->land && !surfaces->of[index].own_land) {
            surfaces->of[index].land = surfaces->of[index].own_land = part->land;
            part->land = NULL;
        }
    }
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
            surfaces->of[index].land = part->land ? part->land : surfaces->of[index].land;
            if (!memory_reserve(&parts->part, &parts->capacity, parts->count + 1, sizeof *part,
                                e)) {
                return false;
            }
            parts->part[parts->count++] = *part;
        }
    }
    return true;
}

// Makes the surface from the object's parts, or builds the object.
static bool prepare(Surfaces *surfaces, int index, bool mesh, const Run *run, Error *e)
{
    Surface *surface = &surfaces->of[index];
    if (surface->nearest && (surface->mesh || !mesh)) {
        return true;
    }
    const SceneObject *object = &surfaces->scene->objects[index];
    Geometry parts;
    bool done = find_placed(surfaces, index, &parts, e) &&
                (parts.count > 0 ? make(surface, object, &parts, mesh, run, e)
                                 : build(surfaces, index, mesh, run, e));
    free(parts.part);
    return done;
}

const Nearest *surfaces_of(Surfaces *surfaces, int index, float *size, const Run *run, Error *e)
{
    if (!prepare(surfaces, index, false, run, e)) {
        return NULL;
    }
    *size = surfaces->of[index].size;
    return surfaces->of[index].nearest;
}

const ShapeSurface *surfaces_over(Surfaces *surfaces, int index, const Run *run, Error *e)
{
    Surface *surface = &surfaces->of[index];
    if (!prepare(surfaces, index, true, run, e)) {
        return NULL;
    }
    if (!(mesh_area(surface->mesh) > 0.0)) {
        error_set(e, ERROR_INPUT,
                  "the object '%s' has no surface to grow over: its curves, leaves and other "
                  "copies do not count; name an object with a skin, such as a terrain or a shape",
                  surfaces->scene->objects[index].name);
        return NULL;
    }
    return &surface->over;
}

const HeightField *surfaces_land(const Surfaces *surfaces, int index)
{
    return surfaces->of[index].land;
}

// ---- order

typedef struct Order {
    const Scene *scene;
    bool *listed;
    int *order, count;
} Order;

// Lists what the object and its rivals, which grow with it, wait for, then the object.
static void list_object(Order *o, int index)
{
    if (index < 0 || o->listed[index]) { // a part of a scene may lack objects
        return;
    }
    o->listed[index] = true;
    for (int i = 0; i < o->scene->object_count; i++) {
        const SceneObject *mate = &o->scene->objects[i];
        if (i == index || scene_objects_contend(&o->scene->objects[index], mate)) {
            const char *name;
            for (int k = 0; (name = scene_object_waits_for(mate, k)); k++) {
                list_object(o, scene_find_object(o->scene, name));
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
