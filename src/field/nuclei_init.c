// Collects the points and lines of a field's nuclei.
#include "base/memory.h"
#include "field/nuclei.h"
#include "shape/points.h"

#include <stdlib.h>

enum { SURFACE_POINTS = 20000, SURFACE_SEED = 1 };

// The points while they are collected.
typedef struct PointList {
    Vec3 *position, *normal; // owned
    int64_t count, position_capacity, normal_capacity;
} PointList;

static bool add_point(PointList *list, Vec3 position, Vec3 normal, Error *e)
{
    if (!memory_reserve(&list->position, &list->position_capacity, list->count + 1,
                        sizeof *list->position, e) ||
        !memory_reserve(&list->normal, &list->normal_capacity, list->count + 1,
                        sizeof *list->normal, e)) {
        return false;
    }
    list->position[list->count] = position;
    list->normal[list->count++] = normal;
    return true;
}

static bool add_surface(PointList *list, const Nucleus *nucleus, Vec3 normal, const Run *run,
                        Error *e)
{
    EnvelopeParams params = {.shapes = nucleus->shapes, .shape_count = nucleus->shape_count};
    ScatterParams scatter = scatter_params_default();
    scatter.place = SCATTER_SURFACE;
    scatter.pattern = SCATTER_POISSON;
    scatter.count = SURFACE_POINTS;
    scatter.seed = SURFACE_SEED;
    Envelope *envelope = envelope_new(&params, run, e);
    PointSet *points = envelope ? points_scatter(envelope, &scatter, run, e) : NULL;
    bool done = points != NULL;
    for (int64_t i = 0; done && i < points->count; i++) {
        done = add_point(list, points->position[i], normal, e);
    }
    points_free(points);
    envelope_free(envelope);
    return done;
}

static Vec3 normal_of(const Nucleus *nucleus)
{
    if (vec3_dot(nucleus->normal, nucleus->normal) > 0.0f) {
        return nucleus->normal;
    }
    return nucleus->kind == NUCLEUS_LINE ? vec3_normalize(vec3_sub(nucleus->end, nucleus->position))
                                         : vec3(0, 1, 0);
}

static bool collect(Nuclei *nuclei, PointList *list, const Nucleus *nucleus, int count,
                    const Run *run, Error *e)
{
    for (int i = 0; i < count; i++) {
        Vec3 normal = normal_of(&nucleus[i]);
        bool done = true;
        switch (nucleus[i].kind) {
        case NUCLEUS_POINT:
            done = add_point(list, nucleus[i].position, normal, e);
            break;
        case NUCLEUS_LINE:
            nuclei->line[nuclei->line_count++] =
                (NucleusLine){nucleus[i].position, nucleus[i].end, normal};
            break;
        case NUCLEUS_SURFACE:
            done = add_surface(list, &nucleus[i], normal, run, e) || error_key(e, "%d", i);
            break;
        }
        if (!done) {
            return false;
        }
    }
    return true;
}

bool nuclei_init(Nuclei *nuclei, const Vec3 *position, const Vec3 *normal, int64_t count,
                 Aabb bounds, Error *e)
{
    *nuclei = (Nuclei){.bounds = bounds};
    nuclei->normal = memory_alloc(count, sizeof *nuclei->normal, e);
    if (!nuclei->normal || !point_tree_init(&nuclei->points, position, count, e)) {
        return false;
    }
    for (int64_t i = 0; i < count; i++) {
        nuclei->normal[i] = normal ? normal[i] : vec3(0, 1, 0);
    }
    return true;
}

bool nuclei_init_named(Nuclei *nuclei, const Nucleus *nucleus, int count, Aabb bounds,
                       const Run *run, Error *e)
{
    PointList list = {0};
    *nuclei = (Nuclei){.bounds = bounds};
    nuclei->line = memory_alloc(count, sizeof *nuclei->line, e);
    bool done = nuclei->line && collect(nuclei, &list, nucleus, count, run, e) &&
                point_tree_init(&nuclei->points, list.position, list.count, e);
    nuclei->normal = list.normal;
    free(list.position);
    return done;
}

void nuclei_free(Nuclei *nuclei)
{
    point_tree_free(&nuclei->points);
    free(nuclei->normal);
    free(nuclei->line);
    *nuclei = (Nuclei){0};
}
