#include "scene/export_grids.h"

#include "objects/common/own_space.h"
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

GridFile *scene_grids(const Scene *scene, const Run *run, Error *e)
{
    GridFile *grids = grid_file_new(e);
    bool done = grids && grow_all(scene, grids, run, e);
    if (done && grid_file_count(grids) == 0) {
        done = error_set(e, ERROR_INPUT,
                         "no object of '%s' grows in an envelope; trees, corals, sculptures, "
                         "lightning and vessels do",
                         scene->file);
    }
    if (!done) {
        grid_file_free(grids);
        return NULL;
    }
    return grids;
}
