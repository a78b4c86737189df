#include "animate/turntable.h"
#include "api/handles.h"

#include "render/material/material.h"
#include "scene/needs.h"
#include "scene/picture_read.h"
#include "scene/species_list.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static RamifyScene *hand_scene(Scene *scene, Error *e, RamifyError *error)
{
    if (scene && !turntable_check_tracks(scene, e)) {
        scene_free(scene);
        scene = NULL;
    }
    if (!scene) {
        api_fail(error, e);
    }
    return (RamifyScene *)(void *)scene;
}

RamifyScene *ramify_scene_load(const char *file, const char *const *overrides, int override_count,
                               RamifyError *error)
{
    Error e = {0};
    return hand_scene(scene_read(file, overrides, override_count, &e), &e, error);
}

RamifyScene *ramify_scene_load_text(const char *text, size_t length, const char *name,
                                    const char *folder, const char *const *overrides,
                                    int override_count, RamifyError *error)
{
    Error e = {0};
    Scene *scene = scene_read_text(text, length, name, folder, overrides, override_count, &e);
    return hand_scene(scene, &e, error);
}

RamifyScene *ramify_scene_load_settings(const char *picture, const char *const *overrides,
                                        int override_count, RamifyError *error)
{
    Error e = {0};
    char *origin = NULL, *text = picture_read_settings(picture, &origin, &e);
    Scene *scene =
        text ? scene_read_settings(text, origin, picture, overrides, override_count, &e) : NULL;
    free(text);
    free(origin);
    return hand_scene(scene, &e, error);
}

void ramify_scene_free(RamifyScene *scene)
{
    scene_free((Scene *)(void *)scene);
}

void ramify_scene_size(const RamifyScene *scene, int *width, int *height)
{
    *width = scene_of(scene)->film.width;
    *height = scene_of(scene)->film.height;
}

static int64_t object_attractors(const SceneObject *object)
{
    const Kind *kind = object->kind;
    return kind->attractors ? kind->attractors(object->params) : 0;
}

static int64_t object_instances(const SceneObject *object)
{
    const Kind *kind = object->kind;
    return kind->copies ? kind->copies(object->params) : 0;
}

void ramify_scene_info(const RamifyScene *scene, RamifySceneInfo *info)
{
    const Scene *own = scene_of(scene);
    *info = (RamifySceneInfo){.file = own->file,
                              .seed = own->seed,
                              .width = own->film.width,
                              .height = own->film.height,
                              .samples = render_end(&own->render) - own->render.first_sample,
                              .denoise = own->denoise,
                              .max_seconds = own->render.max_seconds,
                              .max_noise = own->render.max_noise,
                              .grow_to = own->grow_to,
                              .object_count = own->object_count,
                              .material_count = own->material_count,
                              .light_count = own->light_count,
                              .target_count = own->target_count,
                              .memory = (int64_t)scene_memory(own)};
    memcpy(info->crop, own->film.crop, sizeof info->crop);
}

int ramify_scene_frames(const RamifyScene *scene)
{
    const SceneAnimation *animation = scene_of(scene)->animation;
    return animation ? animation->frames : 0;
}

int ramify_scene_planned_samples(const RamifyScene *scene)
{
    return render_planned(&scene_of(scene)->render);
}

void ramify_scene_sample_range(const RamifyScene *scene, int *first, int *end, int *all)
{
    const RenderParams *render = &scene_of(scene)->render;
    *first = render->first_sample;
    *end = render_end(render);
    *all = render->samples;
}

const char *ramify_scene_text(const RamifyScene *scene)
{
    return scene_of(scene)->text;
}

const char *ramify_scene_resolved(const RamifyScene *scene)
{
    return scene_of(scene)->resolved;
}

bool api_check_object(const RamifyScene *scene, int index, Error *e)
{
    int count = scene_of(scene)->object_count;
    return (index >= 0 && index < count) ||
           error_set(e, ERROR_INPUT, "no object %d; the scene has %d, counted from 0", index,
                     count);
}

int ramify_scene_object_count(const RamifyScene *scene)
{
    return scene_of(scene)->object_count;
}

const char *ramify_scene_object_name(const RamifyScene *scene, int index)
{
    return scene_of(scene)->objects[index].name;
}

// A side of its world; 0 = none.
static int object_tiles(const SceneObject *object)
{
    TileGrid grid;
    bool cut = object->kind->tiles && object->kind->tiles(object->params, &grid);
    return cut ? grid.count : 0;
}

void ramify_scene_object(const RamifyScene *scene, int index, RamifyObjectInfo *info)
{
    const SceneObject *object = &scene_of(scene)->objects[index];
    const Kind *kind = object->kind;
    *info = (RamifyObjectInfo){.name = object->name,
                               .kind = kind_name(kind),
                               .seed = scene_object_seed(scene_of(scene), index),
                               .grows = kind->grow != NULL,
                               .is_land = kind->heights != NULL,
                               .paints = kind->paint != NULL,
                               .tiles = object_tiles(object),
                               .attractors = object_attractors(object),
                               .instances = object_instances(object)};
}

void ramify_scene_object_describe(const RamifyScene *scene, int index, char *text, size_t size)
{
    const SceneObject *object = &scene_of(scene)->objects[index];
    const Kind *kind = object->kind;
    if (size > 0) {
        text[0] = 0;
    }
    if (kind->describe) {
        kind->describe(object->params, text, size);
    }
}

const char *ramify_scene_material_name(const RamifyScene *scene, int index)
{
    return scene_of(scene)->materials[index].name;
}

void ramify_scene_target(const RamifyScene *scene, int index, RamifyTarget *target)
{
    const SceneTarget *own = &scene_of(scene)->targets[index];
    *target = (RamifyTarget){.object = own->object,
                             .measure = own->measure,
                             .low = own->low > -TARGET_NO_BOUND ? own->low : (double)-INFINITY,
                             .high = own->high < TARGET_NO_BOUND ? own->high : (double)INFINITY};
}

// Returns text generated from the scene's tables, or sets the error.
static char *hand_text(char *text, const Error *e, RamifyError *error)
{
    if (!text) {
        api_fail(error, e);
    }
    return text;
}

char *ramify_schema(RamifyError *error)
{
    Error e = {0};
    char *text = scene_schema_json(&e);
    return hand_text(text, &e, error);
}

char *ramify_schema_markdown(RamifyError *error)
{
    Error e = {0};
    char *text = scene_schema_markdown(&e);
    return hand_text(text, &e, error);
}

char *ramify_schema_paths(RamifyError *error)
{
    Error e = {0};
    char *text = scene_schema_paths(&e);
    return hand_text(text, &e, error);
}

char *ramify_species(RamifyError *error)
{
    Error e = {0};
    char *text = species_list(&e);
    return hand_text(text, &e, error);
}
