#include "scene/species.h"

#include "config/scalar.h"
#include "config/yaml.h"
#include "objects/kind.h"
#include "scene/species_file.h"
#include "scene/species_size.h"

#include <string.h>

enum { MOST_VALUES = 1000000, MOST_STEPS = 8 };

// A file whose materials the scene has already.
typedef struct Used {
    struct Used *next;
    const char *stem, *path, *text;
} Used;

typedef struct Applier {
    Node *root;
    const char *file, *folder; // of the scene
    Arena *arena;
    int budget;
    Used *used;
    Error *e;
} Applier;

// An object's mapping of its kind and the kind's table.
typedef struct Subject {
    Node *object, *params;
    const Table *table;
} Subject;

static bool fail_at(const Applier *a, const Node *node)
{
    if (node->source) {
        error_locate(a->e, node->source, 0, 0);
    } else {
        error_locate(a->e, node->file ? node->file : a->file, node->line, node->column);
    }
    return false;
}

// ---- lists with names

static bool same_text(const Node *a, const Node *b, const char *key)
{
    const char *x = node_get_text(a, key), *y = node_get_text(b, key);
    return x && y && strcmp(x, y) == 0;
}

// The entry of the list that agrees with another one in one or two keys; NULL = none.
static Node *find_same(const Node *list, const Node *as, const char *key, const char *key2)
{
    Node *entry = list->first;
    while (entry && !(same_text(entry, as, key) && (!key2 || same_text(entry, as, key2)))) {
        entry = entry->next;
    }
    return entry;
}

// Moves the entries of `from` that agree with none to the list, and merges the others.
static bool merge_list(Applier *a, Node *list, const Node *from, const char *key, const char *key2)
{
    bool done = true;
    for (Node *entry = from ? from->first : NULL, *next; done && entry; entry = next) {
        next = entry->next;
        Node *own = find_same(list, entry, key, key2);
        if (!own) {
            node_append(list, entry, NULL);
        } else if (own->kind == NODE_MAP && entry->kind == NODE_MAP) {
            done = node_merge(a->arena, own, entry, &a->budget, a->e);
        }
    }
    return done;
}

// The list under a key of a map, created if there is none.
static Node *list_of(Applier *a, Node *map, const char *key)
{
    Node *list = node_get(map, key);
    if (list && node_is_null(list)) {
        list->kind = NODE_LIST;
    }
    if (!list && (list = node_new(a->arena, NODE_LIST, a->e))) {
        node_append(map, list, key);
    }
    return list;
}

// ---- files

static const char *other_kind(const Node *root)
{
    for (const Node *child = root->first; child; child = child->next) {
        for (int i = 0; kind_at(i); i++) {
            if (strcmp(kind_name(kind_at(i)), child->key) == 0) {
                return child->key;
            }
        }
    }
    return NULL;
}

static bool check_parts(const Applier *a, const SpeciesFile *file)
{
    static const char *const LISTS[] = {"materials", "targets"};
    for (int i = 0; i < 2; i++) {
        const Node *list = node_get(file->root, LISTS[i]);
        if (list && list->kind != NODE_LIST && !node_is_null(list)) {
            error_set(a->e, ERROR_INPUT, "%s must be a list of mappings ('- ' before each)",
                      LISTS[i]);
            return fail_at(a, list);
        }
        for (const Node *entry = list ? list->first : NULL; entry; entry = entry->next) {
            if (entry->kind != NODE_MAP) {
                error_set(a->e, ERROR_INPUT, "an entry of %s must be a mapping", LISTS[i]);
                return fail_at(a, entry);
            }
        }
    }
    return true;
}

// The mapping of the kind in the species file.
static Node *find_body(const Applier *a, const SpeciesFile *file, const Node *named,
                       const char *kind)
{
    Node *body = node_get(file->root, kind);
    if (body && body->kind == NODE_MAP) {
        return check_parts(a, file) ? body : NULL;
    }
    const char *other = other_kind(file->root);
    if (other && !body) {
        error_set(a->e, ERROR_INPUT, "species '%.60s' is no %s; write %s: {species: %.60s}",
                  file->stem, kind, other, named->text);
    } else {
        error_set(a->e, ERROR_INPUT, "species '%.60s' (%s) has no mapping '%s:'", file->stem,
                  file->path, kind);
    }
    fail_at(a, named);
    return NULL;
}

static Node *read_species(Applier *a, SpeciesFile *file, const Node *named, const Subject *of,
                          int steps);

// Adds what the species has that this one begins with.
static bool add_base(Applier *a, SpeciesFile *file, Node *body, const Subject *of, int steps)
{
    Node *named = node_get(body, "species");
    if (!named) {
        return true;
    }
    node_remove(body, named);
    SpeciesFile base;
    Node *base_body = read_species(a, &base, named, of, steps + 1);
    if (!base_body || !species_fit_size(of->table, body, base_body, a->arena, a->e)) {
        return false;
    }
    Node *root = file->root, *base_root = base.root;
    Node *materials = list_of(a, root, "materials"), *targets = list_of(a, root, "targets");
    return materials && targets &&
           merge_list(a, materials, node_get(base_root, "materials"), "name", NULL) &&
           merge_list(a, targets, node_get(base_root, "targets"), "measure", NULL) &&
           node_merge(a->arena, root, base_root, &a->budget, a->e);
}

// Reads the file with all that it begins with; returns the mapping of the kind in it.
static Node *read_species(Applier *a, SpeciesFile *file, const Node *named, const Subject *of,
                          int steps)
{
    if (steps >= MOST_STEPS) {
        error_set(a->e, ERROR_INPUT,
                  "species '%.60s' begins with a species, and so on, more than %d times; end the "
                  "circle",
                  named->text, MOST_STEPS);
        fail_at(a, named);
        return NULL;
    }
    if (!species_file_read(file, named, a->file, a->folder, a->arena, a->e)) {
        return NULL;
    }
    Node *body = find_body(a, file, named, of->params->key);
    return body && add_base(a, file, body, of, steps) ? body : NULL;
}

// ---- materials and targets

static bool is_material_key(const char *key)
{
    static const char END[] = "material";
    size_t length = key ? strlen(key) : 0, end = sizeof END - 1;
    return length >= end && strcmp(key + length - end, END) == 0;
}

// Writes SPECIES_NAME for the name of a material of the species wherever a key refers to it.
static bool rename_references(Applier *a, Node *node, const Node *materials, const char *stem)
{
    bool done = true;
    for (Node *child = node->first; done && child; child = child->next) {
        bool refers = child->kind == NODE_SCALAR && is_material_key(child->key);
        for (const Node *m = refers && materials ? materials->first : NULL; m; m = m->next) {
            const char *name = node_get_text(m, "name");
            if (name && strcmp(name, child->text) == 0) {
                child->text = arena_format(a->arena, a->e, "%s_%s", stem, name);
                done = child->text;
                break;
            }
        }
        done = done && rename_references(a, child, materials, stem);
    }
    return done;
}

static bool rename_materials(Applier *a, Node *root, const char *stem)
{
    const Node *materials = node_get(root, "materials");
    bool done = rename_references(a, root, materials, stem);
    for (Node *m = materials ? materials->first : NULL; done && m; m = m->next) {
        Node *name = node_get(m, "name");
        if (name && name->kind == NODE_SCALAR) {
            name->text = arena_format(a->arena, a->e, "%s_%s", stem, name->text);
            done = name->text;
        }
    }
    return done;
}

static bool add_materials(Applier *a, const SpeciesFile *file, const Node *named)
{
    for (const Used *used = a->used; used; used = used->next) {
        if (strcmp(used->stem, file->stem) == 0) {
            if (strcmp(used->text, file->text) == 0) {
                return true; // another object has brought them
            }
            error_set(a->e, ERROR_INPUT,
                      "two species files are called '%.60s', %s and %s; rename one, since their "
                      "materials have that name",
                      file->stem, used->path, file->path);
            return fail_at(a, named);
        }
    }
    Used *used = arena_alloc(a->arena, sizeof *used, a->e);
    Node *list = list_of(a, a->root, "materials");
    if (!used || !list) {
        return false;
    }
    *used = (Used){a->used, file->stem, file->path, file->text};
    a->used = used;
    return merge_list(a, list, node_get(file->root, "materials"), "name", NULL);
}

// A value that is neither true nor false is an error once the tables load the object.
static bool wants_targets(const Node *object)
{
    const char *text = node_get_text(object, "species_targets");
    bool wanted = true;
    return !text || !scalar_truth(text, &wanted) || wanted;
}

static bool add_targets(Applier *a, const SpeciesFile *file, const Node *object)
{
    if (!wants_targets(object)) {
        return true;
    }
    const Node *own = node_get(file->root, "targets"), *name = node_get(object, "name");
    Node *list = own && name ? list_of(a, a->root, "targets") : NULL;
    if (!list) {
        return !own || !name;
    }
    for (Node *target = own->first; target; target = target->next) {
        Node *of = node_copy(a->arena, name, &a->budget, a->e);
        if (!of) {
            return false;
        }
        node_append(target, of, "object");
    }
    return merge_list(a, list, own, "object", "measure");
}

// ---- objects

static bool apply_species(Applier *a, const Subject *of, Node *named)
{
    SpeciesFile file;
    node_remove(of->params, named);
    Node *body = read_species(a, &file, named, of, 0);
    Node *root = body ? file.root : NULL;
    if (!body || !species_fit_size(of->table, of->params, body, a->arena, a->e) ||
        !species_fit_place(of->params, body, a->arena, a->e) ||
        !rename_materials(a, root, file.stem) || !add_materials(a, &file, named) ||
        !add_targets(a, &file, of->object)) {
        return false;
    }
    static const char *const NOT_OF_OBJECT[] = {"latin", "materials", "targets"};
    for (size_t i = 0; i < sizeof NOT_OF_OBJECT / sizeof *NOT_OF_OBJECT; i++) {
        Node *child = node_get(root, NOT_OF_OBJECT[i]);
        if (child) {
            node_remove(root, child);
        }
    }
    return node_merge(a->arena, of->object, root, &a->budget, a->e);
}

// Distant woods without species are of these.
static bool add_default_mix(Applier *a, const Node *object)
{
    static const char MIX[] = "[{share: 4, tree: {species: pedunculate_oak}}, "
                              "{share: 3, tree: {species: lime}}, "
                              "{share: 3, tree: {species: silver_birch}}]";
    Node *woods = node_get(node_get(object, "ground"), "trees");
    const char *count = node_get_text(woods, "count");
    if (!count || strcmp(count, "0") == 0 || node_get(woods, "species")) {
        return true;
    }
    Node *mix = yaml_parse(a->arena, MIX, sizeof MIX - 1, "species of distant woods", NULL, a->e);
    if (mix) {
        node_append(woods, mix, "species");
    }
    return mix;
}

static bool apply_to_object(Applier *a, Node *object)
{
    for (int i = 0; kind_at(i); i++) {
        const Key *row = &kind_at(i)->variant.row;
        Subject of = {object, node_get(object, row->key), row->table};
        Node *named = of.params ? node_get(of.params, "species") : NULL;
        const Key *key = named ? table_find(row->table, "species") : NULL;
        if (key && key->type == KEY_TEXT && !apply_species(a, &of, named)) {
            return false;
        }
    }
    return true;
}

// Trees of a mix, at any depth of an object: mappings with the key `tree`, which can have a
// species.
static bool apply_to_mixes(Applier *a, Node *node)
{
    static const char KIND[] = "tree";
    bool done = true;
    for (Node *child = node->first; done && child; child = child->next) {
        Subject of = {child, node_get(child, KIND), NULL};
        Node *named = of.params ? node_get(of.params, "species") : NULL;
        for (int i = 0; named && !of.table; i++) {
            const Key *row = &kind_at(i)->variant.row;
            of.table = strcmp(row->key, KIND) == 0 ? row->table : NULL;
        }
        done = (!named || apply_species(a, &of, named)) && apply_to_mixes(a, child);
    }
    return done;
}

bool species_apply(Node *root, const char *file, const char *folder, Arena *arena, Error *e)
{
    Applier a = {root, file, folder, arena, MOST_VALUES, NULL, e};
    const Node *objects = node_get(root, "objects");
    bool done = true;
    for (Node *object = objects ? objects->first : NULL; done && object; object = object->next) {
        done = add_default_mix(&a, object) && apply_to_object(&a, object) &&
               apply_to_mixes(&a, object);
    }
    return done;
}
