// What the JSON Schema and the reference of scene files share: text that grows, and the defaults of
// a mapping's keys.
#ifndef RAMIFY_SCENE_SCHEMA_TEXT_H
#define RAMIFY_SCENE_SCHEMA_TEXT_H

#include "config/table.h"
#include "config/text.h"

typedef struct SchemaText {
    Text text;
    Arena *arena; // of all that is not the text
} SchemaText;

// printf to the end of the text.
#define schema_put(s, ...) text_put(&(s)->text, __VA_ARGS__)

// The struct that a mapping of this kind (-1: the first) starts from: the table's own defaults, or,
// where its parent has them, base. NULL = none.
const char *schema_base(SchemaText *s, const Table *table, int kind, const char *base);

// The key's default in the struct at base as text; NULL = it has none.
const char *schema_default(SchemaText *s, const Key *row, const char *base);

// What write puts, with numbers in the C locale; heap text, or NULL and e.
char *schema_write(void (*write)(SchemaText *), Error *e);

#endif
