#include "scene/settle.h"

#include "base/memory.h"
#include "config/scalar.h"
#include "scene/kind.h"
#include "scene/spec.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The number stored for the key as text; "" for what is no number.
static void stored_number(const Key *row, const char *at, char text[32])
{
    int whole;
    int64_t large;
    float number;
    text[0] = 0;
    if (row->type == KEY_INT) {
        memcpy(&whole, at, sizeof whole);
        snprintf(text, 32, "%d", whole);
    } else if (row->type == KEY_INT64) {
        memcpy(&large, at, sizeof large);
        snprintf(text, 32, "%" PRId64, large);
    } else if (row->type == KEY_FLOAT) {
        memcpy(&number, at, sizeof number);
        scalar_from_float(number, text);
    }
}

static bool note_zero(Node *node, Arena *arena, const char *text, Error *e)
{
    if (node && node->kind == NODE_SCALAR && strcmp(node->text, "0") == 0) {
        node->note = arena_text(arena, text, strlen(text), e);
        return node->note;
    }
    return true;
}

static bool note_table(const Table *table, const char *params, Node *map, Arena *arena, Error *e)
{
    for (const Key *row = table->keys; row->key; row++) {
        Node *node = node_get(map, row->key);
        if (!node || row->flags & (KEY_HIDDEN | KEY_VIRTUAL)) {
            continue;
        }
        if (row->type == KEY_GROUP) {
            if (!note_table(row->table, params + row->offset, node, arena, e)) {
                return false;
            }
            continue;
        }
        char text[32];
        stored_number(row, params + row->offset, text);
        if (*text && strcmp(text, "0") != 0 && !note_zero(node, arena, text, e)) {
            return false;
        }
    }
    return true;
}

static bool note_object(const SceneObject *object, Node *node, Arena *arena, Error *e)
{
    const Kind *kind = kind_of(object);
    const Key *row = table_find(&object_table, kind->key);
    if (!kind->settle || !row) {
        return true;
    }
    char *params = memory_alloc_zero((int64_t)row->table->size, 1, e);
    if (!params) {
        return false;
    }
    kind->settle(object, params);
    bool done = note_table(row->table, params, node_get(node, kind->key), arena, e);
    free(params);
    return done;
}

static bool note_seed(const Scene *scene, int index, Node *object, Arena *arena, Error *e)
{
    char text[32];
    snprintf(text, sizeof text, "%" PRIu64, scene_object_seed(scene, index));
    return note_zero(node_get(object, "seed"), arena, text, e);
}

static bool note_focus(const Scene *scene, const Node *document, Arena *arena, Error *e)
{
    char text[32];
    const Camera *camera = &scene->camera;
    scalar_from_float(vec3_distance(camera->position, camera->target), text);
    return note_zero(node_get(node_get(document, "camera"), "focus_distance"), arena, text, e);
}

bool settle_notes(const Scene *scene, Node *document, Arena *arena, Error *e)
{
    const Node *objects = node_get(document, "objects");
    int index = 0;
    for (Node *node = objects ? objects->first : NULL; node; node = node->next, index++) {
        if (!note_seed(scene, index, node, arena, e) ||
            !note_object(&scene->objects[index], node, arena, e)) {
            return false;
        }
    }
    return note_focus(scene, document, arena, e);
}
