#include "scene/making.h"

#include "base/memory.h"
#include "scene/carry.h"
#include "scene/growths.h"
#include "scene/place.h"
#include "scene/rivals.h"

#include <stdio.h>
#include <stdlib.h>

static bool carry(const void *user, OutTree *tree, Error *e)
{
    const Making *m = user;
    return carry_tree(m->deformation, &m->own.to_scene, tree, m->recipe.run, e);
}

static bool prepare_deformation(Making *m, const SceneObject *object, Error *e)
{
    m->deformation = deformation_new(object->deform, object->deform_count, m->recipe.run, e);
    m->carrier = (Carrier){carry, m};
    m->recipe.carrier = &m->carrier;
    return m->deformation;
}

bool making_begin(Making *m, const Scene *scene, int index, const Run *run, Error *e)
{
    const SceneObject *object = &scene->objects[index];
    *m = (Making){.scene = scene, .index = index, .kind = object->kind};
    snprintf(m->label, sizeof m->label, "object '%s'", object->name);
    m->recipe = (Recipe){.seed = scene_object_seed(scene, index), .label = m->label, .run = run};
    bool done = own_space_enter(&m->own, object->kind, object->params, e);
    m->params = m->own.params;
    return done && (object->deform_count == 0 || prepare_deformation(m, object, e));
}

bool making_end(Making *m, bool done, Error *e)
{
    grown_clear(&m->grown);
    own_space_leave(&m->own);
    deformation_free(m->deformation);
    surfaces_free(m->surfaces);
    return done || scene_fail_object(m->scene, m->index, e);
}

// ---- among neighbours

// Finds the surface that the object grows over or stands on, if it does. surfaces: of `scene`.
static bool find_surface(Making *m, const Scene *scene, Surfaces *surfaces, Error *e)
{
    const char *over = scene_object_over(&m->scene->objects[m->index]);
    if (!over) {
        return true;
    }
    int index = scene_find_object(scene, over);
    m->recipe.surface = surfaces_over(surfaces, index, m->recipe.run, e);
    m->recipe.land = surfaces_land(surfaces, index);
    return m->recipe.surface || error_key(e, "%s", m->scene->objects[m->index].kind->over_key);
}

// The surface of an object that does not grow, in the whole scene.
static bool find_floor(Making *m, Surfaces *surfaces, Error *e)
{
    const Scene *scene = m->scene->whole ? m->scene->whole : m->scene;
    if (!scene_object_over(&m->scene->objects[m->index])) {
        return true;
    }
    if (!surfaces || scene != m->scene) {
        surfaces = m->surfaces = surfaces_new(scene, NULL, e);
    }
    return surfaces && find_surface(m, scene, surfaces, e);
}

static bool enter(Making *m, Rival *rival, const Scene *scene, int index, Surfaces *surfaces,
                  const Run *run, Error *e)
{
    if (!making_begin(m, scene, index, run, e) || !find_surface(m, scene, surfaces, e)) {
        return false;
    }
    const Contest *contest = scene->objects[index].contest;
    *rival = (Rival){.kind = m->kind,
                     .params = m->params,
                     .recipe = m->recipe,
                     .to_scene = m->own.to_scene,
                     .gap = contest ? contest->gap : 0.0f};
    return obstacles_new(scene, index, surfaces, run, &rival->obstacles, e);
}

// Grows object number index of the scene with its rivals, into their entries of growths.
static bool grow_rivals(const Scene *scene, int index, Shared shared, const Run *run, Error *e)
{
    Making *m = memory_alloc_zero(scene->object_count, sizeof *m, e);
    Rival *rival = memory_alloc_zero(scene->object_count, sizeof *rival, e);
    Run quiet = *run; // an observer watches one object, in whose turn the others are silent
    quiet.warn = run->observer ? NULL : run->warn;
    quiet.observer = NULL;
    int count = 0, failed = 0;
    bool done = m && rival;
    for (int i = 0; done && i < scene->object_count; i++) {
        if (i == index || scene_objects_contend(&scene->objects[index], &scene->objects[i])) {
            const Run *of = i == index ? run : &quiet;
            done = enter(&m[count], &rival[count], scene, i, shared.surfaces, of, e);
            failed = count++;
        }
    }
    if (done && !rivals_grow(rival, count, &failed)) {
        done = false;
        if (e) {
            *e = rival[failed].error;
        }
    }
    for (int i = 0; i < count; i++) {
        if (done) {
            grown_clear(&shared.growths[m[i].index]);
            shared.growths[m[i].index] = rival[i].whole;
        } else {
            grown_clear(&rival[i].whole);
        }
        obstacles_free(rival[i].obstacles);
        making_end(&m[i], done || i != failed, e);
    }
    free(rival);
    free(m);
    return done;
}

// Grows object number index of a complete scene with its rivals, unless its entry has a growth.
// borrowed: surfaces of that scene; NULL = it makes its own.
static bool grow_among(const Scene *scene, int index, Grown *growths, Surfaces *borrowed,
                       const Run *run, Error *e)
{
    if (growths[index].tree) {
        return true;
    }
    Surfaces *own = borrowed ? NULL : surfaces_new(scene, NULL, e);
    Shared shared = {growths, borrowed ? borrowed : own};
    bool done = shared.surfaces && grow_rivals(scene, index, shared, run, e);
    surfaces_free(own);
    return done;
}

// Takes the object's growth from the scene's contests, which the first who asks grows.
static bool grow_in_scene(Making *m, const Scene *scene, int index, Surfaces *surfaces,
                          Grown **memory, Error *e)
{
    Grown *growths = growths_open(scene->growths);
    bool done = grow_among(scene, index, growths, surfaces, m->recipe.run, e);
    growths_close(scene->growths);
    *memory = &growths[index];
    return done;
}

// Grows the object and its rivals for this time alone.
static bool grow_once(Making *m, const Scene *scene, int index, Surfaces *surfaces, Grown *own,
                      Error *e)
{
    Grown *growths = memory_alloc_zero(scene->object_count, sizeof *growths, e);
    bool done = growths && grow_among(scene, index, growths, surfaces, m->recipe.run, e);
    if (done) {
        *own = growths[index];
        growths[index] = (Grown){0};
    }
    for (int i = 0; growths && i < scene->object_count; i++) {
        grown_clear(&growths[i]);
    }
    free(growths);
    return done;
}

// Grows an object with neighbours, which are those of the whole scene, unless *memory has its
// growth. *memory is then its growth, in own if nobody keeps it.
static bool grow_with_neighbours(Making *m, Shared shared, Grown **memory, Grown *own, Error *e)
{
    const Scene *scene = m->scene->whole ? m->scene->whole : m->scene;
    int index = scene_find_object(scene, m->scene->objects[m->index].name);
    Surfaces *surfaces = scene == m->scene ? shared.surfaces : NULL;
    if (*memory && scene == m->scene) {
        return grow_among(scene, index, shared.growths, surfaces, m->recipe.run, e);
    }
    if (scene->objects[index].contest && !m->recipe.run->observer) { // it watches each growth
        return grow_in_scene(m, scene, index, surfaces, memory, e);
    }
    *memory = own;
    return grow_once(m, scene, index, surfaces, own, e);
}

bool making_grow(Making *m, Shared shared, Error *e)
{
    Grown own = {0}, *memory = shared.growths ? &shared.growths[m->index] : NULL;
    if (!m->kind->grow) {
        return find_floor(m, shared.surfaces, e);
    }
    bool done = !scene_object_has_neighbours(&m->scene->objects[m->index]) ||
                grow_with_neighbours(m, shared, &memory, &own, e);
    done =
        done && kind_grow(m->kind, m->params, &m->recipe, m->scene->grow_to, memory, &m->grown, e);
    grown_clear(&own);
    return done;
}
