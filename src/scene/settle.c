#include "scene/settle.h"

#include "config/write.h"
#include "scene/build.h"
#include "scene/spec.h"

#include <stdlib.h>
#include <string.h>

typedef struct Settling {
    const Scene *scene;
    const SceneObject *object; // being written
    Arena *arena;              // for the settled parameters
    bool failed;
    Error *e;
} Settling;

static void *copy(Settling *s, const void *of, size_t size)
{
    void *made = arena_alloc(s->arena, size, s->e);
    s->failed |= !made;
    return made ? memcpy(made, of, size) : NULL;
}

static const void *settle_scene(Settling *s)
{
    Scene *used = copy(s, s->scene, sizeof *used);
    if (used) {
        used->camera.focus_distance = vec3_distance(used->camera.position, used->camera.target);
    }
    return used;
}

static const void *settle_object(Settling *s)
{
    SceneObject *used = copy(s, s->object, sizeof *used);
    if (used) {
        used->seed = scene_object_seed(s->scene, (int)(s->object - s->scene->objects));
    }
    return used;
}

static const void *settle_params(Settling *s, const Table *table)
{
    void *used = s->object->kind->settle ? copy(s, s->object->params, table->size) : NULL;
    if (used) {
        s->object->kind->settle(s->object->params, used);
    }
    return used;
}

static const void *used_values(void *user, const Table *table, const void *params)
{
    Settling *s = user;
    if (table == &scene_table) {
        return settle_scene(s);
    }
    if (table == &object_table) {
        s->object = params;
        return settle_object(s);
    }
    return s->object && params == s->object->params ? settle_params(s, table) : NULL;
}

char *settle_write(const Scene *scene, const FileName *files, Error *e)
{
    Settling settling = {.scene = scene, .arena = arena_new(e), .e = e};
    char *text = NULL, *kept = NULL;
    if (settling.arena) {
        text = write_struct(&scene_table, scene, files, used_values, &settling, e);
    }
    if (text && !settling.failed) {
        kept = arena_text(scene->arena, text, strlen(text), e);
    }
    free(text);
    arena_free(settling.arena);
    return kept;
}
