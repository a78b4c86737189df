// Checks shared by kinds: shapes, growth, files.
#include "objects/common/tables.h"

#include "grow/lsystem/lsystem.h"
#include "grow/rules/sectors.h"
#include "shape/import_check.h"

#include <string.h>

bool check_scale(const Mapping *mapping, Vec3 scale)
{
    return (scale.x != 0.0f && scale.y != 0.0f && scale.z != 0.0f) ||
           mapping_fail(mapping, "scale", " has a 0; every factor must differ from 0");
}

bool check_range(const Mapping *mapping, const char *key, const float range[2])
{
    return range[0] <= range[1] ||
           mapping_fail(mapping, key, " is [%g, %g]; the first must not exceed the second",
                        (double)range[0], (double)range[1]);
}

bool check_mesh_file(const Mapping *mapping, const char *path)
{
    Error e = {0};
    return mapping->loader->without_files || import_check(path, &e) ||
           mapping_fail(mapping, "file", ": '%s': %s", node_get_text(mapping->given, "file"),
                        e.message);
}

// ---- envelopes ----

static const struct {
    int count; // of the components that must be greater than 0
    const char *words, *kind;
} NEEDED_SIZES[] = {
    [SHAPE_SPHERE] = {1, "radius", "sphere"},
    [SHAPE_ELLIPSOID] = {3, "all sizes", "ellipsoid"},
    [SHAPE_BOX] = {3, "all sizes", "box"},
    [SHAPE_CONE] = {2, "radius below and height", "cone"},
    [SHAPE_CAPSULE] = {1, "radius", "capsule"},
    [SHAPE_MESH] = {0},
    [SHAPE_HALF_SPACE] = {0},
    [SHAPE_BODY] = {1, "the height", "body"},
    [SHAPE_OBJECT] = {0},
};

static bool check_size(const Mapping *mapping, const Shape *shape)
{
    const float size[3] = {shape->size.x, shape->size.y, shape->size.z};
    for (int i = 0; i < 3 && i < NEEDED_SIZES[shape->kind].count; i++) {
        if (!(size[i] > 0.0f)) {
            return mapping_fail(mapping, "size", ": %s of a %s must be greater than 0 m",
                                NEEDED_SIZES[shape->kind].words, NEEDED_SIZES[shape->kind].kind);
        }
    }
    return true;
}

bool check_shape(const Mapping *mapping, void *params)
{
    Shape *shape = params;
    if (shape->kind == SHAPE_OBJECT) { // lies where the object is
        shape->transform = transform_identity();
        return true;
    }
    // A sphere is the unit sphere, scaled.
    float factor = shape->kind == SHAPE_SPHERE ? shape->size.x : 1.0f;
    shape->transform =
        transform_compose(shape->position, shape->rotation, vec3_scale(shape->scale, factor));
    return check_size(mapping, shape) &&
           (shape->kind != SHAPE_MESH || check_mesh_file(mapping, shape->file)) &&
           check_scale(mapping, shape->scale);
}

bool check_shapes(const Mapping *mapping, const char *key, const Shape *shapes, int count)
{
    const Node *list = node_get(mapping->given, key), *given = list ? list->first : NULL;
    int meshes = 0;
    for (int i = 0; given && i < count; i++, given = given->next) {
        const char *name = mapping_path(mapping, key);
        if (shapes[i].kind == SHAPE_OBJECT) {
            return load_fail(mapping->loader, node_get(given, "shape"),
                             "%s: the surface of an object has no inside; only an outtree with "
                             "points: {place: surface} takes it, as its only shape",
                             name);
        }
        if (i == 0 && shapes[i].op != SHAPE_UNION) {
            return load_fail(mapping->loader, given,
                             "%s begins with a %s; the first shape must be a union", name,
                             node_get_text(given, "op"));
        }
        if (shapes[i].op == SHAPE_UNION && shapes[i].kind == SHAPE_HALF_SPACE) {
            return load_fail(
                mapping->loader, given,
                "%s: a half_space is unbounded; its op must be difference or intersection", name);
        }
        meshes += shapes[i].kind == SHAPE_MESH;
        if (shapes[i].blend > 0.0f && (i == 0 || meshes > 0)) {
            return load_fail(mapping->loader, node_get(given, "blend"),
                             "%s: %s; blend: 0 leaves the edge sharp", name,
                             i == 0 ? "there is no shape before the first to flow into"
                                    : "a shape cannot flow into a mesh");
        }
    }
    return true;
}

// ---- growth ----

static bool check_sectors(const Mapping *mapping, const ElementParams *element)
{
    SectorTable table;
    Error e = {0};
    return element->growth.rule != GROW_SECTORS || element->growth.sector_angle == 0.0f ||
           sectors_init(&table, element->growth.sector_angle,
                        element->points.place == SCATTER_SURFACE, &e) ||
           mapping_fail(mapping, "growth.sector_angle", ": %s", e.message);
}

bool check_element(const Mapping *mapping, const ElementParams *element)
{
    if (element->growth.rule == GROW_STRING) {
        return mapping_fail(mapping, "growth.rule",
                            " is string, which only an outtree has an L-system for; use mean, snap "
                            "or sectors, or an outtree");
    }
    return check_string_element(mapping, element);
}

bool check_string_element(const Mapping *mapping, const ElementParams *element)
{
    if (element->points.pattern == SCATTER_POISSON && element->points.anchored) {
        return mapping_fail(mapping, "points.anchored",
                            ": anchored points cannot be evenly spaced; use the pattern random, or "
                            "anchored: false");
    }
    return check_sectors(mapping, element) &&
           check_shapes(mapping, "envelope", element->shapes, element->shape_count);
}

bool check_level(const Mapping *mapping, void *params)
{
    const GrowLevel *level = params;
    return level->kill < level->influence ||
           mapping_fail(mapping, "kill",
                        " is %g; it must be less than influence, %g, or attractors are removed "
                        "before they pull",
                        (double)level->kill, (double)level->influence);
}

bool check_growth(const Mapping *mapping, void *params)
{
    ElementParams *element = params;
    element->growth.new_orders = element->growth.max_order > 0;
    if (element->growth.max_angle > 0.0f && element->growth.min_angle > element->growth.max_angle) {
        return mapping_fail(mapping, "min_angle",
                            " is %g; it must be at most max_angle, %g degrees",
                            (double)element->growth.min_angle, (double)element->growth.max_angle);
    }
    const Node *list = node_get(mapping->given, "levels"), *given = list ? list->first : NULL;
    for (int i = 0; given && i < element->level_count; i++, given = given->next) {
        GrowLevel *level = &element->levels[i];
        if (!node_get(given, "noise")) {
            level->noise = element->growth.noise;
        }
        if (!node_get(given, "tropism")) {
            level->tropism = node_get(mapping->given, "tropism") ? 1.0f : 0.0f;
        }
    }
    return true;
}

bool check_field(const Mapping *mapping, void *params)
{
    FieldParams *field = params;
    field->from_file =
        transform_compose(field->position, field->rotation, vec3_splat(field->scale));
    bool needs_vector = field->kind == FIELD_UNIFORM || field->kind == FIELD_VORTEX ||
                        field->kind == FIELD_POINT || field->kind == FIELD_CURVATURE;
    return !needs_vector || vec3_length(field->vector) > 0.0f ||
           mapping_fail(mapping, "vector", " is zero; it must have a direction");
}

bool check_nucleus(const Mapping *mapping, void *params)
{
    const Nucleus *nucleus = params;
    if (nucleus->kind == NUCLEUS_LINE && vec3_distance(nucleus->position, nucleus->end) == 0.0f) {
        return mapping_fail(
            mapping, "end",
            " equals position; a line needs two different ends, or use kind: point");
    }
    return check_shapes(mapping, "envelope", nucleus->shapes, nucleus->shape_count);
}

bool check_grammar(const Mapping *mapping, const char *axiom, const char *rules)
{
    Error e = {0};
    LSystemParams params = {.axiom = axiom ? axiom : "F", .rules = rules ? rules : ""};
    if (lsystem_check(&params, &e)) {
        return true;
    }
    bool of_axiom = axiom && strcmp(e.key, "axiom") == 0;
    return mapping_fail(mapping, of_axiom ? "axiom" : "rules", ": %s", e.message);
}
