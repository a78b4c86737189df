// Writes the reference of scene files (docs/scene.md) and the list of all key paths from the tables
// of spec.h.
#include "scene/scene.h"
#include "scene/schema_cells.h"
#include "scene/schema_intro.h"

#include <string.h>

// "Only for leaf." or "Not for emission.", whichever is shorter.
static void put_kinds_of(SchemaText *s, const Table *table, const Key *row)
{
    const Key *kinds = row->kinds ? table_find(table, table->kind_key) : NULL;
    int with = 0, without = 0;
    for (const EnumName *n = kinds ? kinds->names : NULL; n && n->name; n++) {
        with += key_in_kind(row, n->value);
        without += !key_in_kind(row, n->value);
    }
    bool only = with <= without;
    const char *before = only ? " *Only for " : " *Not for ";
    for (const EnumName *n = kinds ? kinds->names : NULL; n && n->name && without; n++) {
        if (key_in_kind(row, n->value) == only) {
            schema_put(s, "%s%s", before, n->name);
            before = ", ";
        }
    }
    schema_put(s, "%s", kinds && without ? ".*" : "");
}

static void put_key(SchemaText *s, const Outline *o, const OutlineSection *section, const Key *row)
{
    const Table *table = section->table;
    schema_put(s, "| `%s` | ", row->key);
    schema_put_value(s, o, row);
    schema_put(s, " | ");
    if (row->flags & KEY_REQUIRED) {
        schema_put(s, "*required*");
    } else {
        schema_put_default(s, section, row);
    }
    schema_put(s, " | ");
    if (table->kind_key && row == table_find(table, table->kind_key)) {
        schema_put(s, "One of the kinds above.");
    } else {
        schema_put_doc(s, row, row->doc, strlen(row->doc));
    }
    put_kinds_of(s, table, row);
    schema_put(s, " |\n");
}

// Writes the part of the kind key's documentation about one kind: from its label to the next.
static void put_kind_doc(SchemaText *s, const Key *row, const char *name)
{
    for (const char *at = row->doc; *at; at++) {
        size_t length = schema_label_length(row, at);
        if (length == strlen(name) && strncmp(at, name, length) == 0) {
            const char *end = at + length + 1;
            while (*end && !schema_label_length(row, end)) {
                end++;
            }
            end -= *end ? 2 : 1; // "; " or "."
            schema_put(s, ": ");
            schema_put_doc(s, row, at + length + 2, (size_t)(end - at) - length - 2);
        }
    }
}

static void put_kinds(SchemaText *s, const Table *table)
{
    const Key *kinds = table_find(table, table->kind_key);
    schema_put(s, "`%s` selects one of:\n\n", table->kind_key);
    for (const EnumName *n = kinds->names; n->name; n++) {
        schema_put(s, "- `%s`", n->name);
        put_kind_doc(s, kinds, n->name);
        const char *before = ". Keys: ";
        for (const Key *row = table->keys; row->key; row++) {
            if (row != kinds && key_in_kind(row, n->value)) {
                schema_put(s, "%s`%s`", before, row->key);
                before = ", ";
            }
        }
        schema_put(s, ".\n");
    }
    schema_put(s, "\n");
}

static void put_places(SchemaText *s, const Outline *o, const OutlineSection *section)
{
    if (section->place_count == 1) {
        schema_put(s, "Path: `%s`.\n\n", section->places[0].path);
        return;
    }
    const char *key = section->places[0].key;
    bool list = strcmp(section->table->name, key) != 0;
    schema_put(s, "%s`%s` in ", list ? "Entry of " : "Key ", key);
    for (int i = 0; i < section->place_count; i++) {
        const OutlinePlace *place = &section->places[i];
        bool seen = false;
        for (int k = 0; k < i; k++) {
            seen |= section->places[k].parent == place->parent;
        }
        if (!seen) {
            schema_put(s, "%s", i ? ", " : "");
            const char *title = o->sections[place->parent].title;
            schema_put_link(s, title, title);
        }
        if (!seen && strcmp(place->key, key) != 0) {
            schema_put(s, " (`%s`)", place->key);
        }
    }
    schema_put(s, ".\n\n");
}

static void put_section(SchemaText *s, const Outline *o, const OutlineSection *section)
{
    const Table *table = section->table;
    schema_put(s, "\n%s %s\n\n", section->depth ? "###" : "##", section->title);
    schema_put_doc(s, NULL, table->doc, strlen(table->doc));
    schema_put(s, "\n\n");
    if (section != &o->sections[0]) {
        put_places(s, o, section);
    }
    if (table->example) {
        schema_put(s, "```yaml\n%s```\n\n", table->example);
    }
    if (table->kind_key) {
        put_kinds(s, table);
    }
    schema_put(s, "| key | value | default | what it does |\n|---|---|---|---|\n");
    const Key *row;
    for (int i = 0; (row = table_row(table, i)); i++) {
        put_key(s, o, section, row);
    }
}

static void put_contents(SchemaText *s, const Outline *o)
{
    schema_put(s, "\n## Contents\n\n");
    bool shared = false;
    for (int i = 0; i < o->count; i++) {
        const OutlineSection *section = &o->sections[i];
        if (!shared && section->place_count > 1) {
            schema_put(s, "- shared sections\n");
            shared = true;
        }
        schema_put(s, "%s- ", section->depth || shared ? "  " : "");
        schema_put_link(s, section->title, section->title);
        schema_put(s, "\n");
    }
}

static void put_reference(SchemaText *s)
{
    const Outline *o = outline_new(s);
    if (!o) {
        return;
    }
    schema_put(s, "%s", SCHEMA_INTRO);
    put_contents(s, o);
    for (int i = 0; i < o->count; i++) {
        put_section(s, o, &o->sections[i]);
    }
}

static void put_paths(SchemaText *s)
{
    const Outline *o = outline_new(s);
    for (int i = 0; o && i < o->count; i++) {
        const OutlineSection *section = &o->sections[i];
        for (int p = 0; p < section->place_count; p++) {
            const Key *row;
            for (int k = 0; (row = table_row(section->table, k)); k++) {
                if (!row->table) {
                    const char *path = section->places[p].path;
                    schema_put(s, "%s%s%s\n", path, *path ? "." : "", row->key);
                }
            }
        }
    }
}

char *scene_schema_markdown(Error *e)
{
    return schema_write(put_reference, e);
}

char *scene_schema_paths(Error *e)
{
    return schema_write(put_paths, e);
}
