#include "config/load.h"

#include "config/hint.h"
#include "config/load_value.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define MAX_KNOWN 64

// ---- messages ----

const char *mapping_path(const Mapping *mapping, const char *key)
{
    if (!mapping->up) {
        return key ? key : "the scene";
    }
    const Loader *loader = mapping->loader;
    const char *front = mapping_path(mapping->up, mapping->key);
    const char *whole = key ? arena_format(loader->arena, loader->e, "%s.%s", front, key) : front;
    return whole ? whole : "";
}

static bool fail_at(const Loader *loader, const Node *at, int line, int column, const char *message)
{
    error_set(loader->e, ERROR_INPUT, "%s", message);
    if (at && at->source) {
        error_locate(loader->e, at->source, 0, 0);
    } else {
        error_locate(loader->e, at && at->file ? at->file : loader->file, line, column);
    }
    return false;
}

bool load_fail(const Loader *loader, const Node *at, const char *format, ...)
{
    char message[768];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    return fail_at(loader, at, at ? at->line : 0, at ? at->column : 0, message);
}

// The same for a key itself instead of its value.
static bool fail_key(const Mapping *mapping, const Node *child, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static bool fail_key(const Mapping *mapping, const Node *child, const char *format, ...)
{
    char message[768];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    return fail_at(mapping->loader, child, child->key_line, child->key_column, message);
}

// The deepest node on the path to the key that exists in the file.
static const Node *place_of(const Node *given, const char *key)
{
    const char *rest;
    return given && key ? node_follow(given, key, &rest) : given;
}

bool mapping_fail(const Mapping *mapping, const char *key, const char *format, ...)
{
    char message[768];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    return load_fail(mapping->loader, place_of(mapping->given, key), "%s%s",
                     mapping_path(mapping, key), message);
}

// ---- keys ----

// Collects the allowed keys of a mapping of this kind; returns their number.
static int known_keys(const Table *table, int kind, const char **known)
{
    int count = 0;
    const Key *row;
    for (int i = 0; (row = table_row(table, i)) && count < MAX_KNOWN; i++) {
        if (key_in_kind(row, kind)) {
            known[count++] = row->key;
        }
    }
    return count;
}

static bool check_is_mapping(const Mapping *mapping, const Table *table)
{
    const Node *given = mapping->given;
    if (!given || given->kind == NODE_MAP || node_is_null(given)) {
        return true;
    }
    const char *known[MAX_KNOWN];
    char list[512];
    hint_list(known, known_keys(table, -1, known), list, sizeof list);
    return mapping_fail(mapping, NULL, " is %s; it must be a mapping of %s",
                        node_describe(mapping->loader, given), list);
}

static bool check_keys_known(const Mapping *mapping, const Table *table)
{
    const Node *given = mapping->given;
    for (const Node *child = given ? given->first : NULL; child; child = child->next) {
        if (!table_find(table, child->key)) {
            const char *known[MAX_KNOWN];
            char hint[512];
            hint_format(child->key, known, known_keys(table, -1, known), hint, sizeof hint);
            return fail_key(mapping, child, "unknown key '%.60s' in %s; %s", child->key,
                            mapping_path(mapping, NULL), hint);
        }
    }
    return true;
}

static bool check_keys_in_kind(const Mapping *mapping, const Table *table, int kind)
{
    const Node *given = mapping->given;
    for (const Node *child = given ? given->first : NULL; child; child = child->next) {
        if (!key_in_kind(table_find(table, child->key), kind)) {
            const char *known[MAX_KNOWN];
            char list[512];
            hint_list(known, known_keys(table, kind, known), list, sizeof list);
            return fail_key(mapping, child, "key '%s' does not apply to %s of %s '%s'; known: %s",
                            child->key, mapping_path(mapping, NULL), table->kind_key,
                            enum_name(table_find(table, table->kind_key)->names, kind), list);
        }
    }
    return true;
}

static bool missing_key(const Mapping *mapping, const Key *row)
{
    return mapping_fail(mapping, NULL, " has no '%s'; this key is required: %s", row->key,
                        row->doc);
}

// ---- mappings ----

static bool load_mapping(const Mapping *mapping, const Table *table, void *out);

// "oak" for a named entry, "3" for others.
static const char *entry_name(const Loader *loader, const Node *entry, int index)
{
    const char *name = node_get_text(entry, "name");
    if (name && *name && strnlen(name, 64) < 64) {
        return name;
    }
    const char *number = arena_format(loader->arena, loader->e, "%d", index);
    return number ? number : "";
}

static bool load_list(const Mapping *list, const Key *row, char *out)
{
    const Node *given = list->given;
    if (given->kind != NODE_LIST && !node_is_null(given)) {
        return mapping_fail(list, NULL, " is %s; it must be a list of mappings ('- ' before each)",
                            node_describe(list->loader, given));
    }
    if (given->count < (int)row->low || given->count > row->count) {
        return mapping_fail(list, NULL, " has %d entries; it must have %d to %d", given->count,
                            (int)row->low, row->count);
    }
    size_t size = row->table->size;
    char *entries = arena_alloc(list->loader->arena, size * (size_t)given->count, list->loader->e);
    bool done = entries;
    int index = 0;
    for (const Node *node = given->first; done && node; node = node->next, index++) {
        Mapping entry = {list->loader, list, entry_name(list->loader, node, index), node};
        done = load_mapping(&entry, row->table, entries + size * (size_t)index);
    }
    pointer_set(out + row->offset, entries);
    memcpy(out + row->count_offset, &given->count, sizeof given->count);
    return done;
}

static bool load_pointer(const Mapping *mapping, const Key *row, char *out)
{
    Loader *loader = mapping->loader;
    void *params = arena_alloc(loader->arena, row->table->size, loader->e);
    pointer_set(out + row->offset, params);
    return params && load_mapping(mapping, row->table, params);
}

// Zeroes the members of keys that a mapping does not have.
static void clear_key(const Key *row, char *out)
{
    if (row->type == KEY_GROUP) {
        for (const Key *below = row->table->keys; below->key; below++) {
            clear_key(below, out + row->offset);
        }
    } else {
        memset(out + row->offset, 0, key_size(row));
    }
    if (row->type == KEY_LIST) {
        memset(out + row->count_offset, 0, sizeof(int));
    }
}

// Members of omitted keys already have their defaults.
static bool load_absent(const Mapping *mapping, const Key *row, char *out)
{
    if (row->flags & KEY_REQUIRED) {
        return missing_key(mapping, row);
    }
    if (row->flags & KEY_NO_DEFAULT && !(row->flags & KEY_INSTEAD)) {
        clear_key(row, out);
    }
    return true;
}

static bool load_key(const Mapping *mapping, const Key *row, char *out)
{
    const Node *given = node_get(mapping->given, row->key);
    Mapping below = {mapping->loader, mapping, row->key, given};
    if (row->given_offset) {
        out[row->given_offset] = given != NULL;
    }
    if (row->type == KEY_GROUP) {
        return load_mapping(&below, row->table, out + row->offset);
    }
    if (!given) {
        return load_absent(mapping, row, out);
    }
    switch (row->type) {
    case KEY_POINTER:
        return load_pointer(&below, row, out);
    case KEY_LIST:
        return load_list(&below, row, out);
    case KEY_ANY:
        out[row->count_offset] = given->quoted;
        return load_value(mapping, row, given, out + row->offset);
    default:
        return load_value(mapping, row, given, out + row->offset);
    }
}

static bool load_keys(const Mapping *mapping, const Key *rows, int kind, char *out)
{
    bool done = true;
    for (const Key *row = rows; done && row->key; row++) {
        if (key_in_kind(row, kind)) {
            done = load_key(mapping, row, out);
        } else {
            clear_key(row, out);
        }
    }
    return done;
}

// Sets *kind to the kind in the file, or -1 if it gives none.
static bool find_kind(const Mapping *mapping, const Table *table, int *kind)
{
    *kind = -1;
    if (!table->kind_key) {
        return true;
    }
    const Key *row = table_find(table, table->kind_key);
    const Node *named = node_get(mapping->given, table->kind_key);
    if (!named) {
        return !(row->flags & KEY_REQUIRED) || missing_key(mapping, row);
    }
    return load_value(mapping, row, named, kind);
}

// ---- variants ----

static const Variant *variant_of(const Table *table, const char *key)
{
    const Variant *variant;
    for (int i = 0; (variant = table->variant(i)); i++) {
        if (strcmp(variant->row.key, key) == 0) {
            return variant;
        }
    }
    return NULL;
}

static void say_no_variant(const Mapping *mapping, const Table *table)
{
    const char *keys[MAX_KNOWN];
    char list[512];
    int count = 0;
    const Variant *variant;
    for (; count < MAX_KNOWN && (variant = table->variant(count)); count++) {
        keys[count] = variant->row.key;
    }
    hint_list(keys, count, list, sizeof list);
    mapping_fail(mapping, NULL, " has no kind; it must have one of %s", list);
}

// The variant in the file; NULL and an error when there is none or more than one.
static const Variant *find_variant(const Mapping *mapping, const Table *table)
{
    const Variant *found = NULL;
    const Node *given = mapping->given;
    for (const Node *child = given ? given->first : NULL; child; child = child->next) {
        const Variant *variant = variant_of(table, child->key);
        if (variant && found) {
            load_fail(mapping->loader, child, "%s is both a %s and a %s; split it into two %ss",
                      mapping_path(mapping, NULL), found->row.key, child->key, table->name);
            return NULL;
        }
        found = variant ? variant : found;
    }
    if (!found) {
        say_no_variant(mapping, table);
    }
    return found;
}

// Checks that no key belongs only to other variants.
static bool check_keys_in_variant(const Mapping *mapping, const Table *table,
                                  const Variant *variant)
{
    const Node *given = mapping->given;
    for (const Node *child = given->first; child; child = child->next) {
        if (!rows_find(table->keys, child->key) && !rows_find(variant->beside, child->key) &&
            strcmp(child->key, variant->row.key) != 0) {
            return load_fail(mapping->loader, child, "%s: a %s has no %s; remove this key",
                             mapping_path(mapping, NULL), variant->row.key, child->key);
        }
    }
    return true;
}

static bool load_variant(const Mapping *mapping, const Table *table, char *out)
{
    if (!table->variant) {
        return true;
    }
    const Variant *variant = find_variant(mapping, table);
    if (!variant || !check_keys_in_variant(mapping, table, variant)) {
        return false;
    }
    pointer_set(out + table->variant_offset, variant);
    return load_key(mapping, &variant->row, out) && load_keys(mapping, variant->beside, -1, out);
}

static bool load_mapping(const Mapping *mapping, const Table *table, void *out)
{
    int kind;
    if (!check_is_mapping(mapping, table) || !check_keys_known(mapping, table) ||
        !find_kind(mapping, table, &kind)) {
        return false;
    }
    table_defaults(table, mapping->given, kind, out);
    if (table->kind_key && kind < 0) {
        kind = int_at((char *)out + table_find(table, table->kind_key)->offset);
    }
    return check_keys_in_kind(mapping, table, kind) && load_keys(mapping, table->keys, kind, out) &&
           load_variant(mapping, table, out) && (!table->check || table->check(mapping, out));
}

void *load_document(Loader *loader, const Table *table, const Node *document)
{
    Mapping root = {.loader = loader, .given = document};
    void *params = arena_alloc(loader->arena, table->size, loader->e);
    return params && load_mapping(&root, table, params) ? params : NULL;
}
