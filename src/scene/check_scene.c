// Checks of camera, film, lamps, and of the scene as a whole.
#include "config/hint.h"
#include "config/node_number.h"
#include "config/scalar.h"
#include "scene/builtin.h"
#include "scene/spec_check.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MOST_PIXELS 100000000.0

// Vertical field of view of a lens before a full frame, 24 mm high.
static bool fov_from_focal_length(Resolver *r, Node *resolved)
{
    float focal_length = (float)node_number(resolved, "focal_length");
    float degrees = 2.0f * atanf(12.0f / focal_length) / RADIANS_PER_DEGREE;
    char text[32];
    scalar_from_float(fminf(degrees, 179.999f), text);
    const char *kept = arena_text(r->arena, text, strlen(text), r->e);
    node_get(resolved, "fov")->text = kept;
    node_get(resolved, "focal_length")->flags |= KEY_HIDDEN; // fov says it
    return kept;
}

bool check_camera(Resolver *r, const Path *path, const Node *given, Node *resolved)
{
    const Node *focal_length = node_get(given, "focal_length");
    if (focal_length && node_get(given, "fov")) {
        return resolver_fail(r, focal_length, "%s has both fov and focal_length; give one",
                             resolver_path(r, path, NULL));
    }
    if (focal_length && !fov_from_focal_length(r, resolved)) {
        return false;
    }
    Vec3 view = vec3_sub(node_vector(resolved, "target"), node_vector(resolved, "position"));
    Vec3 up = node_vector(resolved, "up");
    if (!(vec3_length(view) > 0.0f)) {
        return resolver_fail(r, node_place(given, "target"),
                             "%s.target is where the camera is; it must be another point",
                             resolver_path(r, path, NULL));
    }
    if (!(vec3_length(vec3_cross(vec3_normalize(view), vec3_normalize(up))) > 1e-5f)) {
        return resolver_fail(
            r, node_place(given, "up"),
            "%s.up is zero or along the line of sight; it must point aside from it",
            resolver_path(r, path, NULL));
    }
    return true;
}

// Do the edges of the crop fall together in whole pixels?
static bool crop_is_empty(float low, float high, double pixels)
{
    return !(lroundf(high * (float)pixels) > lroundf(low * (float)pixels));
}

bool check_film(Resolver *r, const Path *path, const Node *given, Node *resolved)
{
    const char *name = resolver_path(r, path, NULL);
    double pixels = node_number(resolved, "width") * node_number(resolved, "height");
    if (pixels > MOST_PIXELS) {
        return resolver_fail(r, node_place(given, "width"),
                             "%s has %.0f million pixels; it must have at most %.0f million", name,
                             pixels * 1e-6, MOST_PIXELS * 1e-6);
    }
    const Node *crop = node_get(resolved, "crop");
    float x0 = node_component(crop, 0), y0 = node_component(crop, 1);
    if (!(node_component(crop, 2) > x0 && node_component(crop, 3) > y0)) {
        return resolver_fail(r, node_place(given, "crop"),
                             "%s.crop is empty; it must be [x0, y0, x1, y1] with x0 < x1, y0 < y1",
                             name);
    }
    if (crop_is_empty(x0, node_component(crop, 2), node_number(resolved, "width")) ||
        crop_is_empty(y0, node_component(crop, 3), node_number(resolved, "height"))) {
        return resolver_fail(r, node_place(given, "crop"),
                             "%s.crop is less than half a pixel wide or high; make it larger",
                             name);
    }
    return true;
}

bool check_light(Resolver *r, const Path *path, const Node *given, Node *resolved)
{
    if (strcmp(node_get_text(resolved, "kind"), "quad") != 0) {
        return true;
    }
    Vec3 across = vec3_cross(node_vector(resolved, "edge_u"), node_vector(resolved, "edge_v"));
    if (!(vec3_length(across) > 0.0f)) {
        return resolver_fail(r, node_place(given, "edge_u"),
                             "%s has edges that span no area; they must not be parallel or zero",
                             resolver_path(r, path, NULL));
    }
    return true;
}

bool check_target(Resolver *r, const Path *path, const Node *given, Node *resolved)
{
    double low = node_number(resolved, "low"), high = node_number(resolved, "high");
    if (!(low <= high)) {
        return resolver_fail(r, node_place(given, "low"),
                             "%s: low %g is above high %g; nothing can meet it",
                             resolver_path(r, path, NULL), low, high);
    }
    return true;
}

// Names are parts of --set paths and of layers' names.
static bool check_name(Resolver *r, const Node *given, const char *name, const char *what)
{
    bool plain = !isdigit((unsigned char)*name);
    for (const char *c = name; *c && plain; c++) {
        plain = isalnum((unsigned char)*c) || strchr("_- ", *c) || (unsigned char)*c >= 0x80;
    }
    if (!plain || strlen(name) > 63) {
        return resolver_fail(r, node_get(given, "name"),
                             "%s name '%.70s'; it must be letters, digits, spaces, - and _, at "
                             "most 63 of them, and not begin with a digit",
                             what, name);
    }
    return true;
}

static int compare_names(const void *a, const void *b)
{
    const Node *const *left = a, *const *right = b;
    int order = strcmp((*left)->text, (*right)->text);
    return order ? order : ((*left)->line > (*right)->line) - ((*left)->line < (*right)->line);
}

// Valid and unique names in a list of mappings.
static bool check_names(Resolver *r, const Node *list, const char *what)
{
    int count = 0;
    const Node **names = arena_alloc(r->arena, sizeof(Node *) * (size_t)(list->count + 1), r->e);
    for (const Node *entry = list->first; names && entry; entry = entry->next) {
        names[count] = node_get(entry, "name");
        if (!check_name(r, entry, names[count]->text, what)) {
            return false;
        }
        count++;
    }
    if (names && count > 1) {
        qsort(names, (size_t)count, sizeof(Node *), compare_names);
    }
    for (int i = 1; names && i < count; i++) {
        if (strcmp(names[i - 1]->text, names[i]->text) == 0) {
            return resolver_fail(r, names[i],
                                 "%s name '%s' is taken in line %d already; give each its own",
                                 what, names[i]->text, names[i - 1]->line);
        }
    }
    return names;
}

// All names of materials: the scene's, then the built-in ones.
static const char **material_names(Resolver *r, const Node *materials, int *count)
{
    int builtin_count;
    const Material *builtin = builtin_materials(&builtin_count);
    size_t most = (size_t)builtin_count + (size_t)(materials ? materials->count : 0);
    const char **names = arena_alloc(r->arena, sizeof(char *) * most, r->e);
    *count = 0;
    for (const Node *m = names && materials ? materials->first : NULL; m; m = m->next) {
        names[(*count)++] = node_get_text(m, "name");
    }
    for (int i = 0; names && i < builtin_count; i++) {
        names[(*count)++] = builtin[i].name;
    }
    return names;
}

static bool is_among(const char *const *names, int count, const char *text)
{
    for (int i = 0; i < count; i++) {
        if (strcmp(names[i], text) == 0) {
            return true;
        }
    }
    return false;
}

static bool check_material_of(Resolver *r, const Node *object, const Node *named,
                              const char *const *names, int count)
{
    if (!is_among(names, count, named->text)) {
        char hint[512];
        hint_format(named->text, names, count, hint, sizeof hint);
        return resolver_fail(r, named, "objects.%s.%s: there is no material '%.60s'; %s",
                             node_get_text(object, "name"), named->key, named->text, hint);
    }
    return true;
}

// Each target's object exists. (Which measures it has shows when it is measured.)
static bool check_targets(Resolver *r, const Node *targets, const Node *objects)
{
    const char **names = arena_alloc(r->arena, sizeof(char *) * (size_t)objects->count, r->e);
    int count = 0;
    for (const Node *object = names ? objects->first : NULL; object; object = object->next) {
        names[count++] = node_get_text(object, "name");
    }
    for (const Node *target = names ? targets->first : NULL; target; target = target->next) {
        const Node *named = node_get(target, "object");
        if (!is_among(names, count, named->text)) {
            char hint[512];
            hint_format(named->text, names, count, hint, sizeof hint);
            return resolver_fail(r, named, "targets: there is no object '%.60s'; %s", named->text,
                                 hint);
        }
    }
    return names;
}

bool check_scene(Resolver *r, const Path *path, const Node *given, Node *resolved)
{
    (void)path;
    (void)given;
    const Node *materials = node_get(resolved, "materials"),
               *objects = node_get(resolved, "objects");
    if ((materials && !check_names(r, materials, "material")) ||
        !check_names(r, objects, "object")) {
        return false;
    }
    const Node *targets = node_get(resolved, "targets");
    if (targets && !check_targets(r, targets, objects)) {
        return false;
    }
    int count;
    const char **names = material_names(r, materials, &count);
    for (const Node *object = names ? objects->first : NULL; object; object = object->next) {
        for (const Node *key = object->first; key; key = key->next) {
            if (is_material_key(key->key) && !check_material_of(r, object, key, names, count)) {
                return false;
            }
        }
    }
    return names;
}
