#include "objects/common/foliage.h"

#include "base/memory.h"
#include "base/random.h"
#include "objects/common/leaf_batch.h"
#include "objects/common/leaf_place.h"
#include "objects/common/leaf_season.h"

#include <math.h>
#include <stdlib.h>

enum { STREAM_LENGTH = 1, STREAM_WIDTH = 2, STREAM_FOLD = 3, STREAM_CURL = 4 }; // of a leaf mesh
// Of a twig; LEAVES + i: node i.
enum {
    STREAM_OFFSET = 1,
    STREAM_REFERENCE = 2,
    STREAM_SHARE = 3,
    STREAM_FLUSH = 4,
    STREAM_LEAVES = 100
};
enum { STREAM_VARIANT = 9, STREAM_VARIATION = 10 }; // of a leaf

// Of a leaf: here, and at least in the ray tracer.
#define LEAF_BYTES (1.5 * (sizeof(Transform) + 2 * sizeof(float)) + 100.0)

#define WIDEST 1000.0f // m: spacing of leaves; no twig is as long

typedef struct Foliage {
    const LeavesParams *leaves;
    const bool *bare; // per curve; NULL = none
    LeafBatch *batch; // leaves->variants of them
    const LeafLight *light;
    float spacing; // m, the scene's, widened if there are too many leaves
    float share;   // of the twigs that have leaves at all; 1 unless widening does not suffice
    uint64_t seed;
    const Run *run;
} Foliage;

void foliage_leaf_meshes(const LeavesParams *leaves, float piece, int variant, uint64_t seed,
                         Part *part, Error *e)
{
    uint64_t key = random_key(seed, (uint64_t)variant);
    LeafParams form = leaves_form(leaves, piece);
    form.length *= random_range(random_key(key, STREAM_LENGTH), 0.9f, 1.1f);
    form.width *= random_range(random_key(key, STREAM_WIDTH), 0.9f, 1.1f);
    form.fold *= random_range(random_key(key, STREAM_FOLD), 0.4f, 1.3f);
    // Some blades bend up; a rachis bends down under its leaflets.
    bool blade = form.compound == COMPOUND_NONE;
    form.curl *=
        random_range(random_key(key, STREAM_CURL), blade ? -0.4f : 0.65f, blade ? 1.5f : 1.3f);
    part->mesh = leaf_mesh_new(&form, key, e);
    for (int i = 0; part->mesh && i < leaf_coarse_levels(&form); i++) {
        CoarseMesh *coarse = &part->coarse[i];
        coarse->mesh = leaf_mesh_coarse(&form, key, i, &coarse->error, e);
        if (!coarse->mesh) {
            part_free_meshes(part);
        }
    }
}

// Distance to the next node, number counted from the twig's tip: they are denser at the end, and
// where leaves are small.
static float node_gap(const Foliage *foliage, int64_t number)
{
    enum { CROWDED = 5 };
    float least = 1.0f - foliage->leaves->crowding;
    float step = foliage->leaves->crowding / CROWDED;
    float gap = number < CROWDED ? least + step * (float)number : 1.0f;
    return foliage->spacing * gap * leaf_size_at(foliage->leaves, number);
}

// season: LeafBatch's.
static bool add_leaf(Foliage *foliage, Transform place, float season, uint64_t key, Error *e)
{
    int variant =
        (int)(random_unit(random_key(key, STREAM_VARIANT)) * (float)foliage->leaves->variants);
    return leaf_batch_add(&foliage->batch[variant], place,
                          random_unit(random_key(key, STREAM_VARIATION)), season, e);
}

// Point of the twig `distance` (m) before p, toward its start; p is on the segment below point i.
static Vec3 before_on_twig(const CurveSet *twigs, int64_t first, int64_t i, Vec3 p, float distance)
{
    for (; i > first; i--) {
        Vec3 next = twigs->position[i - 1];
        float length = vec3_distance(p, next);
        if (length >= distance && length > 0.0f) {
            return vec3_lerp(p, next, distance / length);
        }
        distance -= length;
        p = next;
    }
    return p;
}

// Adds the leaves of a node, on the segment below point i of the twig.
static bool add_node(Foliage *foliage, const CurveSet *twigs, int64_t first, int64_t i,
                     const LeafNode *node, Error *e)
{
    const LeavesParams *leaves = foliage->leaves;
    if (leaves_are_pieces(leaves)) {
        Vec3 start = before_on_twig(twigs, first, i, node->position, foliage->spacing);
        float length = vec3_distance(start, node->position);
        return length < 0.1f * foliage->spacing ||
               add_leaf(
                   foliage,
                   leaf_place_piece(leaves, start, node->position, foliage->spacing, node->key),
                   leaves_emergence(leaves, node->key) - 1.0f, node->key, e);
    }
    bool done = true;
    for (int k = 0; done && k < leaves_at_node(leaves); k++) {
        uint64_t key = leaf_key(node, k);
        bool living = k < leaves_per_node(leaves);
        float young = fmaxf(1.0f - leaves_emergence(leaves, key), node->young);
        float season = living ? 0.0f - young : 1.0f;
        done = add_leaf(foliage, leaf_place(leaves, node, k, foliage->light), season, key, e);
    }
    return done;
}

// Do blades at the tips of twigs differ from older ones? Needles differ within their mesh.
static bool has_young_tips(const LeavesParams *leaves)
{
    return leaves->flush > 0.0f && leaves->shape != LEAF_NEEDLES && leaves->shape != LEAF_TUFT &&
           leaves->shape != LEAF_SCALES;
}

// 0..1: how young the leaves at this distance (m) from the twig's tip are. leafy: m, length of the
// twig's leafy part, of which some twigs have renewed more than others.
static float youth_at(const LeavesParams *leaves, float distance, float leafy, uint64_t twig_key)
{
    if (!has_young_tips(leaves)) {
        return 0.0f;
    }
    float renewed =
        leaves->flush * leafy * random_range(random_key(twig_key, STREAM_FLUSH), 0.0f, 2.0f);
    return distance < renewed ? 1.0f - distance / renewed : 0.0f;
}

// Length (m) of the leafy part of a twig, from its tip; 0 where no leaf depends on it.
static float leafy_length(const LeavesParams *leaves, const CurveSet *twigs, int64_t curve)
{
    float length = 0.0f;
    int64_t first = twigs->first[curve], last = twigs->first[curve + 1] - 1;
    bool needed = leaves->base_leaves > 0 || leaves->foot > 0.0f || has_young_tips(leaves);
    for (int64_t i = last; needed && i > first && twigs->radius[i] < leaves->twig_radius; i--) {
        length += vec3_distance(twigs->position[i], twigs->position[i - 1]);
    }
    return length;
}

// Walks one twig from its tip toward its start and adds a node of leaves at every gap while the
// twig is thin enough. If not `place`, only counts them and cannot fail.
static int64_t twig_leaves(Foliage *foliage, const CurveSet *twigs, int64_t curve, bool place,
                           bool *failed, Error *e)
{
    const LeavesParams *leaves = foliage->leaves;
    bool pieces = leaves_are_pieces(leaves), tip_only = leaves->arrangement == ARRANGE_ROSETTE;
    uint64_t twig_key = random_key(foliage->seed, twigs->id[curve]);
    if (foliage->share < 1.0f &&
        random_unit(random_key(twig_key, STREAM_SHARE)) >= foliage->share) {
        return 0;
    }
    int64_t first = twigs->first[curve], last = twigs->first[curve + 1] - 1, number = 0, placed = 0;
    float until = pieces || tip_only
                      ? 0.0f
                      : 0.2f * foliage->spacing * random_unit(random_key(twig_key, STREAM_OFFSET));
    bool keeps_low = leaves->foot > 0.0f && !tip_only;
    Vec3 reference = random_direction(random_key(twig_key, STREAM_REFERENCE));
    const float leafy = leafy_length(leaves, twigs, curve);
    float left = leafy; // from point i, m
    for (int64_t i = last; i > first && twigs->radius[i] < leaves->twig_radius; i--) {
        Vec3 a = twigs->position[i], b = twigs->position[i - 1];
        float length = vec3_distance(a, b);
        Vec3 along = vec3_normalize(vec3_sub(a, b));
        reference = leaf_reference(leaves, reference, along);
        while (until < length) {
            bool low = !keeps_low || left - until <= leaves->foot;
            float young = youth_at(leaves, leafy - left + until, leafy, twig_key);
            LeafNode node = {.position = vec3_lerp(a, b, until / length),
                             .along = along,
                             .reference = reference,
                             .radius = twigs->radius[i],
                             .number = number,
                             .size = leaf_size_at(leaves, number) * (1.0f - 0.6f * young) *
                                     leaf_size_above_base(leaves, left - until, foliage->spacing),
                             .young = young,
                             .key = random_key(twig_key, STREAM_LEAVES + (uint64_t)number)};
            if (place && low && !add_node(foliage, twigs, first, i, &node, e)) {
                *failed = true;
                return placed;
            }
            if (tip_only) {
                return leaves_at_node(leaves);
            }
            until += pieces ? foliage->spacing : node_gap(foliage, number);
            number++;
            placed += low;
        }
        until -= length;
        left -= length;
    }
    return placed * (pieces ? 1 : leaves_per_node(leaves));
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
                     .season = batch->season,
                     .instance_count = batch->count};
        batch->instance = NULL;
        batch->variation = NULL;
        batch->season = NULL;
        foliage_leaf_meshes(foliage->leaves, foliage->spacing, v, foliage->seed, &part, e);
        if (!placing_add(placing, part, role, e)) {
            return false;
        }
    }
    return true;
}

// Widens the spacing until there are at most max_count leaves. One step by the ratio is not enough,
// because every twig keeps its first leaf for long; the least factor guarantees termination. A
// rosette, and a first piece, stay however wide the spacing: then fewer twigs get any. Also false
// if memory is short.
static bool limit_leaves(Foliage *foliage, const CurveSet *twigs, Error *e)
{
    bool failed = false;
    int64_t most = foliage->leaves->max_count;
    int64_t count = all_leaves(foliage, twigs, false, &failed, e);
    while (count > most && !failed) {
        float ratio = fmaxf((float)count / (float)most, 1.01f);
        if (foliage->leaves->arrangement == ARRANGE_ROSETTE || foliage->spacing > WIDEST) {
            foliage->share /= ratio;
        } else {
            foliage->spacing *= ratio;
        }
        count = all_leaves(foliage, twigs, false, &failed, e);
    }
    return !failed && memory_check((double)count * LEAF_BYTES, e,
                                   "%lld leaves (fewer by leaves.max_count or a wider "
                                   "leaves.spacing)",
                                   (long long)count);
}

bool foliage_add(const CurveSet *twigs, const bool *bare, const LeavesParams *leaves,
                 const LeafLight *light, uint64_t seed, const Placing *placing, int role, Error *e)
{
    const Run *run = placing->recipe->run;
    Foliage foliage = {leaves, bare, NULL, light, leaves->spacing, 1.0f, seed, run};
    foliage.batch = memory_alloc_zero(leaves->variants, sizeof *foliage.batch, e);
    if (!foliage.batch) {
        return false;
    }
    bool failed = !limit_leaves(&foliage, twigs, e);
    all_leaves(&foliage, twigs, true, &failed, e);
    bool done = !failed &&
                leaf_season_apply(leaves, foliage.batch, leaves->variants, &placing->around.land,
                                  seed, e) &&
                add_parts(&foliage, placing, role, e);
    for (int v = 0; v < leaves->variants; v++) {
        leaf_batch_clear(&foliage.batch[v]);
    }
    free(foliage.batch);
    return done;
}
