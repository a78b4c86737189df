#include "scene/place.h"

#include "scene/document.h"

#include <stdio.h>
#include <string.h>

enum { LONGEST_PATH = 512 };

// Reads the document again; NULL when out of memory. This is needed only for errors, so that
// scenes need not keep their documents.
static const Node *read_again(Arena *arena, const Scene *scene)
{
    int count = 0;
    for (const char *at = scene->overrides; *at; at += strlen(at) + 1) {
        count++;
    }
    const char **overrides = arena_alloc(arena, sizeof *overrides * (size_t)(count + 1), NULL);
    const char *at = scene->overrides;
    for (int i = 0; overrides && i < count; i++, at += strlen(at) + 1) {
        overrides[i] = at;
    }
    SceneSource source = {.text = scene->text,
                          .length = strlen(scene->text),
                          .name = scene->file,
                          .folder = scene->folder,
                          .overrides = overrides,
                          .override_count = count};
    return overrides ? document_read(arena, &source, NULL) : NULL;
}

static void locate(const Node *node, const Scene *scene, Error *e)
{
    bool by_key = node->key && node->kind != NODE_SCALAR; // its contents can start on a later line
    if (node->source) {
        error_locate(e, node->source, 0, 0);
    } else {
        error_locate(e, node->file ? node->file : scene->file, by_key ? node->key_line : node->line,
                     by_key ? node->key_column : node->column);
    }
}

bool scene_fail_at(const Scene *scene, const char *path, Error *e)
{
    if (!e || e->code == ERROR_CANCELLED) {
        return false;
    }
    error_quote_file(e);
    char whole[LONGEST_PATH];
    snprintf(whole, sizeof whole, "%s%s%s", path, *path && e->key[0] ? "." : "", e->key);
    Arena *arena = *whole ? arena_new(NULL) : NULL;
    const Node *root = arena ? read_again(arena, scene) : NULL;
    if (root) {
        const char *rest;
        locate(node_follow(root, whole, &rest), scene, e);
    }
    arena_free(arena);
    error_locate(e, scene->file, 0, 0);
    return false;
}

bool scene_fail_object(const Scene *scene, int index, Error *e)
{
    if (!e || e->code == ERROR_CANCELLED) {
        return false;
    }
    const SceneObject *object = &scene->objects[index];
    char label[128], path[128];
    int length = snprintf(label, sizeof label, "object '%s'", object->name);
    error_quote_file(e);
    if (strncmp(e->message, label, (size_t)length) !=
        0) { // growth may have added the label already
        error_prefix(e, "%s: ", label);
    }
    snprintf(path, sizeof path, "objects.%s.%s", object->name, kind_name(object->kind));
    return scene_fail_at(scene, path, e);
}
