#include "config/compare.h"

#include "base/hash.h"

#include <string.h>

static bool is_text(const Key *row)
{
    return row->type == KEY_TEXT || row->type == KEY_ANY || row->type == KEY_FILE;
}

// The structs below a key and their number; for a pointer, one or none.
static const char *entries(const Key *row, const void *params, int *count)
{
    const char *first = pointer_at((const char *)params + row->offset);
    *count =
        row->type == KEY_LIST ? int_at((const char *)params + row->count_offset) : first != NULL;
    return first;
}

static bool is_given(const Key *row, const void *params)
{
    return !row->given_offset || ((const char *)params)[row->given_offset];
}

// ---- equality ----

static bool texts_equal(const char *a, const char *b)
{
    return a && b ? strcmp(a, b) == 0 : a == b;
}

static bool entries_equal(const Key *row, const void *a, const void *b)
{
    int count, other;
    const char *x = entries(row, a, &count), *y = entries(row, b, &other);
    bool same = count == other;
    for (int i = 0; same && i < count; i++, x += row->table->size, y += row->table->size) {
        same = table_equal(row->table, x, y, NULL);
    }
    return same;
}

bool key_equal(const Key *row, const void *a, const void *b)
{
    const char *x = (const char *)a + row->offset, *y = (const char *)b + row->offset;
    if (is_given(row, a) != is_given(row, b)) {
        return false;
    }
    if (is_text(row)) {
        return texts_equal(pointer_at(x), pointer_at(y));
    }
    switch (row->type) {
    case KEY_GROUP:
        return table_equal(row->table, x, y, NULL);
    case KEY_POINTER:
    case KEY_LIST:
        return entries_equal(row, a, b);
    default:
        return memcmp(x, y, key_size(row)) == 0;
    }
}

static bool keys_equal(const Key *rows, const void *a, const void *b, const char *but)
{
    for (const Key *row = rows; row->key; row++) {
        if (!(but && strcmp(row->key, but) == 0) && !key_equal(row, a, b)) {
            return false;
        }
    }
    return true;
}

bool table_equal(const Table *table, const void *a, const void *b, const char *but)
{
    const Variant *variant = table_variant(table, a);
    return variant == table_variant(table, b) && keys_equal(table->keys, a, b, but) &&
           (!variant || (key_equal(&variant->row, a, b) && keys_equal(variant->beside, a, b, but)));
}

// ---- hash ----

static uint64_t hash_text(uint64_t hash, const char *text)
{
    return text ? hash_bytes(hash, text, strlen(text) + 1) : hash_byte(hash, 0xff);
}

static uint64_t hash_key(uint64_t hash, const Key *row, const void *params)
{
    const char *member = (const char *)params + row->offset;
    hash = hash_byte(hash, is_given(row, params));
    if (is_text(row)) {
        return hash_text(hash, pointer_at(member));
    }
    switch (row->type) {
    case KEY_GROUP:
        return table_hash(hash, row->table, member, NULL);
    case KEY_POINTER:
    case KEY_LIST: {
        int count;
        const char *entry = entries(row, params, &count);
        hash = hash_bytes(hash, &count, sizeof count);
        for (int i = 0; i < count; i++, entry += row->table->size) {
            hash = table_hash(hash, row->table, entry, NULL);
        }
        return hash;
    }
    default:
        return hash_bytes(hash, member, key_size(row));
    }
}

uint64_t table_hash(uint64_t hash, const Table *table, const void *params, const char *but)
{
    const Variant *variant = table_variant(table, params);
    for (const Key *row = table->keys; row->key; row++) {
        hash = but && strcmp(row->key, but) == 0 ? hash : hash_key(hash, row, params);
    }
    if (variant) {
        hash = hash_key(hash_text(hash, variant->row.key), &variant->row, params);
        for (const Key *row = variant->beside; row->key; row++) {
            hash = hash_key(hash, row, params);
        }
    }
    return hash;
}
