// Checks of objects and what they are made of.
#include "config/node_number.h"
#include "config/scalar.h"
#include "grow/lsystem/lsystem.h"
#include "grow/rules/sectors.h"
#include "scene/kind.h"
#include "scene/spec_check.h"
#include "shape/import_check.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static bool kind_has_material(const Kind *kind, const char *key)
{
    for (int i = 0; i < KIND_MOST_MATERIALS && kind->materials[i]; i++) {
        if (strcmp(kind->materials[i], key) == 0) {
            return true;
        }
    }
    return false;
}

bool is_material_key(const char *key)
{
    static const char ending[] = "material";
    size_t length = strlen(key), tail = sizeof ending - 1;
    return length >= tail && strcmp(key + length - tail, ending) == 0;
}

// "tree, ground, ...".
static const char *kind_list(char *text, size_t size)
{
    size_t used = 0;
    for (int i = 0; i < kind_count() && used < size; i++) {
        used += (size_t)snprintf(text + used, size - used, "%s%s", i ? ", " : "", kind_at(i)->key);
    }
    return text;
}

bool check_object(Resolver *r, const Path *path, const Node *given, Node *resolved)
{
    const char *name = resolver_path(r, path, NULL);
    const Kind *kind = NULL;
    for (int i = 0; i < kind_count(); i++) {
        const Node *child = node_get(resolved, kind_at(i)->key);
        if (child && kind) {
            return resolver_fail(r, child,
                                 "%s is a %s and a %s; it must be one, make two objects of it",
                                 name, kind->key, kind_at(i)->key);
        }
        kind = child ? kind_at(i) : kind;
    }
    if (!kind) {
        char kinds[256];
        return resolver_fail(r, given, "%s is nothing; it must have one of %s", name,
                             kind_list(kinds, sizeof kinds));
    }
    for (const Node *child = resolved->first; child; child = child->next) {
        if (is_material_key(child->key) && !kind_has_material(kind, child->key)) {
            return resolver_fail(r, child, "%s: a %s has no %s; leave it out", name, kind->key,
                                 child->key);
        }
    }
    return true;
}

bool check_tree(Resolver *r, const Path *path, const Node *given, Node *resolved)
{
    double height = node_number(resolved, "height");
    const char *const parts[] = {"crown", "trunk"}, *const keys[] = {"base", "height"};
    for (int i = 0; i < 2; i++) {
        double value = node_number(node_get(resolved, parts[i]), keys[i]);
        if (i == 0 ? value >= height : value > height) {
            return resolver_fail(r, node_place(node_get(given, parts[i]), keys[i]),
                                 "%s.%s.%s is %g m; it must be below the tree's height, %g m",
                                 resolver_path(r, path, NULL), parts[i], keys[i], value, height);
        }
    }
    return true;
}

bool check_terrain(Resolver *r, const Path *path, const Node *given, Node *resolved)
{
    int cells = (int)node_number(resolved, "resolution");
    if ((cells & (cells - 1)) != 0) {
        return resolver_fail(r, node_place(given, "resolution"),
                             "%s.resolution is %d; it must be a power of two, such as 1024",
                             resolver_path(r, path, NULL), cells);
    }
    return true;
}

bool check_ground(Resolver *r, const Path *path, const Node *given, Node *resolved)
{
    double flat = node_number(resolved, "flat_radius"), radius = node_number(resolved, "radius");
    if (flat >= radius) {
        return resolver_fail(r, node_place(given, "flat_radius"),
                             "%s.flat_radius is %g m; it must be less than the radius, %g m",
                             resolver_path(r, path, NULL), flat, radius);
    }
    return true;
}

bool check_grove(Resolver *r, const Path *path, const Node *given, Node *resolved)
{
    double inner = node_number(resolved, "inner"), outer = node_number(resolved, "outer");
    if (inner >= outer) {
        return resolver_fail(r, node_place(given, "inner"),
                             "%s.inner is %g m; it must be less than outer, %g m",
                             resolver_path(r, path, NULL), inner, outer);
    }
    return true;
}

// Appends the hidden node `transform`, three rows of four numbers. size: of a sphere, whose shape
// is the unit sphere; 1 otherwise.
static bool add_transform(Resolver *r, const Path *path, const Node *given, Node *resolved,
                          float size)
{
    Vec3 scale = node_vector(resolved, "scale");
    if (scale.x == 0.0f || scale.y == 0.0f || scale.z == 0.0f) {
        return resolver_fail(r, node_place(given, "scale"),
                             "%s.scale has a 0, which flattens it; no factor may be 0",
                             resolver_path(r, path, NULL));
    }
    Transform transform =
        transform_compose(node_vector(resolved, "position"), node_vector(resolved, "rotation"),
                          vec3_scale(scale, size));
    Node *rows = node_new(r->arena, NODE_LIST, r->e);
    for (int i = 0; rows && i < 3; i++) {
        Node *row = resolver_number_list(r, transform.m[i], 4);
        if (!row) {
            return false;
        }
        node_append(rows, row, NULL);
    }
    if (rows) {
        rows->flags = KEY_HIDDEN;
        node_append(resolved, rows, "transform");
    }
    return rows;
}

// What a look at the file's name, size and header tells.
static bool check_mesh_file(Resolver *r, const Path *path, const Node *given, const Node *resolved)
{
    const Node *file = node_get(resolved, "file");
    Error e = {0};
    if (!file || import_check(file->resolved, &e)) {
        return true;
    }
    return resolver_fail(r, node_place(given, "file"), "%s: '%s': %s",
                         resolver_path(r, path, "file"), file->text, e.message);
}

bool check_mesh(Resolver *r, const Path *path, const Node *given, Node *resolved)
{
    return check_mesh_file(r, path, given, resolved) &&
           add_transform(r, path, given, resolved, 1.0f);
}

// The components of size that a kind of shape needs to be greater than 0.
static int needed_sizes(const char *kind, const char **why)
{
    if (strcmp(kind, "cone") == 0) {
        *why = "radius below and height";
        return 2;
    }
    if (strcmp(kind, "sphere") == 0 || strcmp(kind, "capsule") == 0 || strcmp(kind, "body") == 0) {
        *why = strcmp(kind, "body") == 0 ? "the height" : "radius";
        return 1;
    }
    *why = "all sizes";
    return strcmp(kind, "ellipsoid") == 0 || strcmp(kind, "box") == 0 ? 3 : 0;
}

bool check_shape(Resolver *r, const Path *path, const Node *given, Node *resolved)
{
    const char *kind = node_get_text(resolved, "shape"), *why;
    const Node *size = node_get(resolved, "size");
    int needed = needed_sizes(kind, &why);
    for (int i = 0; i < needed; i++) {
        if (!(node_component(size, i) > 0.0f)) {
            return resolver_fail(r, node_place(given, "size"),
                                 "%s.size: %s of a %s must be greater than 0 m",
                                 resolver_path(r, path, NULL), why, kind);
        }
    }
    bool sphere = strcmp(kind, "sphere") == 0;
    return check_mesh_file(r, path, given, resolved) &&
           add_transform(r, path, given, resolved, sphere ? node_component(size, 0) : 1.0f);
}

// What growth would refuse only once it is the object's turn.
static bool check_scattering(Resolver *r, const Path *path, const Node *given, const Node *resolved)
{
    const Node *points = node_get(resolved, "points");
    const char *pattern = node_get_text(points, "pattern");
    const char *anchored = node_get_text(points, "anchored");
    if (pattern && strcmp(pattern, "poisson") == 0 && anchored && strcmp(anchored, "true") == 0) {
        return resolver_fail(r, node_place(node_get(given, "points"), "anchored"),
                             "%s.anchored: anchored points keep no distance; use the pattern "
                             "random, or anchored: false",
                             resolver_path(r, path, "points"));
    }
    return true;
}

static bool check_sectors(Resolver *r, const Path *path, const Node *given, const Node *resolved)
{
    const Node *growth = node_get(resolved, "growth"), *points = node_get(resolved, "points");
    const char *rule = node_get_text(growth, "rule"), *place = node_get_text(points, "place");
    float angle = (float)node_number(growth, "sector_angle");
    if (!rule || strcmp(rule, "sectors") != 0 || angle == 0.0f) {
        return true;
    }
    SectorTable table;
    Error e = {0};
    if (!sectors_init(&table, angle, place && strcmp(place, "surface") == 0, &e)) {
        return resolver_fail(r, node_place(node_get(given, "growth"), "sector_angle"), "%s: %s",
                             resolver_path(r, path, "growth.sector_angle"), e.message);
    }
    return true;
}

bool check_envelope(Resolver *r, const Path *path, const Node *given, Node *resolved)
{
    const char *name = resolver_path(r, path, "envelope");
    const Node *list = node_get(resolved, "envelope");
    if (!check_scattering(r, path, given, resolved) || !check_sectors(r, path, given, resolved)) {
        return false;
    }
    for (const Node *shape = list ? list->first : NULL; shape; shape = shape->next) {
        bool adds = strcmp(node_get_text(shape, "op"), "union") == 0;
        if (shape == list->first && !adds) {
            return resolver_fail(r, shape, "%s begins with a %s; the first shape must be a union",
                                 name, node_get_text(shape, "op"));
        }
        if (adds && strcmp(node_get_text(shape, "shape"), "half_space") == 0) {
            return resolver_fail(r, shape,
                                 "%s: a half_space has no end; its op must be difference or "
                                 "intersection",
                                 name);
        }
    }
    return true;
}

bool check_lightning(Resolver *r, const Path *path, const Node *given, Node *resolved)
{
    const Node *points = node_get(resolved, "points"), *list = node_get(resolved, "envelope");
    if (strcmp(node_get_text(points, "place"), "surface") == 0 && (!list || !list->first)) {
        return resolver_fail(r, given, "%s grows over a surface but has no envelope; give it one",
                             resolver_path(r, path, NULL));
    }
    return check_envelope(r, path, given, resolved);
}

bool check_vessels(Resolver *r, const Path *path, const Node *given, Node *resolved)
{
    const Node *list = node_get(resolved, "envelope");
    if (!list || !list->first) {
        return resolver_fail(r, given, "%s has no envelope; it must name the organ to fill",
                             resolver_path(r, path, NULL));
    }
    return check_envelope(r, path, given, resolved);
}

bool check_level(Resolver *r, const Path *path, const Node *given, Node *resolved)
{
    double kill = node_number(resolved, "kill"), influence = node_number(resolved, "influence");
    if (kill >= influence) {
        return resolver_fail(r, node_place(given, "kill"),
                             "%s.kill is %g; it must be less than influence, %g, or attractors go "
                             "before they pull",
                             resolver_path(r, path, NULL), kill, influence);
    }
    return true;
}

// Gives a level the key that it leaves out.
static bool fill_level(Resolver *r, Node *level, const char *key, const char *text)
{
    if (node_get(level, key)) {
        return true;
    }
    Node *node = node_scalar(r->arena, text, r->e);
    if (node) {
        node_append(level, node, key);
    }
    return node;
}

bool check_growth(Resolver *r, const Path *path, const Node *given, Node *resolved)
{
    double least = node_number(resolved, "min_angle"), most = node_number(resolved, "max_angle");
    if (most > 0.0 && least > most) {
        return resolver_fail(r, node_place(given, "min_angle"),
                             "%s.min_angle is %g; it must be at most max_angle, %g degrees",
                             resolver_path(r, path, NULL), least, most);
    }
    const Node *levels = node_get(resolved, "levels");
    for (Node *level = levels ? levels->first : NULL; level; level = level->next) {
        if (!fill_level(r, level, "noise", node_get_text(resolved, "noise")) ||
            !fill_level(r, level, "tropism", node_get(given, "tropism") ? "1" : "0")) {
            return false;
        }
    }
    return true;
}

// Says whether the file gives a field its centre.
static bool add_centered(Resolver *r, Node *resolved)
{
    Node *node = node_scalar(r->arena, node_get(resolved, "center") ? "true" : "false", r->e);
    if (node) {
        node->flags = KEY_HIDDEN;
        node_append(resolved, node, "centered");
    }
    return node;
}

bool check_field(Resolver *r, const Path *path, const Node *given, Node *resolved)
{
    const Node *vector = node_get(resolved, "vector");
    if (vector && !(vec3_length(node_vector(resolved, "vector")) > 0.0f)) {
        return resolver_fail(r, node_place(given, "vector"),
                             "%s.vector is zero; it must point somewhere",
                             resolver_path(r, path, NULL));
    }
    return add_centered(r, resolved);
}

// Axiom and rules that the file gives. An axiom alone may use constants of the form's own rules, so
// that coral's is left to the growth, which begins with it.
static bool check_grammar(Resolver *r, const Path *path, const Node *given, bool whole)
{
    const char *axiom = node_get_text(given, "axiom"), *rules = node_get_text(given, "rules");
    if (!rules && !(axiom && whole)) {
        return true;
    }
    Error e = {0};
    LSystemParams params = {.axiom = axiom ? axiom : "F", .rules = rules ? rules : ""};
    if (lsystem_check(&params, &e)) {
        return true;
    }
    const char *key = axiom && strcmp(e.key, "axiom") == 0 ? "axiom" : "rules";
    return resolver_fail(r, node_place(given, key), "%s: %s", resolver_path(r, path, key),
                         e.message);
}

bool check_lsystem(Resolver *r, const Path *path, const Node *given, Node *resolved)
{
    (void)resolved;
    return check_grammar(r, path, given, true);
}

bool check_coral(Resolver *r, const Path *path, const Node *given, Node *resolved)
{
    (void)resolved;
    return check_grammar(r, path, given, false);
}
