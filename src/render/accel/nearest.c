#include "render/accel/nearest.h"

#include "base/memory.h"
#include "base/triangle.h"
#include "mesh/cover.h"

#include <embree3/rtcore.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

// A triangle, or a round segment from a to b with radii r[0] and r[1].
typedef struct Piece {
    Vec3 a, b, c;
    float r[2];
    bool round;
} Piece;

struct Nearest {
    Piece *piece;
    int64_t count, capacity;
    Cover *cover; // tells inside from outside
    RTCDevice device;
    RTCScene scene;
};

typedef struct Query {
    const Nearest *nearest;
    Vec3 p, point; // the nearest point so far
    float best;    // m: its distance; negative in a round segment
    uint32_t primitive;
    bool found;
} Query;

// Nearest point of a segment's axis; *radius there.
static Vec3 on_axis(const Piece *s, Vec3 p, float *radius)
{
    Vec3 way = vec3_sub(s->b, s->a);
    float length2 = vec3_dot(way, way);
    float t =
        length2 > 0.0f ? clampf(vec3_dot(vec3_sub(p, s->a), way) / length2, 0.0f, 1.0f) : 0.0f;
    *radius = lerpf(s->r[0], s->r[1], t);
    return vec3_madd(s->a, t, way);
}

static bool visit(struct RTCPointQueryFunctionArguments *args)
{
    Query *q = args->userPtr;
    const Piece *piece = &q->nearest->piece[args->primID];
    float radius = 0.0f;
    Vec3 point = piece->round ? on_axis(piece, q->p, &radius)
                              : triangle_nearest(piece->a, piece->b, piece->c, q->p);
    float distance = vec3_distance(point, q->p) - radius;
    // ties go to the first piece: the order of traversal does not show
    if (distance > q->best || (distance == q->best && q->found && args->primID >= q->primitive)) {
        return false;
    }
    q->best = distance;
    q->point = point;
    q->primitive = args->primID;
    q->found = true;
    // a little more than the distance, so that rounding in Embree's culling loses no tie
    args->query->radius = distance > 0.0f ? distance * 1.00001f : 0.0f;
    return true;
}

// The nearest piece within reach.
static Query search(const Nearest *nearest, Vec3 p, float reach)
{
    Query q = {.nearest = nearest, .p = p, .best = reach};
    struct RTCPointQuery query = {.x = p.x, .y = p.y, .z = p.z, .radius = reach};
    struct RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(nearest->scene, &query, &context, visit, &q);
    return q;
}

float nearest_distance(const Nearest *nearest, Vec3 p, float reach, Vec3 *away)
{
    Query q = search(nearest, p, reach);
    bool inside = cover_hides(nearest->cover, p);
    *away = vec3(0, 0, 0);
    if (!q.found) {
        return inside ? -reach : reach;
    }
    bool round = nearest->piece[q.primitive].round;
    Vec3 outward = vec3_sub(p, q.point);
    *away = vec3_normalize(inside && !round ? vec3_scale(outward, -1.0f) : outward);
    return inside && !round ? -q.best : q.best;
}

void nearest_point(const Nearest *nearest, Vec3 *p, Vec3 *normal)
{
    Query q = search(nearest, *p, INFINITY);
    if (!q.found) {
        return;
    }
    const Piece *piece = &nearest->piece[q.primitive];
    float radius = 0.0f;
    Vec3 point = piece->round ? on_axis(piece, *p, &radius) : q.point;
    Vec3 out = piece->round
                   ? vec3_sub(*p, point)
                   : vec3_cross(vec3_sub(piece->b, piece->a), vec3_sub(piece->c, piece->a));
    if (vec3_length(out) > 0.0f) { // else a degenerate triangle, or p on the axis
        *normal = vec3_normalize(out);
    }
    *p = vec3_madd(point, radius, *normal);
}

// ---- making

static bool add_mesh(Nearest *n, const Mesh *mesh, Error *e)
{
    int64_t more = mesh->face_count * (mesh->face_size - 2);
    if (!cover_add(n->cover, mesh, e) ||
        !memory_reserve(&n->piece, &n->capacity, n->count + more, sizeof *n->piece, e)) {
        return false;
    }
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *corner = mesh->index + f * mesh->face_size;
        for (int k = 2; k < mesh->face_size; k++) {
            n->piece[n->count++] = (Piece){.a = mesh->position[corner[0]],
                                           .b = mesh->position[corner[k - 1]],
                                           .c = mesh->position[corner[k]]};
        }
    }
    return true;
}

static bool add_curves(Nearest *n, const CurveSet *curves, Error *e)
{
    int64_t more = curves->point_count - curves->curve_count;
    if (!memory_reserve(&n->piece, &n->capacity, n->count + more, sizeof *n->piece, e)) {
        return false;
    }
    for (int64_t c = 0; c < curves->curve_count; c++) {
        for (int64_t i = curves->first[c] + 1; i < curves->first[c + 1]; i++) {
            n->piece[n->count++] = (Piece){.a = curves->position[i - 1],
                                           .b = curves->position[i],
                                           .r = {curves->radius[i - 1], curves->radius[i]},
                                           .round = true};
        }
    }
    return true;
}

static void bounds(const struct RTCBoundsFunctionArguments *args)
{
    const Nearest *n = args->geometryUserPtr;
    const Piece *piece = &n->piece[args->primID];
    Aabb box = aabb_add(aabb_add(aabb_empty(), piece->a), piece->b);
    box = piece->round ? box : aabb_add(box, piece->c);
    float r = fmaxf(piece->r[0], piece->r[1]);
    *args->bounds_o = (struct RTCBounds){box.low.x - r,  box.low.y - r,  box.low.z - r,  0,
                                         box.high.x + r, box.high.y + r, box.high.z + r, 0};
}

static bool build(Nearest *n, const Run *run, Error *e)
{
    char config[32];
    snprintf(config, sizeof config, "threads=%d", run->threads);
    n->device = rtcNewDevice(config);
    n->scene = n->device ? rtcNewScene(n->device) : NULL;
    if (!n->scene) {
        return error_set(e, ERROR_MEMORY, "out of memory while Embree starts");
    }
    RTCGeometry geometry = rtcNewGeometry(n->device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, (unsigned)n->count);
    rtcSetGeometryUserData(geometry, n);
    rtcSetGeometryBoundsFunction(geometry, bounds, NULL);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(n->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(n->scene);
    return rtcGetDeviceError(n->device) == RTC_ERROR_NONE ||
           error_set(e, ERROR_MEMORY, "out of memory for the search tree of %lld surfaces",
                     (long long)n->count);
}

Nearest *nearest_new(const Geometry *geometry, const Run *run, Error *e)
{
    Nearest *n = memory_alloc_zero(1, sizeof *n, e);
    bool done = n && (n->cover = cover_new(e));
    for (int64_t i = 0; done && i < geometry->count; i++) {
        const Part *part = &geometry->part[i];
        done = part->instance || (part->mesh ? add_mesh(n, part->mesh, e)
                                             : !part->curves || add_curves(n, part->curves, e));
    }
    if (done && cover_finish(n->cover, e) && build(n, run, e)) {
        return n;
    }
    nearest_free(n);
    return NULL;
}

void nearest_free(Nearest *nearest)
{
    if (nearest) {
        if (nearest->scene) {
            rtcReleaseScene(nearest->scene);
        }
        if (nearest->device) {
            rtcReleaseDevice(nearest->device);
        }
        cover_free(nearest->cover);
        free(nearest->piece);
        free(nearest);
    }
}
