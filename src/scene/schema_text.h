// Shared by the JSON Schema and the reference of scene files: growing text and the defaults of a
// mapping's keys.
#ifndef RAMIFY_SCENE_SCHEMA_TEXT_H
#define RAMIFY_SCENE_SCHEMA_TEXT_H

#include "config/table.h"
#include "config/text.h"

typedef struct SchemaText {
    Text text;
    Arena *arena; // for everything but the text
} SchemaText;

// Appends formatted text, as printf.
#define schema_put(s, ...) text_put(&(s)->text, __VA_ARGS__)

// The struct of defaults for a mapping of this kind (-1: the first): the table's own, or base if
// the parent sets them. NULL = none.
const char *schema_base(SchemaText *s, const Table *table, int kind, const char *base);

// The key's default in the struct at base as text; NULL = it has none.
const char *schema_default(SchemaText *s, const Key *row, const char *base);

// The text that `write` puts, with numbers in the C locale, as heap text; NULL and e on failure.
char *schema_write(void (*write)(SchemaText *), Error *e);

#endif
