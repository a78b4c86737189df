#include "objects/common/leaf_season.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"

#include <stdlib.h>

// Of a leaf that is shed.
enum {
    STREAM_LITTER = 3,
    STREAM_DRIFT = 4,
    STREAM_AZIMUTH = 5,
    STREAM_TILT = 6,
    STREAM_FACE = 7,
    STREAM_HEADING = 8,
    STREAM_LIFT = 9,
    STREAM_GUST = 10
};

// A leaf of a batch, and when its turn comes.
typedef struct Ranked {
    float when;     // 0..1: early to late
    int32_t batch;  // that it belongs to
    int64_t number; // in the batch
    uint64_t key;
} Ranked;

static int by_time(const void *a, const void *b)
{
    const Ranked *x = a, *y = b;
    if (x->when != y->when) {
        return x->when < y->when ? -1 : 1;
    }
    return x->batch != y->batch ? (x->batch < y->batch ? -1 : 1) : (x->number < y->number ? -1 : 1);
}

static Vec3 place_of(const LeafBatch *batch, int64_t i)
{
    const Transform *t = &batch->instance[i];
    return vec3(t->m[0][3], t->m[1][3], t->m[2][3]);
}

static Aabb bounds_of(const LeafBatch *batch, int count)
{
    Aabb box = aabb_empty();
    for (int b = 0; b < count; b++) {
        for (int64_t i = 0; i < batch[b].count; i++) {
            box = aabb_add(box, place_of(&batch[b], i));
        }
    }
    return box;
}

// 0 in the middle of the crown's lower end .. 1 at its top and rim.
static float exposure(Vec3 p, Aabb box)
{
    Vec3 half = vec3_scale(vec3_sub(box.high, box.low), 0.5f);
    Vec3 from = vec3_sub(p, vec3_add(box.low, half));
    float wide = fmaxf(fmaxf(half.x, half.z), 1e-6f);
    float out = sqrtf(from.x * from.x + from.z * from.z) / wide;
    float up = half.y > 0.0f ? 0.5f + 0.5f * from.y / half.y : 0.5f;
    return clampf(0.5f * fminf(out, 1.0f) + 0.5f * up, 0.0f, 1.0f);
}

// All leaves in the order in which they turn or fall. The caller frees the list.
static Ranked *rank(const LeafBatch *batch, int count, int64_t total, uint64_t seed, Error *e)
{
    Ranked *ranked = memory_alloc(total, sizeof *ranked, e);
    Aabb box = bounds_of(batch, count);
    int64_t n = 0;
    for (int b = 0; ranked && b < count; b++) {
        for (int64_t i = 0; i < batch[b].count; i++) {
            uint64_t key = random_key(random_key(seed, (uint64_t)b), (uint64_t)i);
            float own = random_unit(key), outside = exposure(place_of(&batch[b], i), box);
            ranked[n++] = (Ranked){0.45f * own + 0.55f * (1.0f - outside), b, i, key};
        }
    }
    if (ranked) {
        qsort(ranked, (size_t)total, sizeof *ranked, by_time);
    }
    return ranked;
}

// A leaf turns over a span of the ranks, so that at any time some are between the colours.
static void turn(const LeavesParams *leaves, LeafBatch *batch, const Ranked *ranked, int64_t total)
{
    const float span = 0.3f;
    for (int64_t i = 0; i < total; i++) {
        float at = ((float)i + 0.5f) / (float)total;
        float turned = clampf((leaves->autumn * (1.0f + span) - at) / span, 0.0f, 1.0f);
        if (turned > 0.0f) {
            float *season = &batch[ranked[i].batch].season[ranked[i].number];
            *season = fmaxf(*season, turned); // a withered one stays so
        }
    }
}

// Where a leaf that fell from p lies: the farther it fell, the farther the wind took it; either
// side up, slightly tilted, as large as it was.
static Transform lying(const Transform *hanging, Vec3 p, const Land *land, uint64_t key)
{
    float sine, cosine;
    float fall = fmaxf(p.y - land_height(land, p.x, p.z), 0.0f);
    float gust = random_unit(random_key(key, STREAM_GUST));
    float drift = (0.3f + 0.35f * fall) * (0.6f + 0.9f * gust * gust) *
                  sqrtf(random_unit(random_key(key, STREAM_DRIFT)));
    exact_sincos(random_range(random_key(key, STREAM_AZIMUTH), 0.0f, 2.0f * PI_F), &sine, &cosine);
    p.x += drift * sine;
    p.z += drift * cosine;
    p.y = land_height(land, p.x, p.z) + random_range(random_key(key, STREAM_LIFT), 0.004f, 0.03f);
    Vec3 z = vec3_normalize(
        vec3_madd(vec3(0, 1, 0), 0.3f, random_direction(random_key(key, STREAM_TILT))));
    if (random_unit(random_key(key, STREAM_FACE)) < 0.4f) {
        z = vec3_neg(z);
    }
    Vec3 y = vec3_normalize(vec3_cross(z, random_direction(random_key(key, STREAM_HEADING))));
    float size = vec3_length(vec3(hanging->m[0][1], hanging->m[1][1], hanging->m[2][1]));
    return transform_from_axes(vec3_scale(vec3_cross(y, z), size), vec3_scale(y, size),
                               vec3_scale(z, size), p);
}

// Lays the shed leaf down, or marks it to be removed by a season beyond the range.
static void shed_one(LeafBatch *batch, const Ranked *leaf, const LeavesParams *leaves,
                     const Land *land)
{
    enum { GONE = 2 };
    uint64_t key = random_key(leaf->key, STREAM_LITTER);
    bool lies = random_unit(key) < leaves->litter;
    Transform *instance = &batch->instance[leaf->number];
    if (lies) {
        *instance = lying(instance, place_of(batch, leaf->number), land, key);
    }
    batch->season[leaf->number] = lies ? 1.0f : (float)GONE;
}

static void remove_gone(LeafBatch *batch)
{
    int64_t kept = 0;
    for (int64_t i = 0; i < batch->count; i++) {
        if (batch->season[i] <= 1.0f) {
            batch->instance[kept] = batch->instance[i];
            batch->variation[kept] = batch->variation[i];
            batch->season[kept++] = batch->season[i];
        }
    }
    batch->count = kept;
}

bool leaf_season_apply(const LeavesParams *leaves, LeafBatch *batch, int count, const Land *land,
                       uint64_t seed, Error *e)
{
    int64_t total = 0;
    for (int b = 0; b < count; b++) {
        total += batch[b].count;
    }
    if (total == 0 || (leaves->autumn <= 0.0f && leaves->fall <= 0.0f)) {
        return true;
    }
    Ranked *ranked = rank(batch, count, total, seed, e);
    if (!ranked) {
        return false;
    }
    turn(leaves, batch, ranked, total);
    int64_t shed = (int64_t)((double)leaves->fall * (double)total + 0.5);
    for (int64_t i = 0; i < shed; i++) {
        shed_one(&batch[ranked[i].batch], &ranked[i], leaves, land);
    }
    free(ranked);
    for (int b = 0; b < count; b++) {
        remove_gone(&batch[b]);
    }
    return true;
}
