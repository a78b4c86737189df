// One bolt in the air: a leader that grows down to the ground, then side branches, coarse to fine.
#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "objects/lightning/parts.h"

#include <stdio.h>
#include <stdlib.h>

// Of a leader; attractor i uses stream i.
enum { STREAM_LEADER_END = 1000, STREAM_FORK = 2000 };
enum { STREAM_ALONG = 0, STREAM_TURN = 1, STREAM_RADIUS = 2 }; // of a leader's attractor
enum { STREAM_GROUND_ACROSS = 0, STREAM_GROUND_DEPTH = 1 };    // of a point on the ground
// Of a streamer.
enum {
    STREAM_STREAMER_AZIMUTH = 0,
    STREAM_STREAMER_RADIUS = 1,
    STREAM_STREAMER_LENGTH = 2,
    STREAM_STREAMER_ID = 3
};

// Lengths of the leader's growth, as shares of the height.
#define LEADER_STEP 0.02f
#define LEADER_KILL 0.03f
#define LEADER_REACH 0.16f
#define LEADER_WIDTH 0.10f

// Scatters a leader's attractors in a spindle from `from` to `to`, and one at its end.
static bool scatter_leader(PointSet *points, const Bolt *bolt, Vec3 from, Vec3 to, int count,
                           uint64_t seed, Error *e)
{
    for (int i = 0; i < count; i++) {
        uint64_t key = random_key(seed, (uint64_t)i);
        float t = ((float)i + random_unit(random_key(key, STREAM_ALONG))) / (float)count;
        float width = LEADER_WIDTH * bolt->height * 4.0f * t * (1.0f - t);
        float turn = random_range(random_key(key, STREAM_TURN), 0.0f, 2.0f * PI_F), sine, cosine;
        float r = width * sqrtf(random_unit(random_key(key, STREAM_RADIUS)));
        exact_sincos(turn, &sine, &cosine);
        Vec3 p = vec3_lerp(from, to, t);
        p = vec3_madd(p, r * cosine, bolt->side);
        p = vec3_madd(p, r * sine, bolt->depth);
        if (!points_add(points, p, vec3_neg(bolt->axis), key, e)) {
            return false;
        }
    }
    return points_add(points, to, vec3_neg(bolt->axis), random_key(seed, STREAM_LEADER_END), e);
}

// End of main channel `number`: the strike, then other points on the ground around it.
static Vec3 ground_point(const Bolt *bolt, int number)
{
    if (number == 0) {
        return bolt->strike;
    }
    uint64_t key = random_key(random_key(bolt->seed, STREAM_BOLT_GROUND_POINTS), (uint64_t)number);
    int rank = (number + 1) / 2;
    float side = (number % 2 ? 1.0f : -1.0f) * (float)rank;
    float across =
        side * random_range(random_key(key, STREAM_GROUND_ACROSS), 0.14f, 0.24f) * bolt->height;
    float away = random_range(random_key(key, STREAM_GROUND_DEPTH), -0.06f, 0.06f) * bolt->height;
    return vec3_add(bolt->strike, vec3(across, 0.0f, away));
}

static PointSet *leader_points(const Bolt *bolt, Error *e)
{
    PointSet *points = points_new(e);
    bool done = points;
    for (int i = 0; done && i < bolt->params->ground_points; i++) {
        uint64_t key = random_key(random_key(bolt->seed, STREAM_BOLT_LEADERS), (uint64_t)i);
        float from = i == 0 ? 0.0f : random_range(random_key(key, STREAM_FORK), 0.35f, 0.55f);
        Vec3 fork = vec3_madd(bolt->start, from * bolt->height, bolt->axis);
        done = scatter_leader(points, bolt, fork, ground_point(bolt, i), i == 0 ? 18 : 9, key, e);
    }
    if (!done) {
        points_free(points);
        return NULL;
    }
    points->dimension = 3;
    points->measure = 1.0; // lengths are given, not taken from the spacing
    return points;
}

static ColonizeParams leader_params(const Bolt *bolt)
{
    ColonizeParams params = colonize_params_default();
    params.step = LEADER_STEP * bolt->height;
    params.kill = LEADER_KILL * bolt->height;
    params.influence = LEADER_REACH * bolt->height;
    params.noise = 0.3f;
    params.tropism = vec3_scale(bolt->axis, 0.5f);
    params.cone_axis = bolt->axis;
    params.cone_angle = 65.0f;
    params.max_children = 2;
    params.seed = random_key(bolt->seed, STREAM_BOLT_LEADER_GROWTH);
    return params;
}

// The node nearest to the target among those with the target at most 50 degrees from straight
// below; the root if there is none.
static int32_t nearest_above(const OutTree *tree, const Bolt *bolt, Vec3 target)
{
    int32_t nearest = 0;
    for (int64_t i = 1; i < tree->count; i++) {
        Vec3 way = vec3_sub(target, tree->position[i]);
        float distance = vec3_length(way);
        if (vec3_dot(way, bolt->axis) > 0.64f * distance &&
            distance < vec3_distance(tree->position[nearest], target)) {
            nearest = (int32_t)i;
        }
    }
    return nearest;
}

// The final jump: straight to the ground, step by step.
static bool jump_to(OutTree *tree, const Bolt *bolt, Vec3 target, Error *e)
{
    int64_t parent = nearest_above(tree, bolt, target);
    Vec3 from = tree->position[parent];
    int steps = (int)(vec3_distance(from, target) / (LEADER_STEP * bolt->height)) + 1;
    for (int i = 1; parent >= 0 && i <= steps; i++) {
        uint64_t id = out_tree_child_id(tree->id[parent], i == 1 ? 500 : 0);
        Vec3 p = i == steps ? target : vec3_lerp(from, target, (float)i / (float)steps);
        parent = out_tree_add_node(tree, p, parent, 0, bolt->colony, id, e);
    }
    if (parent < 0) {
        return false;
    }
    tree->radius[parent] = LIGHTNING_STRIKE;
    return true;
}

static OutTree *grow_leader(const Bolt *bolt, const Run *run, Error *e)
{
    OutTree *tree = out_tree_new(e);
    PointSet *points = tree ? leader_points(bolt, e) : NULL;
    ColonizeParams params = leader_params(bolt);
    bool done = points &&
                out_tree_add_node(tree, bolt->start, -1, 0, bolt->colony,
                                  random_key(bolt->seed, STREAM_BOLT_ROOT_ID), e) >= 0 &&
                colonize(tree, points, &params, run, NULL, e);
    for (int i = 0; done && i < bolt->params->ground_points; i++) {
        done = jump_to(tree, bolt, ground_point(bolt, i), e);
    }
    points_free(points);
    if (!done) {
        out_tree_free(tree);
        return NULL;
    }
    return tree;
}

// Defaults of the side branches: a flat cone that widens toward the ground, levels from coarse to
// fine, tropism along the bolt.
static bool grow_branches(OutTree *tree, const Bolt *bolt, const Recipe *recipe, Error *e)
{
    const LightningParams *params = bolt->params;
    float height = bolt->height;
    ElementParams element = params->element;
    GrowLevel levels[LIGHTNING_MOST_LEVELS];
    Shape cone = {.kind = SHAPE_CONE, .size = {params->spread * height, height, 0.1f * height}};
    cone.transform = transform_from_axes(bolt->side, vec3_neg(bolt->axis),
                                         vec3_scale(bolt->depth, 0.5f), bolt->strike);
    if (element.level_count == 0) {
        element.levels = levels;
        element.level_count = lightning_own_levels(params, levels);
    }
    if (element.shape_count == 0) {
        element.shapes = &cone;
        element.shape_count = 1;
    }
    if (vec3_length(element.growth.tropism) == 0.0f) {
        element.growth.tropism = vec3_scale(bolt->axis, 0.8f);
    }
    if (vec3_length(element.growth.cone_axis) == 0.0f) {
        element.growth.cone_axis = bolt->axis;
    }
    if (element.level_count == 0) {
        return true;
    }
    char part[32];
    snprintf(part, sizeof part, "bolt %d", bolt->colony + 1);
    return element_grow(tree, &element, random_key(bolt->seed, STREAM_BOLT_BRANCHES), recipe, part,
                        e);
}

// Leaders have a constant speed, so births follow the path length from the cloud.
static void set_births(OutTree *tree, const Bolt *bolt, float *distance)
{
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        distance[i] = parent < 0 ? 0.0f
                                 : distance[parent] +
                                       vec3_distance(tree->position[i], tree->position[parent]);
        tree->birth[i] = (int32_t)(distance[i] * 1000.0f / bolt->height + 0.5f);
        tree->colony[i] = bolt->colony;
    }
}

// Keeps the paths to the strikes (on_way); of the rest, drops nodes born after the last strike (the
// return stroke ends all growth) and side branches that touch the ground.
static bool drop_late(OutTree *tree, const Bolt *bolt, int32_t strike_birth, bool *on_way, Error *e)
{
    for (int64_t i = 0; i < tree->count; i++) {
        float left = vec3_dot(vec3_sub(bolt->strike, tree->position[i]), bolt->axis);
        bool late = tree->birth[i] > strike_birth || left < 0.04f * bolt->height;
        on_way[i] = on_way[i] || !late;
    }
    return out_tree_keep_nodes(tree, on_way, e);
}

static bool finish_bolt(OutTree *tree, const Bolt *bolt, Error *e)
{
    bool *on_way = memory_alloc_zero(tree->count, sizeof *on_way, e);
    float *distance = memory_alloc(tree->count, sizeof *distance, e);
    bool done = on_way && distance;
    if (done) {
        set_births(tree, bolt, distance);
        int32_t strike_birth = 0;
        for (int64_t i = 0; i < tree->count; i++) {
            if (tree->radius[i] == LIGHTNING_STRIKE) {
                strike_birth = tree->birth[i] > strike_birth ? tree->birth[i] : strike_birth;
                for (int32_t k = (int32_t)i; k >= 0; k = tree->parent[k]) {
                    on_way[k] = true;
                }
            }
        }
        done = drop_late(tree, bolt, strike_birth, on_way, e);
    }
    free(on_way);
    free(distance);
    return done;
}

OutTree *lightning_grow_bolt(const Bolt *bolt, const Recipe *recipe, Error *e)
{
    OutTree *tree = grow_leader(bolt, recipe->run, e);
    if (tree && !(grow_branches(tree, bolt, recipe, e) && finish_bolt(tree, bolt, e))) {
        out_tree_free(tree);
        return NULL;
    }
    return tree;
}

bool lightning_add_streamers(OutTree *tree, const Bolt *bolt, int32_t last_birth, Error *e)
{
    enum { STEPS = 4 };
    int32_t colony = bolt->params->bolts + bolt->colony;
    for (int s = 0; s < bolt->params->streamers; s++) {
        uint64_t key = random_key(random_key(bolt->seed, STREAM_BOLT_STREAMERS), (uint64_t)s);
        float turn = random_range(random_key(key, STREAM_STREAMER_AZIMUTH), 0.0f, 2.0f * PI_F),
              sine, cosine;
        float away =
            random_range(random_key(key, STREAM_STREAMER_RADIUS), 0.03f, 0.16f) * bolt->height;
        float length =
            random_range(random_key(key, STREAM_STREAMER_LENGTH), 0.025f, 0.06f) * bolt->height;
        exact_sincos(turn, &sine, &cosine);
        Vec3 p = vec3_add(bolt->strike, vec3(away * cosine, 0.0f, 0.4f * away * sine));
        // up, and toward the descending leader
        Vec3 toward = vec3_madd(vec3_sub(bolt->strike, p), -0.3f * bolt->height, bolt->axis);
        int64_t parent = -1;
        uint64_t id = random_key(key, STREAM_STREAMER_ID);
        for (int k = 0; k <= STEPS; k++) {
            int32_t birth = last_birth - last_birth * (STEPS - k) / 40;
            parent = out_tree_add_node(tree, p, parent, birth, colony, id, e);
            if (parent < 0) {
                return false;
            }
            p = vec3_madd(p, length / STEPS, vec3_normalize(toward));
            id = out_tree_child_id(id, 0);
        }
    }
    return true;
}
