#include "objects/common/foliage.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "mesh/leaf.h"

#include <stdlib.h>

enum { STREAM_LENGTH = 1, STREAM_WIDTH = 2, STREAM_FOLD = 3, STREAM_CURL = 4 }; // of a leaf mesh
// Of a twig; LEAVES + i: leaf i.
enum { STREAM_OFFSET = 1, STREAM_REFERENCE = 2, STREAM_LEAVES = 100 };
// Of a leaf.
enum {
    STREAM_ANGLE = 1,
    STREAM_LIGHT = 2,
    STREAM_SIZE = 3,
    STREAM_TURN = 8,
    STREAM_VARIANT = 9,
    STREAM_VARIATION = 10
};

// Instances of one leaf variant, collected for a part.
typedef struct LeafBatch {
    Transform *instance;
    float *variation;
    int64_t count, capacity, variation_capacity;
} LeafBatch;

// Of a leaf: here, and at least in the ray tracer.
#define LEAF_BYTES (1.5 * (sizeof(Transform) + sizeof(float)) + 100.0)

typedef struct Foliage {
    const LeavesParams *leaves;
    const bool *bare; // per curve; NULL = none
    LeafBatch *batch; // leaves->variants of them
    Vec3 center;
    float spacing; // m, the scene's, widened if there are too many leaves
    uint64_t seed;
    const Run *run;
} Foliage;

void foliage_leaf_meshes(const LeavesParams *leaves, int variant, uint64_t seed, Part *part,
                         Error *e)
{
    uint64_t key = random_key(seed, (uint64_t)variant);
    LeafParams params = {
        .length = leaves->length * random_range(random_key(key, STREAM_LENGTH), 0.9f, 1.1f),
        .width = leaves->width * random_range(random_key(key, STREAM_WIDTH), 0.9f, 1.1f),
        .petiole = leaves->petiole,
        .fold = leaves->fold * random_range(random_key(key, STREAM_FOLD), 0.4f, 1.3f),
        .curl = leaves->curl * random_range(random_key(key, STREAM_CURL), -0.4f, 1.5f),
        .wave = 0.05f,
        .lobes = leaves->lobes,
        .lobe_depth = 0.42f,
        .detail = leaves->detail,
    };
    part->mesh = leaf_mesh_new(&params, key, e);
    for (int i = 0; part->mesh && i < LEAF_COARSE_LEVELS; i++) {
        CoarseMesh *coarse = &part->coarse[i];
        coarse->mesh = leaf_mesh_coarse(&params, key, i, &coarse->error, e);
        if (!coarse->mesh) {
            part_free_meshes(part);
        }
    }
}

// Distance to the next leaf, number counted from the twig's tip: leaves are denser at the end.
static float leaf_gap(const Foliage *foliage, int64_t number)
{
    float crowding = number < 5 ? 0.25f + 0.15f * (float)number : 1.0f;
    return foliage->spacing * crowding;
}

// A leaf at p on the side `out` of a twig that runs along `along`.
static Transform leaf_frame(const Foliage *foliage, Vec3 p, Vec3 along, Vec3 out, uint64_t key)
{
    const LeavesParams *leaves = foliage->leaves;
    float angle = leaves->angle * random_range(random_key(key, STREAM_ANGLE), 0.7f, 1.3f), sine,
          cosine;
    exact_sincos(angle * RADIANS_PER_DEGREE, &sine, &cosine);
    Vec3 y = vec3_madd(vec3_scale(along, cosine), sine, out);
    Vec3 z = vec3_madd(vec3_scale(along, sine), -cosine, out);
    // Blades sag under their weight and turn the upper side to the light, with random deviations.
    y = vec3_normalize(vec3_madd(y, leaves->droop * 0.6f, vec3(0, -1, 0)));
    Vec3 light = vec3_normalize(vec3_sub(p, foliage->center));
    light = vec3_add(vec3(0, 1.2f, 0), vec3_scale(light, 0.7f));
    light = vec3_madd(light, 0.55f, random_direction(random_key(key, STREAM_LIGHT)));
    z = vec3_add(vec3_scale(z, 1.0f - leaves->droop), vec3_scale(light, leaves->droop));
    z = vec3_madd(z, -vec3_dot(z, y), y);
    z = vec3_dot(z, z) > 1e-6f ? vec3_normalize(z) : vec3_perpendicular(y);
    float size = 1.0f - leaves->size_variation * random_unit(random_key(key, STREAM_SIZE));
    return transform_from_axes(vec3_scale(vec3_cross(y, z), size), vec3_scale(y, size),
                               vec3_scale(z, size), p);
}

static bool batch_add(LeafBatch *batch, Transform instance, float variation, Error *e)
{
    if (!memory_reserve(&batch->instance, &batch->capacity, batch->count + 1,
                        sizeof *batch->instance, e) ||
        !memory_reserve(&batch->variation, &batch->variation_capacity, batch->count + 1,
                        sizeof *batch->variation, e)) {
        return false;
    }
    batch->instance[batch->count] = instance;
    batch->variation[batch->count++] = variation;
    return true;
}

// Walks one twig from its tip toward its start and adds a leaf at every gap while the twig is thin
// enough. If not `place`, only counts them and cannot fail.
static int64_t twig_leaves(Foliage *foliage, const CurveSet *twigs, int64_t curve, bool place,
                           bool *failed, Error *e)
{
    const LeavesParams *leaves = foliage->leaves;
    uint64_t twig_key = random_key(foliage->seed, twigs->id[curve]);
    int64_t first = twigs->first[curve], last = twigs->first[curve + 1] - 1, number = 0;
    float until = 0.2f * foliage->spacing * random_unit(random_key(twig_key, STREAM_OFFSET));
    Vec3 reference = random_direction(random_key(twig_key, STREAM_REFERENCE));
    for (int64_t i = last; i > first && twigs->radius[i] < leaves->twig_radius; i--) {
        Vec3 a = twigs->position[i], b = twigs->position[i - 1];
        float length = vec3_distance(a, b);
        Vec3 along = vec3_normalize(vec3_sub(a, b));
        reference = vec3_madd(reference, -vec3_dot(reference, along), along);
        reference = vec3_dot(reference, reference) > 1e-6f ? vec3_normalize(reference)
                                                           : vec3_perpendicular(along);
        while (until < length) {
            if (place) {
                uint64_t key = random_key(twig_key, STREAM_LEAVES + (uint64_t)number);
                float turn = (float)number * leaves->phyllotaxis +
                             8.0f * (random_unit(random_key(key, STREAM_TURN)) - 0.5f);
                float sine, cosine;
                exact_sincos(turn * RADIANS_PER_DEGREE, &sine, &cosine);
                Vec3 out = vec3_rotate(reference, along, cosine, sine);
                Vec3 p = vec3_lerp(a, b, until / length);
                p = vec3_madd(p, 0.8f * twigs->radius[i], out);
                int variant =
                    (int)(random_unit(random_key(key, STREAM_VARIANT)) * (float)leaves->variants);
                if (!batch_add(&foliage->batch[variant], leaf_frame(foliage, p, along, out, key),
                               random_unit(random_key(key, STREAM_VARIATION)), e)) {
                    *failed = true;
                    return number;
                }
            }
            until += leaf_gap(foliage, number++);
        }
        until -= length;
    }
    return number;
}

static int64_t all_leaves(Foliage *foliage, const CurveSet *twigs, bool place, bool *failed,
                          Error *e)
{
    int64_t count = 0;
    for (int64_t i = 0; i < twigs->curve_count && !*failed; i++) {
        if (run_is_cancelled(foliage->run)) {
            *failed = true;
            run_cancel_error(e);
            break;
        }
        if (!foliage->bare || !foliage->bare[i]) {
            count += twig_leaves(foliage, twigs, i, place, failed, e);
        }
    }
    return count;
}

static bool add_parts(Foliage *foliage, const Placing *placing, int role, Error *e)
{
    for (int v = 0; v < foliage->leaves->variants; v++) {
        LeafBatch *batch = &foliage->batch[v];
        if (batch->count == 0) {
            continue;
        }
        Part part = {.instance = batch->instance,
                     .variation = batch->variation,
                     .instance_count = batch->count};
        batch->instance = NULL;
        batch->variation = NULL;
        foliage_leaf_meshes(foliage->leaves, v, foliage->seed, &part, e);
        if (!placing_add(placing, part, role, e)) {
            return false;
        }
    }
    return true;
}

// Widens the spacing until there are at most max_count leaves. One step by the ratio is not enough,
// because every twig keeps its first leaf for long; the least factor guarantees termination. Also
// false if memory is short.
static bool limit_leaves(Foliage *foliage, const CurveSet *twigs, Error *e)
{
    bool failed = false;
    int64_t most = foliage->leaves->max_count;
    int64_t count = all_leaves(foliage, twigs, false, &failed, e);
    while (count > most && !failed) {
        float ratio = (float)count / (float)most;
        foliage->spacing *= ratio > 1.01f ? ratio : 1.01f;
        count = all_leaves(foliage, twigs, false, &failed, e);
    }
    return !failed && memory_check((double)count * LEAF_BYTES, e,
                                   "%lld leaves (fewer by leaves.max_count or a wider "
                                   "leaves.spacing)",
                                   (long long)count);
}

bool foliage_add(const CurveSet *twigs, const bool *bare, const LeavesParams *leaves, Vec3 center,
                 uint64_t seed, const Placing *placing, int role, Error *e)
{
    const Run *run = placing->recipe->run;
    Foliage foliage = {leaves, bare, NULL, center, leaves->spacing, seed, run};
    foliage.batch = memory_alloc_zero(leaves->variants, sizeof *foliage.batch, e);
    if (!foliage.batch) {
        return false;
    }
    bool failed = !limit_leaves(&foliage, twigs, e);
    all_leaves(&foliage, twigs, true, &failed, e);
    bool done = !failed && add_parts(&foliage, placing, role, e);
    for (int v = 0; v < leaves->variants; v++) {
        free(foliage.batch[v].instance);
        free(foliage.batch[v].variation);
    }
    free(foliage.batch);
    return done;
}
