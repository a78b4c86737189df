#include "config/table.h"

#include <string.h>

const Key *rows_find(const Key *rows, const char *key)
{
    for (; rows->key; rows++) {
        if (strcmp(rows->key, key) == 0) {
            return rows;
        }
    }
    return NULL;
}

// Does a variant before number `end` have the key beside it?
static bool is_beside_earlier(const Table *table, int end, const char *key)
{
    for (int i = 0; i < end; i++) {
        if (rows_find(table->variant(i)->beside, key)) {
            return true;
        }
    }
    return false;
}

const Key *table_row(const Table *table, int index)
{
    const Key *row = table->keys;
    for (; row->key; row++) {
        if (index-- == 0) {
            return row;
        }
    }
    const Variant *variant;
    for (int i = 0; table->variant && (variant = table->variant(i)); i++) {
        if (index-- == 0) {
            return &variant->row;
        }
    }
    for (int i = 0; table->variant && (variant = table->variant(i)); i++) {
        for (row = variant->beside; row->key; row++) {
            if (!is_beside_earlier(table, i, row->key) && index-- == 0) {
                return row;
            }
        }
    }
    return NULL;
}

const Key *table_find(const Table *table, const char *key)
{
    const Key *row = rows_find(table->keys, key);
    const Variant *variant;
    for (int i = 0; !row && table->variant && (variant = table->variant(i)); i++) {
        row = strcmp(variant->row.key, key) == 0 ? &variant->row : rows_find(variant->beside, key);
    }
    return row;
}

size_t key_size(const Key *row)
{
    switch (row->type) {
    case KEY_BOOL:
        return sizeof(bool);
    case KEY_INT:
    case KEY_ENUM:
        return sizeof(int);
    case KEY_INT64:
    case KEY_UINT64:
        return sizeof(int64_t);
    case KEY_FLOAT:
        return sizeof(float);
    case KEY_DOUBLE:
        return sizeof(double);
    case KEY_NAME:
        return (size_t)row->count;
    case KEY_VECTOR:
        return sizeof(float) * (size_t)row->count;
    case KEY_COLOR:
        return sizeof(float) * 3;
    default:
        return sizeof(void *);
    }
}

bool table_defaults(const Table *table, const Node *given, int kind, void *out)
{
    if (table->kind_defaults) {
        table->kind_defaults(given, kind, out);
    } else if (table->defaults) {
        table->defaults(out);
    }
    return table->kind_defaults || table->defaults;
}

const Variant *table_variant(const Table *table, const void *params)
{
    return table->variant ? pointer_at((const char *)params + table->variant_offset) : NULL;
}

const EnumName *enum_find(const EnumName *names, const char *name)
{
    for (; names->name; names++) {
        if (strcmp(names->name, name) == 0) {
            return names;
        }
    }
    return NULL;
}

const char *enum_name(const EnumName *names, int value)
{
    for (; names->name; names++) {
        if (names->value == value) {
            return names->name;
        }
    }
    return NULL;
}

void *pointer_at(const void *member)
{
    void *pointer;
    memcpy(&pointer, member, sizeof pointer);
    return pointer;
}

void pointer_set(void *member, const void *pointer)
{
    memcpy(member, &pointer, sizeof pointer);
}

int int_at(const void *member)
{
    int value;
    memcpy(&value, member, sizeof value);
    return value;
}
