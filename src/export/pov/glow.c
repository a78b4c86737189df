// Emitting geometry as a few point lights along it, because surfaces that emit light nothing in
// POV-Ray.
#include "export/pov/pov.h"

#include "base/color.h"
#include "base/memory.h"

#include <stdlib.h>

enum { FINEST = 12, MOST_LIGHTS = 64 };

// Light gathered in a cell of a grid.
typedef struct Cell {
    double power[3]; // radiance times mean projected area (m^2)
    double place[3], square, weight;
} Cell;

typedef struct Glow {
    const World *world;
    uint8_t **closed; // owned: of each part, which of its faces shine outward only; or NULL
    Aabb box;
    int side; // cells along each axis
    Cell *cell;
} Glow;

static int place_on(float p, float low, float high, int side)
{
    int i = high > low ? (int)((p - low) / (high - low) * (float)side) : 0;
    return i < 0 ? 0 : (i >= side ? side - 1 : i);
}

static void add_point(Glow *glow, Vec3 p, Vec3 power)
{
    if (!glow->cell) {
        glow->box = aabb_add(glow->box, p);
        return;
    }
    int x = place_on(p.x, glow->box.low.x, glow->box.high.x, glow->side);
    int y = place_on(p.y, glow->box.low.y, glow->box.high.y, glow->side);
    int z = place_on(p.z, glow->box.low.z, glow->box.high.z, glow->side);
    Cell *cell = &glow->cell[(x * glow->side + y) * glow->side + z];
    double weight = (double)luminance(power);
    cell->power[0] += (double)power.x;
    cell->power[1] += (double)power.y;
    cell->power[2] += (double)power.z;
    cell->place[0] += weight * (double)p.x;
    cell->place[1] += weight * (double)p.y;
    cell->place[2] += weight * (double)p.z;
    cell->square += weight * (double)vec3_dot(p, p);
    cell->weight += weight;
}

// The mean projected area of a convex body is a quarter of its surface. Long segments become
// several points.
static void add_segment(Glow *glow, const Material *m, const CurveSet *curves, int64_t i,
                        const Transform *place)
{
    enum { PIECES = 4 };
    Vec3 a = curves->position[i], b = curves->position[i + 1];
    float length = vec3_distance(a, b);
    float scale = 1.0f;
    if (place) {
        Vec3 pa = transform_point(place, a), pb = transform_point(place, b);
        scale = length > 0.0f ? vec3_distance(pa, pb) / length : 1.0f;
        a = pa;
        b = pb;
    }
    for (int k = 0; k < PIECES; k++) {
        float t = ((float)k + 0.5f) / PIECES;
        float radius = lerpf(curves->radius[i], curves->radius[i + 1], t);
        float glowing = curves->glow ? lerpf(curves->glow[i], curves->glow[i + 1], t) : 1.0f;
        float area = 2.0f * PI_F * radius * length / PIECES * scale * scale;
        add_point(glow, vec3_lerp(a, b, t), vec3_scale(m->radiance, 0.25f * area * glowing));
    }
}

// A quarter of the emitting area: the outside of a closed body, both sides of a sheet.
static void add_face(Glow *glow, const Material *m, const Mesh *mesh, int64_t face,
                     const Transform *place, float share)
{
    const uint32_t *corner = mesh->index + face * mesh->face_size;
    Vec3 p[4];
    for (int k = 0; k < mesh->face_size; k++) {
        p[k] =
            place ? transform_point(place, mesh->position[corner[k]]) : mesh->position[corner[k]];
    }
    for (int k = 2; k < mesh->face_size; k++) {
        Vec3 across = vec3_cross(vec3_sub(p[k - 1], p[0]), vec3_sub(p[k], p[0]));
        Vec3 middle = vec3_scale(vec3_add(p[0], vec3_add(p[k - 1], p[k])), 1.0f / 3.0f);
        add_point(glow, middle, vec3_scale(m->radiance, share * vec3_length(across)));
    }
}

// closed: one per face of a mesh, or NULL.
static void add_part(Glow *glow, const Part *part, const uint8_t *closed, const Material *m,
                     const Transform *place)
{
    if (part->kind == PART_MESH) {
        for (int64_t f = 0; f < part->mesh->face_count; f++) {
            add_face(glow, m, part->mesh, f, place, closed[f] ? 0.125f : 0.25f);
        }
        return;
    }
    const CurveSet *curves = part->curves;
    for (int64_t k = 0; k < curves->curve_count; k++) {
        for (int64_t i = curves->first[k]; i + 1 < curves->first[k + 1]; i++) {
            add_segment(glow, m, curves, i, place);
        }
    }
}

static void add_all(Glow *glow)
{
    const Geometry *geometry = &glow->world->geometry;
    for (int64_t i = 0; i < geometry->count; i++) {
        const Part *part = &geometry->part[i];
        const Material *m = &glow->world->material[part->material];
        if (!material_has(m, TRAIT_EMISSIVE)) {
            continue;
        }
        for (int64_t k = 0; k < (part->instance ? part->instance_count : 1); k++) {
            add_part(glow, part, glow->closed[i], m, part->instance ? &part->instance[k] : NULL);
        }
    }
}

static bool find_closed(Glow *glow, Error *e)
{
    const Geometry *geometry = &glow->world->geometry;
    glow->closed = memory_alloc_zero(geometry->count, sizeof *glow->closed, e);
    for (int64_t i = 0; glow->closed && i < geometry->count; i++) {
        const Part *part = &geometry->part[i];
        if (part->kind != PART_MESH || part->mesh->face_count < 1 ||
            !material_has(&glow->world->material[part->material], TRAIT_EMISSIVE)) {
            continue;
        }
        glow->closed[i] = memory_alloc(part->mesh->face_count, 1, e);
        if (!glow->closed[i] || !mesh_closed_faces(part->mesh, glow->closed[i], e)) {
            return false;
        }
    }
    return glow->closed != NULL;
}

static void glow_clear(Glow *glow)
{
    for (int64_t i = 0; glow->closed && i < glow->world->geometry.count; i++) {
        free(glow->closed[i]);
    }
    free(glow->closed);
    free(glow->cell);
}

// Fills the finest grid that has few enough lit cells; returns their number.
static int fill_grid(Glow *glow)
{
    for (glow->side = FINEST;; glow->side--) {
        int64_t cells = (int64_t)glow->side * glow->side * glow->side;
        for (int64_t i = 0; i < cells; i++) {
            glow->cell[i] = (Cell){0};
        }
        add_all(glow);
        int lit = 0;
        for (int64_t i = 0; i < cells; i++) {
            lit += glow->cell[i].weight > 0.0;
        }
        if (lit <= MOST_LIGHTS || glow->side == 1) {
            return lit;
        }
    }
}

// fade_distance limits the light's strength inside of the geometry that it stands for.
static void write_light(Pov *pov, const Cell *cell)
{
    Vec3 place =
        vec3((float)(cell->place[0] / cell->weight), (float)(cell->place[1] / cell->weight),
             (float)(cell->place[2] / cell->weight));
    float spread = (float)(cell->square / cell->weight) - vec3_dot(place, place);
    float fade = fmaxf(0.3f * sqrtf(fmaxf(spread, 0.0f)), 1e-4f * pov->radius);
    Vec3 power = vec3((float)cell->power[0], (float)cell->power[1], (float)cell->power[2]);
    file_writer_text(pov->out, "light_source { ");
    pov_point(pov, place);
    file_writer_text(pov->out, " rgb ");
    pov_vector(pov, vec3_scale(power, 1.0f / (2.0f * PI_F * fade * fade)));
    file_writer_print(pov->out, " fade_distance %.9g fade_power 2 }\n", (double)(fade * pov->unit));
}

bool pov_glow(Pov *pov)
{
    Glow glow = {.world = pov->world, .box = aabb_empty()};
    if (!find_closed(&glow, pov->e)) {
        glow_clear(&glow);
        return false;
    }
    add_all(&glow);
    if (aabb_is_empty(glow.box)) {
        glow_clear(&glow);
        return true;
    }
    glow.cell = memory_alloc((int64_t)FINEST * FINEST * FINEST, sizeof *glow.cell, pov->e);
    if (!glow.cell) {
        glow_clear(&glow);
        return false;
    }
    pov->glow_lights = fill_grid(&glow) > 0;
    for (int i = 0; i < glow.side * glow.side * glow.side; i++) {
        if (glow.cell[i].weight > 0.0) {
            write_light(pov, &glow.cell[i]);
        }
    }
    file_writer_text(pov->out, "\n");
    glow_clear(&glow);
    return true;
}
