#include "config/load.h"

#include "base/vec.h"
#include "config/emit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// ---- the schema ----

typedef struct Builder {
    Arena *arena;
    Error *e;
} Builder;

static bool table_value(const Builder *b, const Table *table, unsigned flags,
                        cyaml_schema_value_t *value);

static cyaml_schema_value_t plain_value(cyaml_type_e type, size_t size, unsigned flags)
{
    return (cyaml_schema_value_t){
        .type = type, .flags = (cyaml_flag_e)flags, .data_size = (uint32_t)size};
}

// A fixed sequence of entries of size bytes each.
static bool fixed_sequence(const Builder *b, cyaml_schema_value_t entry, size_t size, int count,
                           unsigned flags, cyaml_schema_value_t *value)
{
    cyaml_schema_value_t *kept = arena_alloc(b->arena, sizeof *kept, b->e);
    if (kept) {
        *kept = entry;
        *value = plain_value(CYAML_SEQUENCE_FIXED, size, flags);
        value->sequence.entry = kept;
        value->sequence.min = value->sequence.max = (uint32_t)count;
    }
    return kept;
}

static bool vector_value(const Builder *b, const Key *row, unsigned flags,
                         cyaml_schema_value_t *value)
{
    cyaml_schema_value_t number = plain_value(CYAML_FLOAT, sizeof(float), CYAML_FLAG_DEFAULT);
    if (row->type != KEY_AFFINE) {
        int count = row->type == KEY_COLOR ? 3 : row->count;
        return fixed_sequence(b, number, sizeof(float), count, flags, value);
    }
    cyaml_schema_value_t rows;
    return fixed_sequence(b, number, sizeof(float), 4, CYAML_FLAG_DEFAULT, &rows) &&
           fixed_sequence(b, rows, 4 * sizeof(float), 3, flags, value);
}

static bool list_value(const Builder *b, const Key *row, unsigned flags,
                       cyaml_schema_value_t *value)
{
    cyaml_schema_value_t *entry = arena_alloc(b->arena, sizeof *entry, b->e);
    if (!entry || !table_value(b, row->table, CYAML_FLAG_DEFAULT, entry)) {
        return false;
    }
    *value = plain_value(CYAML_SEQUENCE, row->table->size, flags | CYAML_FLAG_POINTER);
    value->sequence.entry = entry;
    value->sequence.max = CYAML_UNLIMITED;
    return true;
}

static void text_value(const Key *row, unsigned flags, cyaml_schema_value_t *value)
{
    if (row->type == KEY_NAME) {
        *value = plain_value(CYAML_STRING, (size_t)row->count, flags);
        value->string.max = (uint32_t)row->count - 1;
    } else {
        *value = plain_value(CYAML_STRING, 1, flags | CYAML_FLAG_POINTER);
        value->string.max = CYAML_UNLIMITED;
    }
}

static void enum_value(const Key *row, unsigned flags, cyaml_schema_value_t *value)
{
    *value = plain_value(CYAML_ENUM, sizeof(int), flags | CYAML_FLAG_STRICT);
    value->enumeration.strings = row->names;
    while (row->names[value->enumeration.count].str) {
        value->enumeration.count++;
    }
}

static bool key_value(const Builder *b, const Key *row, cyaml_schema_value_t *value)
{
    unsigned flags = CYAML_FLAG_OPTIONAL;
    switch (row->type) {
    case KEY_BOOL:
        *value = plain_value(CYAML_BOOL, sizeof(bool), flags);
        return true;
    case KEY_INT:
        *value = plain_value(CYAML_INT, sizeof(int), flags);
        return true;
    case KEY_INT64:
        *value = plain_value(CYAML_INT, sizeof(int64_t), flags);
        return true;
    case KEY_UINT64:
        *value = plain_value(CYAML_UINT, sizeof(uint64_t), flags);
        return true;
    case KEY_FLOAT:
        *value = plain_value(CYAML_FLOAT, sizeof(float), flags);
        return true;
    case KEY_DOUBLE:
        *value = plain_value(CYAML_FLOAT, sizeof(double), flags);
        return true;
    case KEY_ENUM:
        enum_value(row, flags, value);
        return true;
    case KEY_TEXT:
    case KEY_ANY:
    case KEY_FILE:
    case KEY_NAME:
        text_value(row, flags, value);
        return true;
    case KEY_VECTOR:
    case KEY_COLOR:
    case KEY_AFFINE:
        return vector_value(b, row, flags, value);
    case KEY_GROUP:
        return table_value(b, row->table, flags, value);
    case KEY_POINTER:
        return table_value(b, row->table, flags | CYAML_FLAG_POINTER, value);
    case KEY_LIST:
        return list_value(b, row, flags, value);
    }
    return false;
}

static bool table_value(const Builder *b, const Table *table, unsigned flags,
                        cyaml_schema_value_t *value)
{
    size_t count = 1;
    for (const Key *row = table->keys; row->key; row++) {
        count++;
    }
    cyaml_schema_field_t *fields = arena_alloc(b->arena, sizeof *fields * count, b->e);
    if (!fields) {
        return false;
    }
    *value = plain_value(CYAML_MAPPING, table->size, flags);
    value->mapping.fields = fields;
    for (const Key *row = table->keys; row->key; row++) {
        if (row->flags & KEY_VIRTUAL) {
            continue;
        }
        fields->key = row->key;
        fields->data_offset = (uint32_t)row->offset;
        fields->count_offset = (uint32_t)row->count_offset;
        fields->count_size = row->type == KEY_LIST ? sizeof(int) : 0;
        if (!key_value(b, row, &fields->value)) {
            return false;
        }
        fields++;
    }
    return true;
}

// ---- loading ----

// Keeps the first message.
static void keep_message(cyaml_log_t level, void *context, const char *format, va_list arguments)
{
    char *message = context;
    if (level >= CYAML_LOG_ERROR && !message[0]) {
        vsnprintf(message, 256, format, arguments); // NOLINT
        message[strcspn(message, "\n")] = 0;
    }
}

static void *allocate(void *context, void *memory, size_t size)
{
    (void)context;
    if (size == 0) {
        free(memory);
        return NULL;
    }
    return realloc(memory, size);
}

void *load_struct(const Table *table, const Node *document, Arena *arena, Error *e)
{
    Builder builder = {arena, e};
    cyaml_schema_value_t schema;
    size_t length;
    if (!table_value(&builder, table, CYAML_FLAG_POINTER, &schema)) {
        return NULL;
    }
    char *text = emit_yaml(document, EMIT_LOADABLE, &length, e);
    if (!text) {
        return NULL;
    }
    char message[256] = "";
    cyaml_config_t config = {.log_fn = keep_message,
                             .log_ctx = message,
                             .mem_fn = allocate,
                             .log_level = CYAML_LOG_ERROR,
                             .flags = CYAML_CFG_NO_ALIAS};
    cyaml_data_t *data = NULL;
    cyaml_err_t code =
        cyaml_load_data((const uint8_t *)text, length, &config, &schema, &data, NULL);
    free(text);
    if (code != CYAML_OK) {
        error_set(e, code == CYAML_ERR_OOM ? ERROR_MEMORY : ERROR_INTERNAL,
                  "libcyaml would not load the checked scene: %s (%s)", cyaml_strerror(code),
                  message);
        return NULL;
    }
    return data;
}

// ---- freeing ----

static void *pointer_at(const char *at)
{
    void *pointer;
    memcpy(&pointer, at, sizeof pointer);
    return pointer;
}

void load_clear(const Table *table, void *structure)
{
    char *base = structure;
    for (const Key *row = table->keys; row->key; row++) {
        if (row->type == KEY_GROUP) {
            load_clear(row->table, base + row->offset);
        }
        bool owned = row->type == KEY_TEXT || row->type == KEY_ANY || row->type == KEY_FILE ||
                     row->type == KEY_LIST || row->type == KEY_POINTER;
        if (!owned || row->flags & KEY_VIRTUAL) {
            continue;
        }
        char *below = pointer_at(base + row->offset);
        int count = row->type == KEY_POINTER && below ? 1 : 0;
        if (row->type == KEY_LIST) {
            memcpy(&count, base + row->count_offset, sizeof count);
        }
        for (int i = 0; below && i < count; i++) {
            load_clear(row->table, below + (size_t)i * row->table->size);
        }
        free(below);
    }
}
