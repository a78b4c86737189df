#include "scene/schema_outline.h"

#include "scene/spec.h"

#include <string.h>

// Readable form of a path: "tree trunk" for "objects.NAME.tree.trunk"; for a list's entry, the
// list.
static const char *title_of(SchemaText *s, const char *path)
{
    const char *prefix = "objects.NAME.";
    path += strncmp(path, prefix, strlen(prefix)) == 0 ? strlen(prefix) : 0;
    const char *title = "";
    while (*path && title) {
        size_t length = strcspn(path, ".");
        if (strncmp(path, "NAME", length) != 0 && strncmp(path, "N", length) != 0) {
            title = arena_format(s->arena, s->text.e, "%s%s%.*s", title, *title ? " " : "",
                                 (int)length, path);
        }
        path += length + (path[length] == '.');
    }
    s->text.failed |= !title;
    return title ? title : "";
}

static const char *child_path(SchemaText *s, const char *path, const Key *row)
{
    bool named = row->type == KEY_LIST && table_find(row->table, "name");
    const char *entry = row->type != KEY_LIST ? "" : named ? ".NAME" : ".N";
    return arena_format(s->arena, s->text.e, "%s%s%s%s", path, *path ? "." : "", row->key, entry);
}

static int section_of(Outline *o, const Table *table)
{
    for (int i = 0; i < o->count; i++) {
        if (o->sections[i].table == table) {
            return i;
        }
    }
    if (o->count == OUTLINE_MOST_SECTIONS) {
        return -1;
    }
    o->sections[o->count] = (OutlineSection){.table = table};
    return o->count++;
}

static void visit(SchemaText *s, Outline *o, const Table *table, OutlinePlace place)
{
    int index = section_of(o, table);
    if (index < 0 || !place.path || o->sections[index].place_count == OUTLINE_MOST_PLACES) {
        s->text.failed = true;
        return;
    }
    OutlineSection *section = &o->sections[index];
    place.base = schema_base(s, table, -1, place.base);
    place.title = title_of(s, place.path);
    section->places[section->place_count++] = place;
    const Key *row;
    for (int i = 0; (row = table_row(table, i)); i++) {
        if (row->table) {
            bool inside = row->type == KEY_GROUP && place.base;
            visit(s, o, row->table,
                  (OutlinePlace){.path = child_path(s, place.path, row),
                                 .key = row->key,
                                 .parent = index,
                                 .base = inside ? place.base + row->offset : NULL});
        }
    }
}

// Moves sections with several places to the end and renumbers the parents.
static void sort_sections(const Outline *from, Outline *to)
{
    int where[OUTLINE_MOST_SECTIONS] = {0};
    for (int shared = 0; shared < 2; shared++) {
        for (int i = 0; i < from->count; i++) {
            if ((from->sections[i].place_count > 1) == shared) {
                where[i] = to->count;
                to->sections[to->count++] = from->sections[i];
            }
        }
    }
    for (int i = 0; i < to->count; i++) {
        OutlineSection *section = &to->sections[i];
        const OutlinePlace *first = &section->places[0];
        bool shared = section->place_count > 1;
        section->title = shared ? first->key : *first->path ? first->title : "scene";
        section->depth = !shared && strchr(section->title, ' ') != NULL;
        for (int p = 0; p < section->place_count; p++) {
            int parent = section->places[p].parent;
            section->places[p].parent = parent < 0 ? -1 : where[parent];
        }
    }
}

Outline *outline_new(SchemaText *s)
{
    Outline *met = arena_alloc(s->arena, sizeof *met, s->text.e);
    Outline *sorted = arena_alloc(s->arena, sizeof *sorted, s->text.e);
    if (!met || !sorted) {
        s->text.failed = true;
        return NULL;
    }
    visit(s, met, &scene_table, (OutlinePlace){.path = "", .key = "", .parent = -1});
    sort_sections(met, sorted);
    return s->text.failed ? NULL : sorted;
}
