#include "scene/overrides.h"

#include "config/hint.h"
#include "config/yaml.h"
#include "scene/builtin.h"

#include <stdlib.h>
#include <string.h>

#define MAX_NAMES 256

typedef struct Override {
    Arena *arena;
    const char *source; // "override path=value"; NULL = the scene's file, at line and column
    int line, column;
    Error *e;
} Override;

// The caller knows the scene's name and adds the place of values from the file.
static Node *fail(const Override *o)
{
    if (o->source) {
        error_locate(o->e, o->source, 0, 0);
    }
    return NULL;
}

// Entry of a list by name or number.
static Node *find_entry(const Override *o, const Node *list, const char *token)
{
    Node *found = node_step(list, token);
    if (found) {
        return found;
    }
    char *end;
    long index = strtol(token, &end, 10);
    if (*end == 0 && end != token) {
        error_set(o->e, ERROR_INPUT, "no entry %ld in this list; it has %d, counted from 0", index,
                  list->count);
        return fail(o);
    }
    const char *names[MAX_NAMES];
    int count = 0;
    for (const Node *entry = list->first; entry && count < MAX_NAMES; entry = entry->next) {
        const char *name = node_get_text(entry, "name");
        if (name) {
            names[count++] = name;
        }
    }
    char hint[512];
    hint_format(token, names, count, hint, sizeof hint);
    error_set(o->e, ERROR_INPUT, "no entry named '%.60s' in this list; %s", token, hint);
    return fail(o);
}

static Node *new_node(const Override *o, NodeKind kind)
{
    Node *node = node_new(o->arena, kind, o->e);
    if (node) {
        node->source = o->source;
        node->line = node->key_line = o->line;
        node->column = node->key_column = o->column;
    }
    return node;
}

// The child with the name token; created if a mapping lacks it.
static Node *step_into(const Override *o, Node *node, const char *token)
{
    if (node->kind == NODE_LIST) {
        return find_entry(o, node, token);
    }
    if (node->kind == NODE_SCALAR) {
        if (!node_is_null(node)) {
            error_set(o->e, ERROR_INPUT,
                      "'%.60s' is below a value that is not a mapping; shorten the path", token);
            return fail(o);
        }
        node->kind = NODE_MAP;
    }
    Node *child = node_get(node, token);
    if (!child) {
        child = new_node(o, NODE_SCALAR);
        if (!child) {
            return NULL;
        }
        node_append(node, child, token);
    }
    return child;
}

static void replace(Node *node, const Node *value)
{
    Node old = *node;
    *node = *value;
    node->key = old.key;
    node->key_line = old.key_line;
    node->key_column = old.key_column;
    node->next = old.next;
}

// All known material names: those of the file, then the built-in ones.
static Node *unknown_material(const Override *o, const Node *list, const char *token)
{
    const char *names[MAX_NAMES];
    char hint[512];
    int count = 0;
    for (const Node *entry = list->first; entry && count < MAX_NAMES; entry = entry->next) {
        const char *name = node_get_text(entry, "name");
        if (name) {
            names[count++] = name;
        }
    }
    for (int i = 0; builtin_material_at(i) && count < MAX_NAMES; i++) {
        names[count++] = builtin_material_at(i)->name;
    }
    hint_format(token, names, count, hint, sizeof hint);
    error_set(o->e, ERROR_INPUT, "there is no material '%.60s'; %s", token, hint);
    return fail(o);
}

// The root's list of materials; created if there is none.
static Node *material_list(const Override *o, Node *root)
{
    Node *list = node_get(root, "materials");
    if (list && node_is_null(list)) {
        list->kind = NODE_LIST;
    }
    if (!list && (list = new_node(o, NODE_LIST))) {
        node_append(root, list, "materials");
    }
    return list;
}

// Adds an entry for a built-in material that is not in the file's list, so that it can be changed.
static Node *step_into_materials(const Override *o, Node *list, const char *token)
{
    if (list->kind != NODE_LIST || (*token >= '0' && *token <= '9')) {
        return step_into(o, list, token);
    }
    for (Node *entry = list->first; entry; entry = entry->next) {
        const char *name = node_get_text(entry, "name");
        if (name && strcmp(name, token) == 0) {
            return entry;
        }
    }
    if (!builtin_material(token)) {
        return unknown_material(o, list, token);
    }
    Node *entry = new_node(o, NODE_MAP), *name = entry ? new_node(o, NODE_SCALAR) : NULL;
    if (!name) {
        return NULL;
    }
    name->text = token;
    name->quoted = true;
    node_append(entry, name, "name");
    node_append(list, entry, NULL);
    return entry;
}

// Puts value at path (which is modified).
static bool apply(const Override *o, Node *root, char *path, const Node *value)
{
    Node *node = root, *materials = NULL;
    if (strncmp(path, "materials.", 10) == 0 && root->kind == NODE_MAP &&
        !(materials = material_list(o, root))) {
        return false;
    }
    while (node && path) {
        char *dot = strchr(path, '.');
        if (dot) {
            *dot = 0;
        }
        if (!*path) {
            error_set(o->e, ERROR_INPUT, "an empty name in the path; write a.b=value");
            return fail(o);
        }
        node = node == materials ? step_into_materials(o, node, path) : step_into(o, node, path);
        path = dot ? dot + 1 : NULL;
    }
    if (node) {
        replace(node, value);
    }
    return node;
}

bool override_apply(Arena *arena, Node *root, const char *override, Error *e)
{
    Override o = {arena, arena_format(arena, e, "override %s", override), 0, 0, e};
    const char *equals = strchr(override, '=');
    if (!o.source) {
        return false;
    }
    if (!equals || equals == override || !equals[1]) {
        error_set(e, ERROR_INPUT, "not an override; write path=value, as in camera.fov=35");
        return fail(&o);
    }
    char *path = arena_text(arena, override, (size_t)(equals - override), e);
    const Node *value = yaml_parse(arena, equals + 1, strlen(equals + 1), o.source, o.source, e);
    return path && value && apply(&o, root, path, value);
}

// Sets the origin of every node of the value.
static void place_nodes(const Override *o, Node *node)
{
    node->source = o->source;
    node->line = o->line;
    node->column = o->column;
    node->animated = true;
    for (Node *child = node->first; child; child = child->next) {
        place_nodes(o, child);
    }
}

bool override_change(Arena *arena, Node *root, const SceneChange *change, Error *e)
{
    Override o = {.arena = arena, .line = change->line, .column = change->column, .e = e};
    if (change->line == 0 &&
        !(o.source = arena_text(arena, change->source, strlen(change->source), e))) {
        return false;
    }
    char *path = arena_text(arena, change->path, strlen(change->path), e);
    Node *value =
        path ? yaml_parse(arena, change->value, strlen(change->value), change->path, NULL, e)
             : NULL;
    if (!value) {
        return false;
    }
    place_nodes(&o, value);
    return apply(&o, root, path, value);
}
