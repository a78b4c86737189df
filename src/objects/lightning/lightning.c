// Assembles bolts: their frames, one out-tree for all, radii from powers.
#include "objects/lightning/lightning.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "objects/lightning/parts.h"
#include "outtree/chains.h"

#include <stdlib.h>

enum { STREAM_STRIKE_ACROSS = 0, STREAM_STRIKE_DEPTH = 1 }; // of a strike

LightningParams lightning_params_default(void)
{
    LightningParams params = {.height = 1000.0f,
                              .lean = 6.0f,
                              .lean_azimuth = 90.0f,
                              .bolts = 1,
                              .ground_points = 1,
                              .spread = 0.4f,
                              .branching = 1.0f,
                              .hurst = 0.65f,
                              .jitter = 0.1f,
                              .branch_power = 0.2f,
                              .drain = 0.25f,
                              .taper = 0.33f};
    params.element.points.pattern = SCATTER_POISSON;
    params.element.growth.max_children = 2;
    params.element.growth.cone_angle = 60.0f;
    params.element.points.gradient = 0.35f;
    params.element.growth.field_weight = 1.0f;
    return params;
}

// ---- levels ----

int lightning_own_levels(const LightningParams *params, GrowLevel levels[LIGHTNING_MOST_LEVELS])
{
    static const GrowLevel AIR[2] = {{12, 0.10f, 0.5f, 2.6f, 1.0f, 0.45f, 1.0f, 0.3f},
                                     {80, 0.25f, 0.8f, 1.7f, 1.0f, 0.5f, 1.0f, 0.3f}};
    static const GrowLevel SURFACE[3] = {{30, 0.08f, 0.4f, 4.0f, 1.0f, 0.40f, 1.0f, 0.3f},
                                         {175, 0.15f, 0.6f, 2.2f, 1.0f, 0.45f, 1.0f, 0.3f},
                                         {1050, 0.30f, 0.8f, 1.6f, 1.0f, 0.5f, 1.0f, 0.3f}};
    bool air = params->element.points.place == SCATTER_VOLUME;
    const GrowLevel *own = air ? AIR : SURFACE;
    int count = 0;
    for (int i = 0; i < (air ? 2 : 3); i++) {
        levels[count] = own[i];
        float attractors = (float)own[i].attractors * params->branching + 0.5f;
        levels[count].attractors = (int64_t)attractors;
        count += levels[count].attractors > 0;
    }
    return count;
}

int64_t lightning_attractors(const LightningParams *params)
{
    GrowLevel own[LIGHTNING_MOST_LEVELS];
    const GrowLevel *levels = params->element.levels;
    int count = params->element.level_count;
    if (count == 0) {
        count = lightning_own_levels(params, own);
        levels = own;
    }
    int64_t sum = 0;
    for (int i = 0; i < count; i++) {
        sum += levels[i].attractors;
    }
    return params->element.points.place == SCATTER_VOLUME ? sum * params->bolts : sum;
}

// ---- radii ----

// Marks the path from the strike back to the root with radius 1.
static void mark_main(OutTree *tree, uint64_t strike_id)
{
    int32_t node = (int32_t)tree->count - 1;
    while (node >= 0 && tree->id[node] != strike_id) {
        node--;
    }
    for (; node >= 0; node = tree->parent[node]) {
        tree->radius[node] = 1.0f;
    }
}

// Length of all channels beyond each node, m; the caller frees it.
static float *lengths_beyond(const OutTree *tree, Error *e)
{
    float *beyond = memory_alloc_zero(tree->count, sizeof *beyond, e);
    for (int64_t i = tree->count - 1; beyond && i >= 0; i--) {
        int32_t parent = tree->parent[i];
        if (parent >= 0) {
            beyond[parent] += beyond[i] + vec3_distance(tree->position[i], tree->position[parent]);
        }
    }
    return beyond;
}

// Powers along one chain, as shares of the main channel's. A channel drains the charge of all
// channels beyond it, which is in proportion to their length, so each dims at every fork and toward
// its tip. Two do not: a main channel in the air, which carries the current to the ground, and the
// leader before it strikes.
static void chain_powers(OutTree *tree, const LightningParams *params, float size, bool main,
                         bool from_root, const float *beyond, const int32_t *node, int64_t count)
{
    static const float least = 0.02f; // share left at the tip
    bool fades = params->element.points.place == SCATTER_SURFACE || !(main || from_root);
    float share = main ? 1.0f : params->branch_power, full = params->drain * size;
    for (int64_t k = from_root ? 0 : 1; k < count; k++) {
        float drained = clampf(beyond[node[k]] / full, least, 1.0f);
        tree->radius[node[k]] = fades ? share * drained : share;
    }
}

static bool set_radii(OutTree *tree, const LightningParams *params, float size, float core,
                      const uint64_t *strike_id, int strike_count, Error *e)
{
    for (int64_t i = 0; i < tree->count; i++) {
        tree->radius[i] = 0.0f;
    }
    for (int i = 0; i < strike_count; i++) {
        mark_main(tree, strike_id[i]);
    }
    ChainSet *chains = out_tree_chains(tree, e);
    float *beyond = chains ? lengths_beyond(tree, e) : NULL;
    for (int64_t c = 0; beyond && c < chains->count; c++) {
        const int32_t *node = chains->node + chains->first[c];
        int64_t count = chains->first[c + 1] - chains->first[c];
        bool main = tree->radius[node[count - 1]] == 1.0f;
        chain_powers(tree, params, size, main, chains->parent[c] < 0, beyond, node, count);
    }
    for (int64_t i = 0; beyond && i < tree->count; i++) {
        tree->radius[i] = core * exact_pow(tree->radius[i], params->taper);
    }
    bool done = beyond;
    free(beyond);
    chains_free(chains);
    return done;
}

float lightning_radius(const LightningParams *params, const OutTree *tree)
{
    if (params->element.points.place == SCATTER_VOLUME) {
        return params->radius > 0.0f ? params->radius : params->height / 1600.0f;
    }
    float most = 0.0f;
    for (int64_t i = 0; i < tree->count; i++) {
        most = tree->radius[i] > most ? tree->radius[i] : most;
    }
    return most;
}

// ---- jitter ----

// The node ids of the strikes; the caller frees them.
static uint64_t *find_strikes(const OutTree *tree, int *count, Error *e)
{
    *count = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        *count += tree->radius[i] == LIGHTNING_STRIKE;
    }
    uint64_t *id = memory_alloc(*count, sizeof *id, e);
    for (int64_t i = 0, k = 0; id && i < tree->count; i++) {
        if (tree->radius[i] == LIGHTNING_STRIKE) {
            id[k++] = tree->id[i];
        }
    }
    return id;
}

// Computes powers first, so that chains follow the main channel, and again at the end, along the
// final channels.
OutTree *lightning_wander(OutTree *tree, const LightningParams *params, float size, float core,
                          const Wander *wander, Error *e)
{
    float length[2] = {params->step > 0.0f ? params->step : size / 40.0f,
                       params->segment > 0.0f ? params->segment : size / 400.0f};
    JitterParams jitter = jitter_params_default();
    jitter.hurst = params->hurst;
    jitter.reference = size;
    jitter.project = wander->project;
    jitter.surface = wander->surface;
    jitter.stride = wander->stride;
    int strikes;
    uint64_t *strike_id = find_strikes(tree, &strikes, e);
    for (int i = 0; tree && i < 3; i++) {
        OutTree *next = tree;
        bool done = strike_id && set_radii(next, params, size, core, strike_id, strikes, e);
        if (done && i < 2) {
            next = out_tree_resample(tree, length[i], e);
            if (!next) {
                error_key(e, "%s", i == 0 ? "step" : "segment");
            }
            jitter.amplitude = params->jitter * size * (i == 0 ? 1.0f : 0.4f);
            jitter.amplitude *= wander->project ? 0.7f : 1.0f; // in one direction, around bends
            jitter.seed = random_key(wander->seed, (uint64_t)i);
            done = next && out_tree_jitter(next, &jitter, wander->run, e);
            out_tree_free(tree);
        }
        if (!done) {
            out_tree_free(next);
            next = NULL;
        }
        tree = next;
    }
    free(strike_id);
    return tree;
}

// ---- all bolts ----

static Bolt make_bolt(const LightningParams *params, int number, uint64_t seed)
{
    float sine, cosine, east, south;
    exact_sincos(params->lean * RADIANS_PER_DEGREE, &sine, &cosine);
    exact_sincos(params->lean_azimuth * RADIANS_PER_DEGREE, &east, &south);
    Vec3 up = vec3(sine * east, cosine, sine * south);
    Bolt bolt = {.params = params,
                 .axis = vec3_neg(up),
                 .height = params->height,
                 .colony = number,
                 .seed = random_key(seed, (uint64_t)number)};
    bolt.depth = vec3_madd(vec3(0, 0, 1), -up.z, up);
    bolt.depth = vec3_dot(bolt.depth, bolt.depth) > 1e-4f ? vec3_normalize(bolt.depth)
                                                          : vec3_perpendicular(up);
    bolt.side = vec3_cross(up, bolt.depth);
    float apart = params->bolt_spread;
    // 0, +1, -1, +2, ... places to the side, with random offsets aside and in depth
    int rank = (number + 1) / 2;
    float place = (float)rank * (number % 2 ? 1.0f : -1.0f);
    uint64_t key = random_key(bolt.seed, STREAM_BOLT_STRIKE);
    float across = place * apart * random_range(random_key(key, STREAM_STRIKE_ACROSS), 0.8f, 1.2f);
    float away = place * apart * random_range(random_key(key, STREAM_STRIKE_DEPTH), -0.3f, 0.3f);
    bolt.strike = vec3_add(params->position, vec3(across, 0.0f, away));
    bolt.start = vec3_madd(bolt.strike, params->height, up);
    return bolt;
}

LightningParams lightning_params_resolve(const LightningParams *given)
{
    LightningParams params = *given;
    float size = params.height;
    if (params.element.points.place != SCATTER_SURFACE) { // there the extent sets lengths
        params.step = params.step > 0.0f ? params.step : size / 40.0f;
        params.segment = params.segment > 0.0f ? params.segment : size / 400.0f;
        params.radius = params.radius > 0.0f ? params.radius : size / 1600.0f;
        params.bolt_spread = params.bolt_spread > 0.0f ? params.bolt_spread : 0.45f * size;
    }
    return params;
}

bool lightning_grow(const void *given, const Recipe *recipe, Grown *whole, Error *e)
{
    LightningParams params = lightning_params_resolve(given);
    if (params.element.points.place == SCATTER_SURFACE) {
        return lightning_grow_surface(given, recipe, whole, e);
    }
    whole->tree = out_tree_new(e);
    bool done = whole->tree;
    for (int i = 0; done && i < params.bolts; i++) {
        Bolt bolt = make_bolt(&params, i, recipe->seed);
        OutTree *one = lightning_grow_bolt(&bolt, recipe, e);
        done = one && lightning_add_streamers(one, &bolt, out_tree_last_birth(one), e) &&
               out_tree_append(whole->tree, one, e);
        out_tree_free(one);
    }
    return done;
}

bool lightning_finish(const void *given, const Recipe *recipe, const Grown *whole, Grown *grown,
                      Error *e)
{
    LightningParams params = lightning_params_resolve(given);
    if (params.element.points.place == SCATTER_SURFACE) {
        return lightning_finish_surface(given, recipe, whole->state, grown, e);
    }
    Wander wander = {.seed = random_key(recipe->seed, STREAM_WANDER), .run = recipe->run};
    grown->tree = lightning_wander(grown->tree, &params, params.height, params.radius, &wander, e);
    return grown->tree;
}
