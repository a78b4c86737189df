#include "config/write.h"

#include "config/scalar.h"
#include "config/text.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct Writer {
    Text text;
    const FileName *files;
    UsedValues *used;
    void *user;
} Writer;

// ---- values ----

static void put_quoted(Text *text, const char *bytes)
{
    text_put(text, "\"");
    for (const char *at = bytes; *at; at++) {
        unsigned char c = (unsigned char)*at;
        text_put(text, c < 0x20 || c == 0x7f ? "\\x%02x" : strchr("\"\\", c) ? "\\%c" : "%c", c);
    }
    text_put(text, "\"");
}

static void write_floats(const void *member, int count, char *text)
{
    float values[4];
    memcpy(values, member, sizeof(float) * (size_t)count);
    char *at = text;
    for (int i = 0; i < count; i++) {
        at = stpcpy(at, i ? ", " : "[");
        scalar_from_float(values[i], at);
        at += strlen(at);
    }
    stpcpy(at, "]");
}

void write_value(const Key *row, const void *member, char text[WRITE_VALUE_SIZE])
{
    union {
        int64_t i64;
        uint64_t u64;
        float f;
        double d;
        bool b;
    } v;
    memcpy(&v, member, key_size(row) < sizeof v ? key_size(row) : sizeof v);
    text[0] = 0;
    switch (row->type) {
    case KEY_BOOL:
        strcpy(text, v.b ? "true" : "false"); // NOLINT
        break;
    case KEY_INT:
        snprintf(text, WRITE_VALUE_SIZE, "%d", int_at(member));
        break;
    case KEY_INT64:
        snprintf(text, WRITE_VALUE_SIZE, "%" PRId64, v.i64);
        break;
    case KEY_UINT64:
        snprintf(text, WRITE_VALUE_SIZE, "%" PRIu64, v.u64);
        break;
    case KEY_FLOAT:
        scalar_from_float(v.f, text);
        break;
    case KEY_DOUBLE:
        scalar_from_double(v.d, text);
        break;
    case KEY_ENUM:
        snprintf(text, WRITE_VALUE_SIZE, "%s", enum_name(row->names, int_at(member)));
        break;
    case KEY_VECTOR:
        write_floats(member, row->count, text);
        break;
    case KEY_COLOR:
        write_floats(member, 3, text);
        break;
    default:
        break;
    }
}

static bool is_number(const Key *row)
{
    return row->type == KEY_INT || row->type == KEY_INT64 || row->type == KEY_UINT64 ||
           row->type == KEY_FLOAT || row->type == KEY_DOUBLE;
}

static void put_plain(Writer *w, const Key *row, const char *params, const char *used)
{
    char text[WRITE_VALUE_SIZE], instead[WRITE_VALUE_SIZE] = "0";
    write_value(row, params + row->offset, text);
    text_put(&w->text, " %s", text);
    if (used && is_number(row) && strcmp(text, "0") == 0) {
        write_value(row, used + row->offset, instead);
    }
    text_put(&w->text, strcmp(instead, "0") == 0 ? "\n" : " # used: %s\n", instead);
}

// The path as in the scene file, not joined to the folder.
static const char *file_text(const Writer *w, const char *path)
{
    const FileName *file = w->files;
    while (file && file->path != path) {
        file = file->next;
    }
    return file ? file->text : path;
}

static void put_text(Writer *w, const Key *row, const char *params)
{
    const char *member = params + row->offset;
    const char *text = row->type == KEY_NAME ? member : pointer_at(member);
    text_put(&w->text, " ");
    if (row->type == KEY_ANY && !params[row->count_offset]) {
        text_put(&w->text, "%s", text);
    } else {
        put_quoted(&w->text, row->type == KEY_FILE ? file_text(w, text) : text);
    }
    text_put(&w->text, "\n");
}

// ---- mappings ----

static void put_mapping(Writer *w, const Table *table, const char *params, const char *used,
                        int depth);

static const char *used_values(const Writer *w, const Table *table, const char *params)
{
    return w->used ? w->used(w->user, table, params) : NULL;
}

static void put_list(Writer *w, const Key *row, const char *params, int depth)
{
    const char *entry = pointer_at(params + row->offset);
    int count = int_at(params + row->count_offset);
    text_put(&w->text, count ? "\n" : " []\n");
    for (int i = 0; i < count; i++, entry += row->table->size) {
        text_put(&w->text, "%*s- ", 2 * depth, "");
        put_mapping(w, row->table, entry, used_values(w, row->table, entry), -(depth + 1));
    }
}

// Is the key in the file, or does it have a default?
static bool is_there(const Key *row, const char *params)
{
    if (row->flags & KEY_INSTEAD || (row->given_offset && !params[row->given_offset])) {
        return false;
    }
    switch (row->type) {
    case KEY_TEXT:
    case KEY_ANY:
    case KEY_FILE:
    case KEY_POINTER:
    case KEY_LIST:
        return pointer_at(params + row->offset);
    default:
        return true;
    }
}

static void put_key(Writer *w, const Key *row, const char *params, const char *used, int depth)
{
    const char *member = params + row->offset;
    text_put(&w->text, "%s:", row->key);
    switch (row->type) {
    case KEY_GROUP:
        text_put(&w->text, "\n");
        put_mapping(w, row->table, member, used ? used + row->offset : NULL, depth + 1);
        break;
    case KEY_POINTER:
        text_put(&w->text, "\n");
        member = pointer_at(member);
        put_mapping(w, row->table, member, used_values(w, row->table, member), depth + 1);
        break;
    case KEY_LIST:
        put_list(w, row, params, depth + 1);
        break;
    case KEY_TEXT:
    case KEY_NAME:
    case KEY_ANY:
    case KEY_FILE:
        put_text(w, row, params);
        break;
    default:
        put_plain(w, row, params, used);
    }
}

// depth < 0: an entry of a list, whose first key continues the current line.
static void put_keys(Writer *w, const Key *rows, int kind, const char *params, const char *used,
                     int *depth)
{
    for (const Key *row = rows; row->key; row++) {
        if (key_in_kind(row, kind) && is_there(row, params)) {
            text_put(&w->text, "%*s", *depth > 0 ? 2 * *depth : 0, "");
            *depth = abs(*depth);
            put_key(w, row, params, used, *depth);
        }
    }
}

static void put_mapping(Writer *w, const Table *table, const char *params, const char *used,
                        int depth)
{
    int kind = table->kind_key ? int_at(params + table_find(table, table->kind_key)->offset) : -1;
    const Variant *variant = table_variant(table, params);
    put_keys(w, table->keys, kind, params, used, &depth);
    if (variant) {
        const Key chosen[] = {variant->row, {0}};
        put_keys(w, chosen, -1, params, used, &depth);
        put_keys(w, variant->beside, -1, params, used, &depth);
    }
}

char *write_struct(const Table *table, const void *params, const FileName *files, UsedValues *used,
                   void *user, Error *e)
{
    Writer w = {.text = {.e = e}, .files = files, .used = used, .user = user};
    text_put(&w.text, "%s", "");
    put_mapping(&w, table, params, used_values(&w, table, params), 0);
    return text_take(&w.text);
}
