#include "scene/species_size.h"

#include "config/scalar.h"

#include <string.h>

enum { NUMBER_SIZE = 32 };

// What is as large as the tree; leaves, bark and the tips of twigs are not. Of light only the part:
// its other lengths are the species'.
static const struct {
    const char *name, *part; // part: NULL = the whole group
} GROUPS[] = {{"trunk", NULL}, {"crown", NULL}, {"roots", NULL}, {"light", "attractors"}};
enum { GROUP_COUNT = sizeof GROUPS / sizeof *GROUPS };

static Node *group_of(const Node *species, size_t i)
{
    Node *group = node_get(species, GROUPS[i].name);
    return GROUPS[i].part ? node_get(group, GROUPS[i].part) : group;
}

static bool number_of(const Node *node, double *value)
{
    return node && node->kind == NODE_SCALAR && !node->quoted && scalar_number(node->text, value);
}

static bool scale_number(Node *node, double factor, Arena *arena, Error *e)
{
    double value;
    char text[NUMBER_SIZE];
    if (!number_of(node, &value)) { // an error that loading reports
        return true;
    }
    scalar_from_double(value * factor, text);
    node->text = arena_text(arena, text, strlen(text), e);
    return node->text;
}

static bool scale_value(Node *value, double factor, Arena *arena, Error *e)
{
    bool done = value->kind != NODE_SCALAR || scale_number(value, factor, arena, e);
    for (Node *item = value->first; done && item; item = item->next) {
        done = scale_number(item, factor, arena, e);
    }
    return done;
}

static bool scale_map(const Table *table, Node *map, double factor, Arena *arena, Error *e);

static bool scale_key(const Key *row, Node *value, double factor, Arena *arena, Error *e)
{
    if (row->table && value->kind == NODE_MAP) {
        return scale_map(row->table, value, factor, arena, e);
    }
    bool done = true;
    for (Node *entry = value->first; row->table && done && entry; entry = entry->next) {
        done = entry->kind != NODE_MAP || scale_map(row->table, entry, factor, arena, e);
    }
    bool is_length = row->unit && strcmp(row->unit, "m") == 0;
    return done && (!is_length || row->table || scale_value(value, factor, arena, e));
}

static bool scale_map(const Table *table, Node *map, double factor, Arena *arena, Error *e)
{
    bool done = true;
    for (Node *value = map->first; done && value; value = value->next) {
        const Key *row = table_find(table, value->key);
        done = !row || scale_key(row, value, factor, arena, e);
    }
    return done;
}

static bool scale_group(const Table *table, const Node *species, size_t i, double factor,
                        Arena *arena, Error *e)
{
    Node *group = group_of(species, i);
    const Key *row = table_find(table, GROUPS[i].name);
    row = row && row->table && GROUPS[i].part ? table_find(row->table, GROUPS[i].part) : row;
    return !group || !row || scale_key(row, group, factor, arena, e);
}

// A tree that grows by light has its height there.
static const Node *height_of(const Node *species)
{
    const Node *height = node_get(species, "height");
    return height ? height : node_get(node_get(species, "light"), "mature_height");
}

bool species_fit_size(const Table *table, const Node *given, Node *species, Arena *arena, Error *e)
{
    double wanted, own;
    if (!number_of(node_get(given, "height"), &wanted) || !number_of(height_of(species), &own) ||
        wanted == own || !(own > 0.0)) {
        return true;
    }
    bool done = true;
    for (size_t i = 0; done && i < GROUP_COUNT; i++) {
        done = scale_group(table, species, i, wanted / own, arena, e);
    }
    return done;
}

// ---- place

// A list of three numbers.
static bool vector_of(const Node *node, double value[3])
{
    bool done = node && node->kind == NODE_LIST && node->count == 3;
    const Node *item = done ? node->first : NULL;
    for (int i = 0; done && i < 3; i++, item = item->next) {
        done = number_of(item, &value[i]);
    }
    return done;
}

static bool set_vector(Node *node, const double value[3], Arena *arena, Error *e)
{
    Node *item = node->first;
    for (int i = 0; i < 3; i++, item = item->next) {
        char text[NUMBER_SIZE];
        scalar_from_double(value[i], text);
        item->text = arena_text(arena, text, strlen(text), e);
        if (!item->text) {
            return false;
        }
    }
    return true;
}

// A position [0, 0, 0] for an entry that has none.
static Node *add_position(Node *entry, Arena *arena, Error *e)
{
    Node *list = node_new(arena, NODE_LIST, e);
    for (int i = 0; list && i < 3; i++) {
        Node *zero = node_scalar(arena, "0", e);
        if (!zero) {
            return NULL;
        }
        node_append(list, zero, NULL);
    }
    if (list) {
        node_append(entry, list, "position");
    }
    return list;
}

static bool move_entry(Node *entry, const double by[3], Arena *arena, Error *e)
{
    double own[3];
    Node *position = node_get(entry, "position");
    if (entry->kind != NODE_MAP || (position && !vector_of(position, own))) {
        return true; // an error that loading reports
    }
    position = position ? position : add_position(entry, arena, e);
    if (!position || !vector_of(position, own)) {
        return false;
    }
    for (int i = 0; i < 3; i++) {
        own[i] += by[i];
    }
    return set_vector(position, own, arena, e);
}

bool species_fit_place(const Node *given, Node *species, Arena *arena, Error *e)
{
    static const char *const LISTS[] = {"envelope", "fields"};
    double by[3];
    bool done = true;
    if (!vector_of(node_get(given, "position"), by)) {
        return true;
    }
    for (size_t i = 0; i < GROUP_COUNT; i++) {
        for (size_t k = 0; k < sizeof LISTS / sizeof *LISTS; k++) {
            Node *list = node_get(group_of(species, i), LISTS[k]);
            for (Node *entry = list ? list->first : NULL; done && entry; entry = entry->next) {
                done = move_entry(entry, by, arena, e);
            }
        }
    }
    return done;
}
