#include "objects/ice_cracks/crack_field.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_ACROSS = 4096 };

bool crack_field_new(CrackField *field, float size, float reach, Error *e)
{
    *field = (CrackField){.half = 0.5f * size, .cell = 1.3f * reach};
    float wanted = size / field->cell;
    field->across = wanted < (float)MOST_ACROSS ? (int32_t)wanted + 1 : MOST_ACROSS;
    field->cell =
        field->cell > size / (float)field->across ? field->cell : size / (float)field->across;
    int64_t cells = (int64_t)field->across * field->across;
    field->first = memory_alloc(cells, sizeof *field->first, e);
    if (!field->first) {
        return false;
    }
    memset(field->first, 0xff, (size_t)cells * sizeof *field->first); // -1
    return true;
}

void crack_field_clear(CrackField *field)
{
    free(field->first);
    free(field->segment);
    *field = (CrackField){0};
}

static int32_t cell_of(const CrackField *field, float x)
{
    float at = clampf((x + field->half) / field->cell, 0.0f, (float)(field->across - 1));
    return (int32_t)at;
}

bool crack_field_add(CrackField *field, Vec3 a, Vec3 b, int32_t crack, Error *e)
{
    if (!memory_reserve(&field->segment, &field->capacity, field->count + 1, sizeof *field->segment,
                        e)) {
        return false;
    }
    Vec3 middle = vec3_lerp(a, b, 0.5f);
    int32_t *first =
        &field->first[(int64_t)cell_of(field, middle.z) * field->across + cell_of(field, middle.x)];
    field->segment[field->count] = (CrackSegment){a, b, crack, *first};
    *first = (int32_t)field->count++;
    return true;
}

// ---- what lies near

// Calls with every segment whose middle may be within a cell's side of p.
typedef void (*SegmentVisit)(void *user, const CrackSegment *segment);

static void visit_near(const CrackField *field, Vec3 p, SegmentVisit visit, void *user)
{
    int32_t x0 = cell_of(field, p.x - field->cell), x1 = cell_of(field, p.x + field->cell);
    int32_t z0 = cell_of(field, p.z - field->cell), z1 = cell_of(field, p.z + field->cell);
    for (int32_t z = z0; z <= z1; z++) {
        for (int32_t x = x0; x <= x1; x++) {
            int32_t i = field->first[(int64_t)z * field->across + x];
            for (; i >= 0; i = field->segment[i].next) {
                visit(user, &field->segment[i]);
            }
        }
    }
}

typedef struct NearestVisit {
    Vec3 p;
    int32_t but;
    CrackContact *contact;
    bool found;
} NearestVisit;

static void visit_nearest(void *user, const CrackSegment *segment)
{
    NearestVisit *visit = user;
    Vec3 way = vec3_sub(segment->b, segment->a);
    float square = vec3_dot(way, way);
    if (segment->crack == visit->but || !(square > 0.0f)) {
        return;
    }
    float t = clampf(vec3_dot(vec3_sub(visit->p, segment->a), way) / square, 0.0f, 1.0f);
    Vec3 at = vec3_madd(segment->a, t, way);
    float distance = vec3_distance(visit->p, at);
    if (distance < visit->contact->distance) {
        *visit->contact = (CrackContact){distance, at, vec3_normalize(way)};
        visit->found = true;
    }
}

bool crack_field_nearest(const CrackField *field, Vec3 p, int32_t but, CrackContact *contact)
{
    *contact = (CrackContact){.distance = field->cell / 1.3f};
    NearestVisit visit = {.p = p, .but = but, .contact = contact};
    visit_near(field, p, visit_nearest, &visit);
    return visit.found;
}

typedef struct CrossingVisit {
    Vec3 a, way;
    float least; // share of the way
} CrossingVisit;

static float cross_plane(Vec3 a, Vec3 b)
{
    return a.x * b.z - a.z * b.x;
}

static void visit_crossing(void *user, const CrackSegment *segment)
{
    CrossingVisit *visit = user;
    Vec3 other = vec3_sub(segment->b, segment->a), between = vec3_sub(segment->a, visit->a);
    float area = cross_plane(visit->way, other);
    if (area == 0.0f) {
        return; // parallel
    }
    float t = cross_plane(between, other) / area, u = cross_plane(between, visit->way) / area;
    if (t >= 0.0f && t < visit->least && u >= 0.0f && u <= 1.0f) {
        visit->least = t;
    }
}

bool crack_field_crossing(const CrackField *field, Vec3 a, Vec3 b, Vec3 *at)
{
    CrossingVisit visit = {.a = a, .way = vec3_sub(b, a), .least = 2.0f};
    visit_near(field, a, visit_crossing, &visit);
    if (visit.least > 1.0f) {
        return false;
    }
    *at = vec3_madd(a, visit.least, visit.way);
    return true;
}
