#include "objects/common/own_space.h"

#include "base/exact_math.h"
#include "mesh/geometry_measure.h"
#include "objects/kind.h"

#include <float.h>
#include <string.h>

#define COARSEST 1e-2f // steps of coordinates over the size of an object

bool own_space_enter(OwnSpace *own, const Kind *kind, const void *params, Error *e)
{
    *own = (OwnSpace){.params = params, .to_scene = transform_identity()};
    if (!kind->own_space) {
        return true;
    }
    void *mine = own_space_copy(own, params, kind->variant.row.table->size, e);
    if (!mine || !kind->own_space(own, mine, e)) {
        own_space_leave(own);
        return false;
    }
    own->params = mine;
    return true;
}

void own_space_leave(OwnSpace *own)
{
    arena_free(own->arena);
    own->arena = NULL;
}

// ---- placing ----

static void set(OwnSpace *own, Transform to_scene)
{
    const Transform rest = transform_identity();
    own->to_scene = to_scene;
    own->moved = false;
    for (int i = 0; i < 12; i++) {
        own->moved = own->moved || to_scene.m[i / 4][i % 4] != rest.m[i / 4][i % 4];
    }
}

void own_space_stand(OwnSpace *own, Vec3 place, Vec3 rotation)
{
    set(own, transform_compose(place, rotation, vec3(1, 1, 1)));
}

static Vec3 column(const Transform *t, int i)
{
    return vec3(t->m[0][i], t->m[1][i], t->m[2][i]);
}

// Azimuth of a shape's x axis, or of its z axis (as the matching x axis) if x is vertical. Rotating
// the shape about Y rotates it by the same angle.
static Vec3 heading(const Transform *t)
{
    Vec3 x = column(t, 0), z = column(t, 2);
    Vec3 level = vec3(x.x, 0, x.z);
    if (!(vec3_dot(level, level) > 1e-6f * vec3_dot(x, x))) {
        level = vec3(z.z, 0, -z.x);
    }
    float length = vec3_length(level);
    return length > 0.0f ? vec3_scale(level, 1.0f / length) : vec3(1, 0, 0);
}

void own_space_of_shapes(OwnSpace *own, const Shape *shapes, int count)
{
    if (count > 0) {
        Vec3 x = heading(&shapes[0].transform), z = vec3(-x.z, 0, x.x);
        set(own, transform_from_axes(x, vec3(0, 1, 0), z, column(&shapes[0].transform, 3)));
    }
}

void own_space_of_element(OwnSpace *own, const ElementParams *element)
{
    if (!element->points.anchored) {
        own_space_of_shapes(own, element->shapes, element->shape_count);
    }
}

// ---- into own space ----

void *own_space_copy(OwnSpace *own, const void *of, size_t size, Error *e)
{
    if (!own->arena && !(own->arena = arena_new(e))) {
        return NULL;
    }
    void *copy = arena_alloc(own->arena, size, e);
    if (copy && size > 0) {
        memcpy(copy, of, size);
    }
    return copy;
}

Vec3 own_space_direction(const OwnSpace *own, Vec3 v)
{
    const Transform *t = &own->to_scene;
    return vec3(vec3_dot(column(t, 0), v), vec3_dot(column(t, 1), v), vec3_dot(column(t, 2), v));
}

Vec3 own_space_place(const OwnSpace *own, Vec3 place)
{
    return own_space_direction(own, vec3_sub(place, column(&own->to_scene, 3)));
}

float own_space_azimuth(const OwnSpace *own, float degrees)
{
    Vec3 x = column(&own->to_scene, 0);
    return degrees - exact_atan2(-x.z, x.x) / RADIANS_PER_DEGREE;
}

static Transform take_transform(const OwnSpace *own, const Transform *t)
{
    return transform_from_axes(
        own_space_direction(own, column(t, 0)), own_space_direction(own, column(t, 1)),
        own_space_direction(own, column(t, 2)), own_space_place(own, column(t, 3)));
}

bool own_space_take_shapes(OwnSpace *own, Shape **shapes, int count, Error *e)
{
    if (!own->moved || count == 0) {
        return true;
    }
    Shape *mine = own_space_copy(own, *shapes, sizeof **shapes * (size_t)count, e);
    for (int i = 0; mine && i < count; i++) {
        mine[i].transform = take_transform(own, &mine[i].transform);
    }
    *shapes = mine;
    return mine;
}

static bool take_nuclei(OwnSpace *own, Nucleus **nuclei, int count, Error *e)
{
    if (count == 0) {
        return true;
    }
    Nucleus *mine = own_space_copy(own, *nuclei, sizeof **nuclei * (size_t)count, e);
    bool done = mine != NULL;
    for (int i = 0; done && i < count; i++) {
        mine[i].position = own_space_place(own, mine[i].position);
        mine[i].end = own_space_place(own, mine[i].end);
        mine[i].normal = own_space_direction(own, mine[i].normal);
        done = own_space_take_shapes(own, &mine[i].shapes, mine[i].shape_count, e);
    }
    *nuclei = mine;
    return done;
}

// An omitted centre is the object's origin in either space.
static bool take_fields(OwnSpace *own, FieldParams **fields, int count, Error *e)
{
    FieldParams *mine = own_space_copy(own, *fields, sizeof **fields * (size_t)count, e);
    bool done = mine != NULL;
    for (int i = 0; done && i < count; i++) {
        mine[i].vector = own_space_direction(own, mine[i].vector);
        if (mine[i].centered) {
            mine[i].center = own_space_place(own, mine[i].center);
        }
        mine[i].from_file = take_transform(own, &mine[i].from_file);
        done = take_nuclei(own, &mine[i].nucleus, mine[i].nucleus_count, e);
    }
    *fields = mine;
    return done;
}

bool own_space_take_element(OwnSpace *own, ElementParams *element, Error *e)
{
    if (!own->moved) {
        return true;
    }
    if (element->density) {
        DensityParams *density = own_space_copy(own, element->density, sizeof *density, e);
        if (!density) {
            return false;
        }
        density->transform = take_transform(own, &density->transform);
        element->density = density;
    }
    element->growth.cone_axis = own_space_direction(own, element->growth.cone_axis);
    element->growth.tropism = own_space_direction(own, element->growth.tropism);
    element->points.facing = own_space_direction(own, element->points.facing);
    return own_space_take_shapes(own, &element->shapes, element->shape_count, e) &&
           (element->field_count == 0 ||
            take_fields(own, &element->fields, element->field_count, e));
}

// ---- into the scene ----

// Does geometry in this box keep its shape when moved that far?
static bool check_place(const OwnSpace *own, Aabb box, Error *e)
{
    float way = vec3_length(column(&own->to_scene, 3)), size = vec3_distance(box.low, box.high);
    float step = way * FLT_EPSILON; // spacing of floats there
    return aabb_is_empty(box) || step <= size * COARSEST ||
           error_set(e, ERROR_INPUT,
                     "it is %.3g m large and %.3g m from the origin, where coordinates have a "
                     "resolution of %.3g m; move it closer",
                     (double)size, (double)way, (double)step);
}

bool own_space_carry_tree(const OwnSpace *own, OutTree *tree, Error *e)
{
    if (!tree || !own->moved) {
        return true;
    }
    Aabb box = aabb_empty();
    for (int64_t i = 0; i < tree->count; i++) {
        box = aabb_add(box, tree->position[i]);
        tree->position[i] = transform_point(&own->to_scene, tree->position[i]);
        tree->normal[i] = transform_vector(&own->to_scene, tree->normal[i]);
    }
    return check_place(own, box, e);
}

static bool carry_part(const OwnSpace *own, Part *part, Error *e)
{
    const Transform *to_scene = &own->to_scene;
    if (part->instance) {
        for (int64_t i = 0; i < part->instance_count; i++) {
            part->instance[i] = transform_multiply(to_scene, &part->instance[i]);
        }
        return true;
    }
    for (int64_t i = 0; part->curves && i < part->curves->point_count; i++) {
        part->curves->position[i] = transform_point(to_scene, part->curves->position[i]);
    }
    return !part->mesh || mesh_transform(part->mesh, to_scene, e);
}

bool own_space_carry_parts(const OwnSpace *own, Geometry *geometry, int64_t first, Error *e)
{
    bool done = !own->moved || check_place(own, geometry_bounds(geometry, first), e);
    for (int64_t i = first; done && own->moved && i < geometry->count; i++) {
        done = carry_part(own, &geometry->part[i], e);
    }
    return done;
}
