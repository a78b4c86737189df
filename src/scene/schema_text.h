// What the JSON Schema and the reference of scene files share: text that grows, and the defaults of
// a mapping's keys.
#ifndef RAMIFY_SCENE_SCHEMA_TEXT_H
#define RAMIFY_SCENE_SCHEMA_TEXT_H

#include "config/resolve_value.h"

typedef struct SchemaText {
    char *text; // heap, ended by NUL once something was put
    int64_t length, capacity;
    Resolver resolver; // its arena holds all that is not the text
    bool failed;
} SchemaText;

// printf to the end of the text; sets failed when memory is short.
void schema_put(SchemaText *s, const char *format, ...) __attribute__((format(printf, 2, 3)));

// The struct that a mapping of this kind (-1: the first) starts from: the table's own defaults, or,
// where its parent has them, base. NULL = none.
const char *schema_base(SchemaText *s, const Table *table, int kind, const char *base);

// The key's default in the struct at base; NULL = it has none.
const Node *schema_default(SchemaText *s, const Key *row, const char *base);

// What write puts, with numbers in the C locale; heap text, or NULL and e.
char *schema_write(void (*write)(SchemaText *), Error *e);

#endif
