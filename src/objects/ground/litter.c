#include "objects/ground/litter.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "objects/common/foliage.h"
#include "objects/ground/grove.h"
#include "objects/tree/tree.h"

#include <stdlib.h>

enum { STREAM_PLACES = 100 }; // of a variant; PLACES + i: leaf i
// Of a leaf on the ground.
enum {
    STREAM_RADIUS = 1,
    STREAM_AZIMUTH = 2,
    STREAM_HEIGHT = 3,
    STREAM_TILT = 4,
    STREAM_FACE = 5,
    STREAM_TURN = 6
};

// Distance from the middle, as a share of the radius, below which a share u of the leaves lies:
// evenly over the disc, or as densely as 1 / distance at gathering 1.
static float radial_share(float u, float gathering)
{
    return gathering > 0.0f ? exact_pow(u, 0.5f + 0.5f * gathering) : sqrtf(u);
}

// A fallen leaf on the tips of the short grass: either side up, slightly tilted. False where it
// would lie in a pond.
static bool lying_leaf(const GroundParams *params, uint64_t seed, uint64_t key, Transform *leaf)
{
    float u = random_unit(random_key(key, STREAM_RADIUS)), sine, cosine;
    float r = params->fallen_radius * radial_share(u, params->fallen_gathering);
    exact_sincos(random_range(random_key(key, STREAM_AZIMUTH), 0.0f, 2.0f * PI_F), &sine, &cosine);
    float x = params->fallen_center.x + r * sine, z = params->fallen_center.z + r * cosine;
    if (ground_in_pond(params, seed, x, z)) {
        return false;
    }
    Vec3 p = vec3(x, ground_height(params, seed, x, z), z);
    p.y += random_range(random_key(key, STREAM_HEIGHT), 0.005f, 0.06f);
    Vec3 up = vec3_normalize(
        vec3_madd(vec3(0, 1, 0), 0.35f, random_direction(random_key(key, STREAM_TILT))));
    if (random_unit(random_key(key, STREAM_FACE)) < 0.4f) {
        up = vec3_neg(up);
    }
    Vec3 y = vec3_normalize(vec3_cross(up, random_direction(random_key(key, STREAM_TURN))));
    *leaf = transform_from_axes(vec3_cross(y, up), y, up, p);
    return true;
}

// `count` leaves of variant number `variant` of a tree's.
static bool add_variant(const GroundParams *params, const LeavesParams *leaves, int variant,
                        int64_t count, uint64_t key, const Placing *placing, Error *e)
{
    uint64_t seed = placing->recipe->seed;
    Part part = {.instance = memory_alloc(count, sizeof *part.instance, e)};
    foliage_leaf_meshes(leaves, leaves->spacing, variant, key, &part, e);
    bool done = part.mesh && part.instance;
    for (int64_t i = 0; done && i < count; i++) {
        done = run_goes_on(placing->recipe->run, i, e);
        uint64_t leaf = random_key(key, STREAM_PLACES + (uint64_t)i);
        part.instance_count +=
            lying_leaf(params, seed, leaf, &part.instance[part.instance_count]) ? 1 : 0;
    }
    if (!done || part.instance_count == 0) { // an instance count of 0 would draw it at the origin
        part_free_meshes(&part);
        free(part.instance);
        return done;
    }
    return placing_add(placing, part, GROUND_FALLEN, e);
}

// `count` leaves of a tree. seed: of theirs.
static bool add_leaves_of(const GroundParams *params, const TreeParams *tree, int64_t count,
                          uint64_t seed, const Placing *placing, Error *e)
{
    LeavesParams leaves = tree->leaves;
    leaves.emergence = 1.0f; // grown up when they fell, whatever the season is now
    if (leaves.shape != LEAF_NEEDLES && leaves.shape != LEAF_TUFT && leaves.shape != LEAF_SCALES) {
        leaves.curl = 60.0f; // dry leaves roll up
    }
    for (int v = 0; v < leaves.variants; v++) {
        int64_t each = grove_share(count, leaves.variants, v);
        if (each > 0 &&
            !add_variant(params, &leaves, v, each, random_key(seed, (uint64_t)v), placing, e)) {
            return false;
        }
    }
    return true;
}

bool litter_add(const GroundParams *params, const Placing *placing, Error *e)
{
    uint64_t seed = placing->recipe->seed;
    if (params->fallen_leaves <= 0) {
        return true;
    }
    if (params->fallen_of_count == 0) {
        TreeParams oak = tree_params_default();
        return add_leaves_of(params, &oak, params->fallen_leaves,
                             random_key(seed, STREAM_GROUND_LEAVES), placing, e);
    }
    double all = 0.0, sum = 0.0;
    for (int i = 0; i < params->fallen_of_count; i++) {
        all += (double)params->fallen_of[i].share;
    }
    uint64_t key = random_key(seed, STREAM_GROUND_LITTER);
    int64_t before = 0;
    for (int i = 0; i < params->fallen_of_count; i++) {
        sum += (double)params->fallen_of[i].share;
        int64_t until = (int64_t)((double)params->fallen_leaves * (sum / all) + 0.5);
        if (!add_leaves_of(params, params->fallen_of[i].tree, until - before,
                           random_key(key, (uint64_t)i), placing, e)) {
            return false;
        }
        before = until;
    }
    return true;
}
