#include "scene/schema_cells.h"

#include "scene/scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOST_DEFAULTS 16

typedef struct Default {
    const char *text;
    char where[512]; // places or kinds with this default
    int count;
} Default;

size_t schema_label_length(const Key *row, const char *at)
{
    if (at > row->doc && at[-1] != ' ') {
        return 0;
    }
    for (const EnumName *n = row->names; n && n->name; n++) {
        size_t length = strlen(n->name);
        if (strncmp(at, n->name, length) == 0 && at[length] == ':') {
            return length;
        }
    }
    return 0;
}

void schema_put_doc(SchemaText *s, const Key *row, const char *doc, size_t count)
{
    for (const char *at = doc; at < doc + count && *at; at++) {
        size_t label = row ? schema_label_length(row, at) : 0;
        if (label > 0) {
            schema_put(s, "`%.*s`", (int)label, at);
            at += label - 1;
        } else {
            schema_put(s, strchr("|<*", *at) ? "\\%c" : "%c", *at);
        }
    }
}

void schema_put_link(SchemaText *s, const char *text, const char *title)
{
    schema_put(s, "[%s](#", text);
    for (; *title; title++) {
        schema_put(s, "%c", *title == ' ' ? '-' : *title);
    }
    schema_put(s, ")");
}

static const char *section_title(const Outline *o, const Table *table)
{
    for (int i = 0; i < o->count; i++) {
        if (o->sections[i].table == table) {
            return o->sections[i].title;
        }
    }
    return table->name;
}

// Writes numbers from 1e6 on as powers of ten if that is exact, which is easier to read.
static void put_number(SchemaText *s, double value)
{
    char text[32];
    snprintf(text, sizeof text, "%.0e", value);
    if (fabs(value) >= 1e6 && strtod(text, NULL) == value) {
        schema_put(s, "%.*se%d", (int)strcspn(text, "e"), text, atoi(strchr(text, 'e') + 1));
    } else {
        schema_put(s, "%.15g", value);
    }
}

// Puts "0 to 90 degrees", "above 0, below 1"; first: text before it.
static void put_range(SchemaText *s, const Key *row, const char *first)
{
    bool open = row->low == 0.0 && row->high == 0.0;
    if (row->type == KEY_UINT64) {
        schema_put(s, "%s0 or more", first);
    } else if (!open) {
        bool above = row->flags & KEY_ABOVE, below = row->flags & KEY_BELOW;
        schema_put(s, "%s%s", first, above ? "above " : below ? "from " : "");
        put_number(s, row->low);
        schema_put(s, "%s", below ? ", below " : above ? ", up to " : " to ");
        put_number(s, row->high);
    }
    if (row->unit) {
        schema_put(s, "%s%s", open ? ", in " : " ", row->unit);
    }
}

static void put_names(SchemaText *s, const Key *row)
{
    for (const EnumName *n = row->names; n->name; n++) {
        schema_put(s, "%s`%s`", n == row->names ? "" : ", ", n->name);
    }
}

static void put_vector(SchemaText *s, const Key *row)
{
    static const char *const SPELLED[] = {"", "", "[a, b]", "[x, y, z]", "[a, b, c, d]"};
    schema_put(s, "%s%s", row->flags & KEY_SPLAT ? "number or " : "", SPELLED[row->count]);
    put_range(s, row, ", each ");
}

void schema_put_value(SchemaText *s, const Outline *o, const Key *row)
{
    switch (row->type) {
    case KEY_BOOL:
        schema_put(s, "true or false");
        break;
    case KEY_INT:
    case KEY_INT64:
    case KEY_UINT64:
        schema_put(s, "whole number");
        put_range(s, row, ", ");
        break;
    case KEY_FLOAT:
    case KEY_DOUBLE:
        schema_put(s, "number");
        put_range(s, row, ", ");
        break;
    case KEY_ENUM:
        put_names(s, row);
        break;
    case KEY_TEXT:
    case KEY_NAME:
        schema_put(s, "text");
        break;
    case KEY_ANY:
        schema_put(s, "number, word or list of at most %d numbers", row->count);
        break;
    case KEY_FILE:
        schema_put(s, "file");
        break;
    case KEY_COLOR:
        schema_put(s, "colour");
        put_range(s, row, ", each ");
        break;
    case KEY_GROUP:
    case KEY_POINTER:
        schema_put_link(s, section_title(o, row->table), section_title(o, row->table));
        break;
    case KEY_LIST:
        schema_put_link(s, "list", section_title(o, row->table));
        break;
    default:
        put_vector(s, row);
    }
}

static const char *default_text(SchemaText *s, const Key *row, const char *base)
{
    const char *text = schema_default(s, row, base);
    bool open = text && row->type == KEY_DOUBLE && fabs(strtod(text, NULL)) >= TARGET_NO_BOUND;
    return text && !open ? text : "";
}

static void add_default(Default *found, int *count, const char *text, const char *where)
{
    int i = 0;
    while (i < *count && strcmp(found[i].text, text) != 0) {
        i++;
    }
    if (i == MOST_DEFAULTS) {
        return;
    }
    if (i == *count) {
        found[(*count)++] = (Default){.text = text};
    }
    size_t used = strlen(found[i].where);
    snprintf(found[i].where + used, sizeof found[i].where - used, "%s%s", used ? ", " : "", where);
    found[i].count++;
}

// Title of the parent place: "tree crown" for "tree crown points".
static const char *holder_title(SchemaText *s, const OutlinePlace *place)
{
    const char *last = strrchr(place->title, ' ');
    size_t length = last ? (size_t)(last - place->title) : strlen(place->title);
    const char *title = arena_text(s->arena, place->title, length, s->text.e);
    s->text.failed |= !title;
    return title ? title : "";
}

// Tables with kinds set their own defaults, equal in all places; other defaults differ by place.
static int find_defaults(SchemaText *s, const OutlineSection *section, const Key *row,
                         Default *found)
{
    const Table *table = section->table;
    const Key *kinds = table->kind_key ? table_find(table, table->kind_key) : NULL;
    int count = 0;
    if (kinds && row != kinds && table->kind_defaults) {
        for (const EnumName *n = kinds->names; n->name; n++) {
            if (key_in_kind(row, n->value)) {
                const char *base = schema_base(s, table, n->value, NULL);
                add_default(found, &count, default_text(s, row, base), n->name);
            }
        }
        return count;
    }
    for (int i = 0; i < section->place_count; i++) {
        const OutlinePlace *place = &section->places[i];
        add_default(found, &count, default_text(s, row, place->base), holder_title(s, place));
    }
    return count;
}

void schema_put_default(SchemaText *s, const OutlineSection *section, const Key *row)
{
    Default found[MOST_DEFAULTS];
    int count = find_defaults(s, section, row, found), most = 0;
    for (int i = 1; i < count; i++) {
        most = found[i].count > found[most].count ? i : most;
    }
    if (count > 0 && *found[most].text) {
        schema_put(s, "`%s`", found[most].text);
    }
    for (int i = 0; i < count; i++) {
        if (i != most) {
            bool none = !*found[i].text;
            schema_put(s, "<br>%s: %s%s%s", found[i].where, none ? "none" : "`", found[i].text,
                       none ? "" : "`");
        }
    }
}
