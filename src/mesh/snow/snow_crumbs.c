// Crumbs: what snow remains on needles and twigs beside the pillows, and at their rims.
#include "mesh/snow/snow_crumbs.h"

#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"

#include <math.h>
#include <stdlib.h>

enum { STREAM_PATCHES = 31, STREAM_CRUMBS = 32 }; // of a bough

#define UNDER_TOP 0.04f    // m: what lies lower below the top of its place is sheltered by it
#define COVERED 0.7f       // cells: how far inside of the outline a crumb still shows
#define PATCH_LENGTH 0.16f // m, about: of twigs that have lost theirs
#define SMALLEST 0.3f      // of the largest radius

// The highest bearer of the bed at every point, m; -INFINITY where there is none.
static float *tops(const SnowBed *bed, const SnowBearer *bearer, int64_t count, Error *e)
{
    int64_t points = (int64_t)bed->across * bed->along;
    float *top = memory_alloc(points, sizeof *top, e);
    for (int64_t i = 0; top && i < points; i++) {
        top[i] = -INFINITY;
    }
    for (int64_t i = 0; top && i < count; i++) {
        int64_t at = snow_bed_entry(bed, bearer[i].p);
        top[at] = fmaxf(top[at], bearer[i].p.y);
    }
    return top;
}

// Radius (m) of the crumb on a bearer, 0 = none; noise places patches with and without them.
static float radius_at(const SnowParams *params, const SnowReach *reach, Vec3 p, uint64_t seed,
                       uint64_t key)
{
    float patch = noise_plane(p.x / PATCH_LENGTH, p.z / PATCH_LENGTH,
                              random_key(seed, STREAM_PATCHES)); // about -0.5 .. 0.5
    float share = reach->share(reach->user, p) *
                  smoothstepf(-0.35f, 0.15f, patch + 0.25f - 0.6f * params->gaps);
    float u = random_unit(random_key(key, 0));
    if (random_unit(random_key(key, 1)) >= share) {
        return 0.0f;
    }
    return 0.5f * params->crumbs * lerpf(SMALLEST, 1.0f, u * u) * (0.6f + 0.4f * share);
}

static bool add_crumb(SnowCrumbs *crumbs, Vec3 p, float radius, Error *e)
{
    if (!memory_reserve(&crumbs->crumb, &crumbs->capacity, crumbs->count + 1, sizeof *crumbs->crumb,
                        e)) {
        return false;
    }
    p.y += 0.3f * radius;
    crumbs->crumb[crumbs->count++] = (SnowCrumb){p, radius};
    return true;
}

bool snow_add_crumbs(SnowCrumbs *crumbs, const SnowBed *bed, const SnowBearer *bearer,
                     int64_t count, const SnowParams *params, const SnowReach *reach, uint64_t seed,
                     Error *e)
{
    float *top = tops(bed, bearer, count, e);
    bool done = top;
    for (int64_t i = 0; done && i < count; i++) {
        Vec3 p = bearer[i].p;
        int64_t at = snow_bed_entry(bed, p);
        if (p.y < top[at] - UNDER_TOP || snow_bed_passes(bed, p) ||
            bed->outline[at] > COVERED * bed->cell) {
            continue;
        }
        uint64_t key = random_key(random_key(seed, STREAM_CRUMBS), (uint64_t)i);
        float radius = radius_at(params, reach, p, seed, key);
        done = radius <= 0.0f || add_crumb(crumbs, p, radius, e);
    }
    free(top);
    return done;
}
