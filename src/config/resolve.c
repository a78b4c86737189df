#include "config/resolve.h"

#include "config/hint.h"
#include "config/resolve_value.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define MAX_KNOWN 64

const char *resolver_path(Resolver *r, const Path *path, const char *key)
{
    if (!path) {
        return key ? key : "the scene";
    }
    const char *front = path->up ? resolver_path(r, path->up, path->key) : path->key;
    const char *whole = key ? arena_format(r->arena, r->e, "%s.%s", front, key) : front;
    return whole ? whole : "";
}

bool resolver_fail(Resolver *r, const Node *at, const char *format, ...)
{
    char message[768];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    error_set(r->e, ERROR_INPUT, "%s", message);
    if (at && at->source) {
        error_locate(r->e, at->source, 0, 0);
    } else {
        error_locate(r->e, r->file, at ? at->line : 0, at ? at->column : 0);
    }
    return false;
}

static Node *resolve_map(Resolver *r, const Table *table, const Node *given, const char *base,
                         const Path *path);

// Names that a mapping of this kind may have; returns how many.
static int known_keys(const Table *table, int kind, const char **known)
{
    int count = 0;
    for (const Key *row = table->keys; row->key && count < MAX_KNOWN; row++) {
        if (!(row->flags & KEY_HIDDEN) && key_in_kind(row, kind)) {
            known[count++] = row->key;
        }
    }
    return count;
}

static bool unknown_key(Resolver *r, const Table *table, int kind, const Node *child,
                        const Path *path)
{
    const char *known[MAX_KNOWN];
    char hint[512];
    hint_format(child->key, known, known_keys(table, kind, known), hint, sizeof hint);
    Node at = *child;
    at.line = child->key_line;
    at.column = child->key_column;
    return resolver_fail(r, &at, "unknown key '%.60s' in %s; %s", child->key,
                         resolver_path(r, path, NULL), hint);
}

static bool check_keys_known(Resolver *r, const Table *table, const Node *given, const Path *path)
{
    for (const Node *child = given ? given->first : NULL; child; child = child->next) {
        if (!table_find(table, child->key)) {
            return unknown_key(r, table, -1, child, path);
        }
    }
    return true;
}

static bool check_keys_in_kind(Resolver *r, const Table *table, int kind, const Node *given,
                               const Path *path)
{
    for (const Node *child = given ? given->first : NULL; child; child = child->next) {
        if (key_in_kind(table_find(table, child->key), kind)) {
            continue;
        }
        const char *known[MAX_KNOWN];
        int count = known_keys(table, kind, known);
        char list[512];
        hint_list(known, count, list, sizeof list);
        Node at = *child;
        at.line = child->key_line;
        at.column = child->key_column;
        const Key *row = table_find(table, table->kind_key);
        return resolver_fail(r, &at, "key '%s' means nothing in %s of %s '%s'; known: %s",
                             child->key, resolver_path(r, path, NULL), table->kind_key,
                             enum_name(row->names, kind), list);
    }
    return true;
}

static bool missing_key(Resolver *r, const Key *row, const Node *given, const Path *path)
{
    return resolver_fail(r, given, "%s has no '%s'; it must have one: %s",
                         resolver_path(r, path, NULL), row->key, row->doc);
}

// The kind that the file names in *kind, -1 when it does not.
static bool find_kind(Resolver *r, const Table *table, const Node *given, const Path *path,
                      int *kind)
{
    *kind = -1;
    if (!table->kind_key) {
        return true;
    }
    const Key *row = table_find(table, table->kind_key);
    const Node *named = node_get(given, table->kind_key);
    if (!named) {
        return !(row->flags & KEY_REQUIRED) || missing_key(r, row, given, path);
    }
    const Node *node = resolve_value(r, row, named, path);
    if (!node) {
        return false;
    }
    *kind = (int)enum_by_name(row->names, node->text)->val;
    return true;
}

// The struct of defaults that the mapping starts from, and its kind when it has kinds.
static const char *find_base(Resolver *r, const Table *table, const Node *given, const char *base,
                             int *kind)
{
    if (table->defaults) {
        size_t size = table->defaults_size ? table->defaults_size : table->size;
        char *fresh = arena_alloc(r->arena, size, r->e);
        if (!fresh) {
            return NULL;
        }
        table->defaults(given, *kind, fresh);
        base = fresh;
    }
    if (base && table->kind_key && *kind < 0) {
        memcpy(kind, base + table_find(table, table->kind_key)->offset, sizeof *kind);
    }
    return base;
}

// "oak" for the entry that has a name, "3" for others.
static const char *entry_name(Resolver *r, const Node *entry, int index)
{
    const char *name = node_get_text(entry, "name");
    if (name && *name && strnlen(name, 64) < 64) {
        return name;
    }
    const char *number = arena_format(r->arena, r->e, "%d", index);
    return number ? number : "";
}

static Node *resolve_list(Resolver *r, const Key *row, const Node *given, const Path *path)
{
    const char *name = resolver_path(r, path, NULL);
    if (given->kind != NODE_LIST && !node_is_null(given)) {
        resolver_fail(r, given, "%s is %s; it must be a list of mappings ('- ' before each)", name,
                      node_describe(r, given));
        return NULL;
    }
    if (given->count < (int)row->low || given->count > row->count) {
        resolver_fail(r, given, "%s has %d entries; it must have %d to %d", name, given->count,
                      (int)row->low, row->count);
        return NULL;
    }
    Node *list = node_new(r->arena, NODE_LIST, r->e);
    int index = 0;
    for (const Node *entry = given->first; list && entry; entry = entry->next) {
        Path here = {path, entry_name(r, entry, index++)};
        Node *resolved = resolve_map(r, row->table, entry, NULL, &here);
        if (!resolved) {
            return NULL;
        }
        node_append(list, resolved, NULL);
    }
    return list;
}

// One key that the file gives.
static Node *resolve_given(Resolver *r, const Key *row, const Node *given, const char *base,
                           const Path *up)
{
    Path path = {up, row->key};
    switch (row->type) {
    case KEY_GROUP:
        return resolve_map(r, row->table, given, base + row->offset, &path);
    case KEY_POINTER:
        return resolve_map(r, row->table, given, NULL, &path);
    case KEY_LIST:
        return resolve_list(r, row, given, &path);
    default:
        return resolve_value(r, row, given, up);
    }
}

// One key that the file leaves out; *node stays NULL when it has no default.
static bool resolve_absent(Resolver *r, const Key *row, const char *base, const Path *up,
                           Node **node)
{
    if (row->type == KEY_GROUP) {
        Path path = {up, row->key};
        *node = resolve_map(r, row->table, NULL, base + row->offset, &path);
        return *node;
    }
    if (row->type == KEY_POINTER || row->type == KEY_LIST || (row->flags & KEY_NO_DEFAULT)) {
        return true;
    }
    return resolve_default(r, row, base, node);
}

static bool resolve_keys(Resolver *r, const Table *table, int kind, const Node *given,
                         const char *base, const Path *path, Node *map)
{
    for (const Key *row = table->keys; row->key; row++) {
        if ((row->flags & KEY_HIDDEN) || !key_in_kind(row, kind)) {
            continue;
        }
        const Node *child = node_get(given, row->key);
        Node *node = NULL;
        if (child) {
            node = resolve_given(r, row, child, base, path);
            if (!node) {
                return false;
            }
            node->line = child->line;
            node->column = child->column;
            node->source = child->source;
        } else if (row->flags & KEY_REQUIRED) {
            return missing_key(r, row, given, path);
        } else if (!resolve_absent(r, row, base, path, &node)) {
            return false;
        }
        if (node) {
            node->flags = row->flags;
            node_append(map, node, row->key);
        }
    }
    return true;
}

// given: NULL = everything by default. base: the defaults where table makes none itself.
static Node *resolve_map(Resolver *r, const Table *table, const Node *given, const char *base,
                         const Path *path)
{
    if (given && given->kind != NODE_MAP && !node_is_null(given)) {
        const char *known[MAX_KNOWN];
        char list[512];
        hint_list(known, known_keys(table, -1, known), list, sizeof list);
        resolver_fail(r, given, "%s is %s; it must be a mapping of %s",
                      resolver_path(r, path, NULL), node_describe(r, given), list);
        return NULL;
    }
    int kind;
    if (!check_keys_known(r, table, given, path) || !find_kind(r, table, given, path, &kind)) {
        return NULL;
    }
    base = find_base(r, table, given, base, &kind);
    if (!base || !check_keys_in_kind(r, table, kind, given, path)) {
        return NULL;
    }
    Node *map = node_new(r->arena, NODE_MAP, r->e);
    if (map && given) {
        map->line = given->line;
        map->column = given->column;
        map->source = given->source;
    }
    bool done = map && resolve_keys(r, table, kind, given, base, path, map) &&
                (!table->check || table->check(r, path, given, map));
    return done ? map : NULL;
}

Node *resolve_document(Resolver *r, const Table *table, const Node *document)
{
    return resolve_map(r, table, document, NULL, NULL);
}
