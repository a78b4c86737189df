#include "config/table.h"

#include <string.h>

const Key *table_find(const Table *table, const char *key)
{
    for (const Key *row = table->keys; row->key; row++) {
        if (!(row->flags & KEY_HIDDEN) && strcmp(row->key, key) == 0) {
            return row;
        }
    }
    return NULL;
}

const cyaml_strval_t *enum_by_name(const cyaml_strval_t *names, const char *name)
{
    for (; names->str; names++) {
        if (strcmp(names->str, name) == 0) {
            return names;
        }
    }
    return NULL;
}

const char *enum_name(const cyaml_strval_t *names, int64_t value)
{
    for (; names->str; names++) {
        if (names->val == value) {
            return names->str;
        }
    }
    return NULL;
}
