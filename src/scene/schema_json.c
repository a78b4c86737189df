// The JSON Schema (draft 2020-12) of scene files, written from the tables of spec.h.
#include "scene/scene.h"
#include "scene/schema_text.h"
#include "scene/spec.h"

#include <stdio.h>

#define MOST_TABLES 96

typedef struct Writer {
    SchemaText *text;
    const Table *shared[MOST_TABLES]; // tables written to $defs, in the order of first use
    int shared_count;
} Writer;

#define put(w, ...) schema_put((w)->text, __VA_ARGS__)

static void put_escaped(Writer *w, const char *text)
{
    for (; *text; text++) {
        put(w, *text == '"' || *text == '\\' ? "\\%c" : "%c", *text);
    }
}

static void put_string(Writer *w, const char *text)
{
    put(w, "\"");
    put_escaped(w, text);
    put(w, "\"");
}

// The documentation, followed by the unit and the kinds.
static void put_description(Writer *w, const Table *table, const Key *row)
{
    put(w, "\"description\": \"");
    put_escaped(w, row->doc);
    if (row->unit) {
        put(w, " Unit: ");
        put_escaped(w, row->unit);
        put(w, ".");
    }
    if (row->kinds) {
        const Key *kind = table_find(table, table->kind_key);
        put(w, " Only for %s", table->kind_key);
        const char *before = " ";
        for (const EnumName *n = kind->names; n->name; n++) {
            if (row->kinds >> n->value & 1u) {
                put(w, "%s%s", before, n->name);
                before = ", ";
            }
        }
        put(w, ".");
    }
    put(w, "\"");
}

static void put_range(Writer *w, const Key *row)
{
    if (row->low == 0.0 && row->high == 0.0) {
        return;
    }
    put(w, ", \"%s\": %.17g, \"%s\": %.17g",
        row->flags & KEY_ABOVE ? "exclusiveMinimum" : "minimum", row->low,
        row->flags & KEY_BELOW ? "exclusiveMaximum" : "maximum", row->high);
}

static void put_number(Writer *w, const Key *row, const char *type)
{
    put(w, "{\"type\": \"%s\"", type);
    put_range(w, row);
    put(w, "}");
}

static void put_vector(Writer *w, const Key *row)
{
    int count = row->type == KEY_COLOR ? 3 : row->count;
    bool splat = row->type == KEY_COLOR || row->flags & KEY_SPLAT;
    put(w, ", ");
    if (splat) {
        put(w, "\"anyOf\": [");
        put_number(w, row, "number");
        put(w, ", {");
    }
    put(w, "\"type\": \"array\", \"minItems\": %d, \"maxItems\": %d, \"items\": ", count, count);
    put_number(w, row, "number");
    if (row->type == KEY_COLOR) {
        put(w, "}, {\"type\": \"string\", \"pattern\": \"^#[0-9a-fA-F]{6}$\"");
    }
    put(w, splat ? "}]" : "");
}

static void put_enum(Writer *w, const Key *row)
{
    put(w, ", \"enum\": [");
    for (const EnumName *n = row->names; n->name; n++) {
        put(w, n == row->names ? "\"%s\"" : ", \"%s\"", n->name);
    }
    put(w, "]");
}

static void put_default(Writer *w, const Key *row, const char *base)
{
    const char *text = schema_default(w->text, row, base);
    if (text) {
        put(w, row->type == KEY_ENUM ? ", \"default\": \"%s\"" : ", \"default\": %s", text);
    }
}

static void share(Writer *w, const Table *table)
{
    for (int i = 0; i < w->shared_count; i++) {
        if (w->shared[i] == table) {
            return;
        }
    }
    if (w->shared_count == MOST_TABLES) {
        w->text->text.failed = true;
        return;
    }
    w->shared[w->shared_count++] = table;
}

static void put_table(Writer *w, const Table *table, const char *base, int depth);

static void put_key(Writer *w, const Table *table, const Key *row, const char *base, int depth)
{
    put(w, "{");
    put_description(w, table, row);
    switch (row->type) {
    case KEY_BOOL:
        put(w, ", \"type\": \"boolean\"");
        break;
    case KEY_INT:
    case KEY_INT64:
    case KEY_UINT64:
        put(w, ", \"type\": \"integer\"");
        put_range(w, row);
        break;
    case KEY_FLOAT:
    case KEY_DOUBLE:
        put(w, ", \"type\": \"number\"");
        put_range(w, row);
        break;
    case KEY_ENUM:
        put_enum(w, row);
        break;
    case KEY_TEXT:
    case KEY_FILE:
    case KEY_NAME:
        put(w, ", \"type\": \"string\", \"minLength\": 1");
        break;
    case KEY_ANY:
        put(w,
            ", \"type\": [\"number\", \"boolean\", \"string\", \"array\"], "
            "\"items\": {\"type\": \"number\"}, \"maxItems\": %d",
            row->count);
        break;
    case KEY_GROUP:
        put(w, ", ");
        put_table(w, row->table, base ? base + row->offset : NULL, depth);
        put(w, "}");
        return;
    case KEY_POINTER:
        share(w, row->table);
        put(w, ", \"$ref\": \"#/$defs/%s\"", row->table->name);
        break;
    case KEY_LIST:
        share(w, row->table);
        put(w, ", \"type\": \"array\", \"minItems\": %d, \"maxItems\": %d, ", (int)row->low,
            row->count);
        put(w, "\"items\": {\"$ref\": \"#/$defs/%s\"}", row->table->name);
        break;
    default:
        put_vector(w, row);
    }
    if (row->type != KEY_POINTER && row->type != KEY_LIST) {
        put_default(w, row, base);
    }
    put(w, "}");
}

static void put_required(Writer *w, const Table *table)
{
    int count = 0;
    const Key *row;
    for (int i = 0; (row = table_row(table, i)); i++) {
        if (row->flags & KEY_REQUIRED && !row->kinds) {
            put(w, "%s\"%s\"", count++ ? ", " : ", \"required\": [", row->key);
        }
    }
    put(w, count ? "]" : "");
}

// Puts the members of an object schema, without braces.
static void put_table(Writer *w, const Table *table, const char *base, int depth)
{
    base = schema_base(w->text, table, -1, base);
    put(w, "\"type\": [\"object\", \"null\"], \"additionalProperties\": false");
    put_required(w, table);
    put(w, ", \"properties\": {");
    const char *before = "";
    const Key *row;
    for (int i = 0; (row = table_row(table, i)); i++) {
        put(w, "%s\n%*s\"%s\": ", before, 2 * depth, "", row->key);
        put_key(w, table, row, base, depth + 1);
        before = ",";
    }
    put(w, "}");
}

static void put_schema(SchemaText *text)
{
    Writer writer = {.text = text}, *w = &writer;
    put(w, "{\n  \"$schema\": \"https://json-schema.org/draft/2020-12/schema\",\n"
           "  \"title\": \"ramify scene\",\n  \"description\": ");
    put_string(w, scene_table.doc);
    put(w, ",\n  ");
    put_table(w, &scene_table, NULL, 2);
    put(w, ",\n  \"$defs\": {");
    for (int i = 0; i < w->shared_count; i++) { // the list grows while tables are written
        put(w, "%s\n    \"%s\": {\"description\": ", i ? "," : "", w->shared[i]->name);
        put_string(w, w->shared[i]->doc);
        put(w, ", ");
        put_table(w, w->shared[i], NULL, 3);
        put(w, "}");
    }
    put(w, "\n  }\n}\n");
}

char *scene_schema_json(Error *e)
{
    return schema_write(put_schema, e);
}
