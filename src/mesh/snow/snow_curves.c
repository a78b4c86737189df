// Snow along branches: rings of a cushion's outline, swept over the parts of a branch that are
// level enough.
#include "mesh/snow/snow.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"

#include <math.h>
#include <stdlib.h>

enum { RING_POINTS = 8 };
enum { STREAM_GAPS = 1, STREAM_LUMPS = 2 }; // of a curve

#define SPACING_LEAST 0.022f // m between rings
#define GAP_LENGTH 0.35f     // m along a branch, about, of a gap
#define LUMP_LENGTH 2.2f     // of a lump, in depths
#define THIN 0.12f           // of the full depth: thinner snow is left out

// Outline across the branch, from its right lower edge over the top to the left: x in half widths,
// y from inside the branch (0) to the top (1). Overhanging, as wet snow is.
static const Vec2 OUTLINE[RING_POINTS] = {
    {0.55f, 0.0f},   {1.0f, 0.34f},   {0.88f, 0.70f}, {0.42f, 0.97f},
    {-0.42f, 0.97f}, {-0.88f, 0.70f}, {-1.0f, 0.34f}, {-0.55f, 0.0f},
};

// A section of a cushion.
typedef struct Ring {
    Vec3 center, side, up; // m, the branch's axis; unit
    float half, low, high; // m: half the width, lower and upper edge above the axis
    bool bears;            // snow lies here; otherwise the section lies inside the branch
    bool joined;           // to the ring before it
} Ring;

typedef struct RingList {
    Ring *ring;
    int64_t count, capacity;
} RingList;

typedef struct Drift {
    const SnowParams *params;
    const SnowReach *reach;
    RingList branch; // of the curve at hand
    RingList all;    // of all cushions
} Drift;

float snow_stays(const SnowParams *params, float level)
{
    float sine, cosine;
    exact_sincos(params->steepest * RADIANS_PER_DEGREE, &sine, &cosine);
    return smoothstepf(cosine, cosine + 0.5f * (1.0f - cosine) + 1e-4f, level);
}

// Snow bridges a twig's own width and a little more.
static float depth_on(float depth, float radius)
{
    float width = 2.0f * radius + 0.003f;
    return depth * (float)(1.0 - exact_exp(-1.7 * (double)(width / depth)));
}

static float gap_at(const SnowParams *params, float along, uint64_t key)
{
    if (params->gaps <= 0.0f) {
        return 1.0f;
    }
    float wave = noise_plane(along / GAP_LENGTH, 0.0f, random_key(key, STREAM_GAPS));
    float edge = -0.5f + params->gaps; // noise is about -0.5 .. 0.5
    return smoothstepf(edge - 0.08f, edge + 0.08f, wave);
}

// The section at a point of a branch, `way` (m) from its start.
static Ring ring_at(const Drift *drift, Vec3 p, Vec3 along, float radius, float way, uint64_t key)
{
    const SnowParams *params = drift->params;
    float level = sqrtf(fmaxf(0.0f, 1.0f - along.y * along.y));
    Vec3 up = level > 1e-3f ? vec3_madd(vec3(0, 1, 0), -along.y, along) : vec3_perpendicular(along);
    float full = depth_on(params->depth, radius);
    float lump =
        noise_plane(way / (LUMP_LENGTH * full + 0.02f), 0.5f, random_key(key, STREAM_LUMPS));
    float height = full * (1.0f + 0.7f * lump) * snow_stays(params, level) *
                   gap_at(params, way, key) * drift->reach->share(drift->reach->user, p);
    Ring ring = {.center = p, .up = vec3_normalize(up), .bears = height > THIN * full};
    ring.side = vec3_cross(along, ring.up);
    ring.half = ring.bears ? 0.92f * radius + 0.35f * height : 0.6f * radius;
    ring.low = 0.2f * radius;
    ring.high = ring.bears ? radius + height : 0.8f * radius;
    return ring;
}

static bool add_ring(RingList *list, Ring ring, Error *e)
{
    if (!memory_reserve(&list->ring, &list->capacity, list->count + 1, sizeof ring, e)) {
        return false;
    }
    list->ring[list->count++] = ring;
    return true;
}

// Sections along a curve, closer on thin branches, whose cushions are low.
static bool sample_curve(Drift *drift, const CurveSet *curves, int64_t curve, Error *e)
{
    float way = 0.0f, until = 0.0f;
    drift->branch.count = 0;
    for (int64_t i = curves->first[curve]; i + 1 < curves->first[curve + 1]; i++) {
        Vec3 a = curves->position[i], b = curves->position[i + 1];
        float length = vec3_distance(a, b);
        Vec3 along = vec3_normalize(vec3_sub(b, a));
        while (until < length) {
            float t = until / length, radius = lerpf(curves->radius[i], curves->radius[i + 1], t);
            if (!add_ring(&drift->branch,
                          ring_at(drift, vec3_lerp(a, b, t), along, radius, way + until,
                                  curves->id[curve]),
                          e)) {
                return false;
            }
            until += fmaxf(SPACING_LEAST, 1.1f * depth_on(drift->params->depth, radius));
        }
        until -= length;
        way += length;
    }
    return true;
}

// Keeps the sections that bear snow and, as the ends of their cushions, those beside them.
static bool keep_cushions(Drift *drift, Error *e)
{
    const Ring *ring = drift->branch.ring;
    int64_t last = drift->branch.count - 1;
    bool before = false; // the section before is kept
    for (int64_t i = 0; i <= last; i++) {
        bool kept =
            ring[i].bears || (i > 0 && ring[i - 1].bears) || (i < last && ring[i + 1].bears);
        if (kept) {
            Ring copy = ring[i];
            copy.joined = before && (ring[i].bears || ring[i - 1].bears);
            if (!add_ring(&drift->all, copy, e)) {
                return false;
            }
        }
        before = kept;
    }
    return true;
}

static Mesh *mesh_of(const RingList *list, Error *e)
{
    int64_t joints = 0;
    for (int64_t i = 0; i < list->count; i++) {
        joints += list->ring[i].joined;
    }
    Mesh *mesh = mesh_new(4, list->count * RING_POINTS, joints * RING_POINTS, MESH_NORMAL, e);
    if (!mesh) {
        return NULL;
    }
    uint32_t *corner = mesh->index;
    for (int64_t i = 0; i < list->count; i++) {
        const Ring *ring = &list->ring[i];
        uint32_t here = (uint32_t)(i * RING_POINTS);
        for (uint32_t k = 0; k < RING_POINTS; k++) {
            Vec3 across = vec3_madd(ring->center, ring->half * OUTLINE[k].x, ring->side);
            mesh->position[here + k] =
                vec3_madd(across, lerpf(ring->low, ring->high, OUTLINE[k].y), ring->up);
            uint32_t next = (k + 1) % RING_POINTS;
            if (ring->joined) {
                *corner++ = here - RING_POINTS + k;
                *corner++ = here - RING_POINTS + next;
                *corner++ = here + next;
                *corner++ = here + k;
            }
        }
    }
    return mesh;
}

static bool gather(Drift *drift, const CurveSet *curves, const bool *bare, const Run *run, Error *e)
{
    bool done = true;
    for (int64_t i = 0; done && i < curves->curve_count; i++) {
        done =
            run_goes_on(run, i, e) &&
            ((bare && bare[i]) || (sample_curve(drift, curves, i, e) && keep_cushions(drift, e)));
    }
    return done;
}

Mesh *snow_on_curves(const CurveSet *curves, const bool *bare, const SnowParams *params,
                     const SnowReach *reach, const Run *run, Error *e)
{
    Drift drift = {.params = params, .reach = reach};
    Mesh *mesh = gather(&drift, curves, bare, run, e) ? mesh_of(&drift.all, e) : NULL;
    if (mesh && !mesh_compute_normals(mesh, e)) {
        mesh_free(mesh);
        mesh = NULL;
    }
    free(drift.branch.ring);
    free(drift.all.ring);
    return mesh;
}
