#include "render/light/emitter_set.h"

#include "base/memory.h"
#include "render/sky/dome.h"
#include "render/world.h"

#include <stdlib.h>

static bool glows(const World *world, const Part *part)
{
    if (part->material < 0 || part->material >= world->material_count) {
        return false; // accel_new reports it
    }
    const Material *m = &world->material[part->material];
    return material_has(m, TRAIT_EMISSIVE) && luminance(m->radiance) > 0.0f;
}

// Triangles of a mesh; sides and two ends of each curve.
static int64_t pieces(const Part *part)
{
    if (part->kind == PART_MESH) {
        return part->mesh->face_count * (part->mesh->face_size - 2);
    }
    return part->curves->point_count + part->curves->curve_count;
}

static int64_t copies(const Part *part)
{
    return part->instance ? part->instance_count : 1;
}

static Vec3 placed(const Transform *t, Vec3 p)
{
    return t ? transform_point(t, p) : p;
}

// Quads as Embree splits them: corners 0, 1, 3, then 2, 3, 1. closed: one per face, or NULL.
static void add_triangles(EmitterSet *set, const Part *part, int number, const uint8_t *closed,
                          const Transform *t)
{
    const Mesh *mesh = part->mesh;
    static const int corner[2][3] = {{0, 1, 3}, {2, 3, 1}}, plain[3] = {0, 1, 2};
    int cuts = mesh->face_size - 2;
    bool mirrored = t && transform_determinant(t) < 0.0f; // turns the faces round
    for (int64_t i = 0; i < mesh->face_count * cuts; i++) {
        const uint32_t *index = mesh->index + i / cuts * mesh->face_size;
        const int *k = cuts == 1 ? plain : corner[i % 2];
        Vec3 a = placed(t, mesh->position[index[k[0]]]);
        Vec3 b = placed(t, mesh->position[index[k[1]]]);
        Vec3 c = placed(t, mesh->position[index[k[2]]]);
        bool two_sided = !closed || !closed[i / cuts];
        set->emitter[set->count++] = mirrored ? emitter_triangle(a, c, b, two_sided, number)
                                              : emitter_triangle(a, b, c, two_sided, number);
    }
}

static float glow_at(const CurveSet *curves, int64_t point)
{
    return curves->glow ? curves->glow[point] : 1.0f;
}

// The mean factor by which the transform scales radii.
static float enlargement(const Transform *t)
{
    return t ? cbrtf(fabsf(transform_determinant(t))) : 1.0f;
}

// All sides, then the two ends of each curve.
static void add_curves(EmitterSet *set, const Part *part, int number, const Transform *t)
{
    const CurveSet *curves = part->curves;
    float scale = enlargement(t);
    for (int64_t c = 0; c < curves->curve_count; c++) {
        for (int64_t i = curves->first[c]; i + 1 < curves->first[c + 1]; i++) {
            set->emitter[set->count++] =
                emitter_cone(placed(t, curves->position[i]), placed(t, curves->position[i + 1]),
                             curves->radius[i] * scale, curves->radius[i + 1] * scale,
                             glow_at(curves, i), glow_at(curves, i + 1), number);
        }
    }
    for (int64_t c = 0; c < curves->curve_count; c++) {
        for (int end = 0; end < 2; end++) {
            int64_t tip = end ? curves->first[c + 1] - 1 : curves->first[c];
            Vec3 p = placed(t, curves->position[tip]);
            Vec3 next = placed(t, curves->position[end ? tip - 1 : tip + 1]);
            Vec3 axis = vec3_normalize(vec3_sub(p, next));
            set->emitter[set->count++] =
                emitter_cap(p, curves->radius[tip] * scale, axis, glow_at(curves, tip), number);
        }
    }
}

static bool add_part(EmitterSet *set, const World *world, int number, Error *e)
{
    const Part *part = &world->geometry.part[number];
    uint8_t *closed = NULL;
    if (part->kind == PART_MESH && part->mesh->face_count > 0) {
        closed = memory_alloc(part->mesh->face_count, 1, e);
        if (!closed || !mesh_closed_faces(part->mesh, closed, e)) {
            free(closed);
            return false;
        }
    }
    for (int64_t i = 0; i < copies(part); i++) {
        const Transform *t = part->instance ? &part->instance[i] : NULL;
        if (part->kind == PART_MESH) {
            add_triangles(set, part, number, closed, t);
        } else {
            add_curves(set, part, number, t);
        }
    }
    free(closed);
    return true;
}

static bool plant_tree(EmitterSet *set, const World *world, const Run *run, Error *e)
{
    LightBounds *bounds = memory_alloc(set->count, sizeof *bounds, e);
    for (int64_t i = 0; bounds && i < set->count; i++) {
        const Emitter *emitter = &set->emitter[i];
        int material = world->geometry.part[emitter->part].material;
        bounds[i] = emitter_bounds(emitter, luminance(world->material[material].radiance));
        set->box = i == 0 ? bounds[i].box : aabb_union(set->box, bounds[i].box);
    }
    set->tree = bounds ? light_tree_new(bounds, set->count, run, e) : NULL;
    free(bounds);
    return set->tree != NULL;
}

bool emitter_set_fill(EmitterSet *set, const World *world, const Run *run, Error *e)
{
    *set = (EmitterSet){0};
    int64_t total = 0;
    for (int64_t i = 0; i < world->geometry.count; i++) {
        const Part *part = &world->geometry.part[i];
        total += glows(world, part) ? pieces(part) * copies(part) : 0;
    }
    if (total == 0) {
        return true;
    }
    set->first = memory_alloc(world->geometry.count, sizeof *set->first, e);
    set->emitter = memory_alloc(total, sizeof *set->emitter, e);
    bool made = set->first && set->emitter;
    for (int64_t i = 0; made && i < world->geometry.count; i++) {
        const Part *part = &world->geometry.part[i];
        set->first[i] = glows(world, part) ? set->count : -1;
        made = set->first[i] < 0 || add_part(set, world, (int)i, e);
    }
    if (!made || !plant_tree(set, world, run, e)) {
        emitter_set_clear(set);
        return false;
    }
    return true;
}

void emitter_set_clear(EmitterSet *set)
{
    free(set->emitter);
    free(set->first);
    light_tree_free(set->tree);
    *set = (EmitterSet){0};
}

// Is the place beyond an end of the curve, if the segment is its first or last?
static bool beyond(const EmitterSet *set, int64_t cap, Vec3 position)
{
    return vec3_dot(vec3_sub(position, set->emitter[cap].a), set->emitter[cap].b) > 0.0f;
}

int64_t emitter_set_find(const EmitterSet *set, const World *world, const SurfacePlace *place,
                         Vec3 position)
{
    const Part *part = &world->geometry.part[place->part];
    int64_t first = set->first[place->part] + (int64_t)place->instance * pieces(part);
    if (part->kind == PART_MESH) {
        bool quad = part->mesh->face_size == 4;
        int64_t second = quad && place->u + place->v > 1.0f ? 1 : 0;
        return first + (int64_t)place->primitive * (quad ? 2 : 1) + second;
    }
    const CurveSet *curves = part->curves;
    int64_t curve =
        (int64_t)place->point - place->primitive; // each has one segment less than points
    int64_t caps = first + curves->point_count - curves->curve_count + 2 * curve;
    if (place->point == curves->first[curve] && beyond(set, caps, position)) {
        return caps;
    }
    if (place->point + 2 == curves->first[curve + 1] && beyond(set, caps + 1, position)) {
        return caps + 1;
    }
    return first + place->primitive;
}

float emitter_set_glow(const World *world, const SurfacePlace *place)
{
    const Part *part = &world->geometry.part[place->part];
    if (part->kind == PART_MESH || !part->curves->glow) {
        return 1.0f;
    }
    const float *glow = part->curves->glow + place->point;
    return lerpf(glow[0], glow[1], clampf(place->u, 0.0f, 1.0f));
}
