#include "scene/export_grids.h"

#include "objects/common/own_space.h"
#include "render/cloud/clouds.h"
#include "render/world.h"
#include "scene/build.h"

#include <stdio.h>

enum { FIELD_VOXELS = 96, NAME = 192 }; // along the longest side

typedef struct Collecting {
    GridFile *grids;
    const char *object;
    const Run *run;
    int elements; // elements of the object so far
} Collecting;

// The oak's crown is "oak/crown". An object without parts that grows more than once numbers them
// from the second.
static bool collect(void *user, const char *part, const Envelope *envelope, const GuideField *field,
                    Error *e)
{
    Collecting *to = user;
    char element[64] = "", name[NAME];
    to->elements++;
    if (!(envelope_volume(envelope) > 0.0)) {
        return true; // the surface of another object
    }
    if (part) {
        snprintf(element, sizeof element, "/%s", part);
    } else if (to->elements > 1) {
        snprintf(element, sizeof element, "/%d", to->elements);
    }
    snprintf(name, sizeof name, "%s%s/envelope", to->object, element);
    if (!envelope_add_to(envelope, name, to->grids, to->run, e)) {
        return false;
    }
    snprintf(name, sizeof name, "%s%s/field", to->object, element);
    return !field || guide_field_add_to(field, envelope, FIELD_VOXELS, name, to->grids, to->run, e);
}

// Moves the grids from number first on out of the object's own space.
static bool carry_grids(const SceneObject *object, GridFile *grids, int64_t first, Error *e)
{
    OwnSpace own;
    bool done = own_space_enter(&own, object->kind, object->params, e) &&
                (!own.moved || grid_file_move(grids, first, &own.to_scene, e));
    own_space_leave(&own);
    return done;
}

static bool grow_all(const Scene *scene, GridFile *grids, const Run *run, Error *e)
{
    bool done = true;
    for (int i = 0; done && i < scene->object_count; i++) {
        if (!scene->objects[i].kind->grow) {
            continue;
        }
        Collecting to = {grids, scene->objects[i].name, run, 0};
        const GrowthObserver observer = {collect, &to};
        Run watched = *run;
        watched.observer = &observer;
        int64_t first = grid_file_count(grids);
        OutTree *tree = scene_grow_object(scene, i, &watched, e);
        done = tree && carry_grids(&scene->objects[i], grids, first, e);
        out_tree_free(tree);
    }
    return done;
}

// ---- clouds

typedef struct CloudSample {
    const CloudSet *clouds;
    int index;
} CloudSample;

static float extinction_at(const void *context, Vec3 p)
{
    const CloudSample *sample = context;
    return clouds_extinction_of(sample->clouds, sample->index, p);
}

static bool add_grown(const Cloud *cloud, int count, const CloudSet *clouds, GridFile *grids,
                      const Run *run, Error *e)
{
    bool done = true;
    for (int i = 0; done && i < count; i++) {
        if (cloud[i].kind == CLOUD_GRID) {
            continue; // is such a file's own
        }
        Aabb box;
        float distance;
        char name[NAME];
        clouds_samples_of(clouds, i, &box, &distance);
        snprintf(name, sizeof name, "clouds/%d/density", i);
        CloudSample sample = {clouds, i};
        done = grid_file_add_density(grids, name, box, distance, extinction_at, &sample, run, e);
    }
    return done;
}

static bool lies_on_land(const Scene *scene)
{
    for (int i = 0; i < scene->cloud_count; i++) {
        if (scene->clouds[i].over) {
            return true;
        }
    }
    return false;
}

// Clouds belong to a whole scene, not to some objects of it.
static bool add_clouds(const Scene *scene, GridFile *grids, const Run *run, Error *e)
{
    if (scene->cloud_count == 0 || scene->whole) {
        return true;
    }
    World *world = lies_on_land(scene) ? scene_build(scene, run, NULL, e) : NULL;
    if (lies_on_land(scene) && !world) {
        return false;
    }
    const Cloud *cloud = world ? world->cloud : scene->clouds;
    CloudSet *clouds = clouds_new(cloud, scene->cloud_count, scene->seed, run, e);
    bool done = clouds && add_grown(cloud, scene->cloud_count, clouds, grids, run, e);
    clouds_free(clouds);
    world_free(world);
    return done;
}

GridFile *scene_grids(const Scene *scene, const Run *run, Error *e)
{
    GridFile *grids = grid_file_new(e);
    bool done = grids && grow_all(scene, grids, run, e) && add_clouds(scene, grids, run, e);
    if (done && grid_file_count(grids) == 0) {
        done = error_set(
            e, ERROR_INPUT,
            "nothing of '%s' is a grid: no object grows in an envelope, as trees, corals, "
            "sculptures, lightning and vessels do, and no clouds grow",
            scene->file);
    }
    if (!done) {
        grid_file_free(grids);
        return NULL;
    }
    return grids;
}
