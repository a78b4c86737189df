#include "objects/frost_flower/frost_flower.h"

#include "base/exact_math.h"
#include "base/random.h"
#include "objects/common/blades.h"
#include "outtree/radii.h"

// Of a feather's key.
enum {
    STREAM_AZIMUTH = 1,
    STREAM_TILT = 2,
    STREAM_LENGTH = 3,
    STREAM_ROLL = 4,
    STREAM_BEND = 5,
    STREAM_WIDTH = 6,
    STREAM_SWAY = 7,
    STREAM_CUP = 8,
    STREAM_TWIST = 9,
    STREAM_STUNT = 10
};
// Of a node's id: of its two sides, and SIDE + side of each.
enum { STREAM_BOTH = 1, STREAM_SIDE = 10 };
enum { STREAM_REACH = 1, STREAM_SKIP = 2, STREAM_ANGLE = 3 }; // of a side's key
// Of the object's seed; WAVES and the numbers after it.
enum {
    STREAM_OPEN = 1,
    STREAM_FEATHERS = 2,
    STREAM_ROOTS = 3,
    STREAM_CROWNS = 4,
    STREAM_WAVES = 10
};

#define GOLDEN_ANGLE 2.39996323f // radians
#define FINER 0.42f              // distance between sides, in that of the order before
#define BIRTHS 600.0f            // steps of growth in the time that a path takes for half the size
#define CROWNS 3                 // points of an uneven flower about which feathers stand

// A branch as it grows: where its last node is and how it goes on.
typedef struct Shoot {
    int64_t node;
    Vec3 heading, normal; // unit
    float path;           // m from the root
    int32_t colony;
} Shoot;

// What one branch will be.
typedef struct Plan {
    int order;     // 0 = the rib of a feather
    int64_t place; // child number of its first node
    float length;  // m
    float curl;    // radians in the plane, toward +cross(normal, heading)
    float bend;    // radians out of the plane, away from the normal
    float cup;     // radians by which its sides rise out of the plane
    float width;   // of the feather, relative to its length
    float twist;   // radians by which its plane turns about it
} Plan;

typedef struct Flower {
    const FrostFlowerParams *params;
    OutTree *tree;
    float spacing[FLOWER_MOST_ORDERS]; // m, of the sides of each order
} Flower;

static void turn(Vec3 *v, Vec3 axis, float angle)
{
    float s, c;
    exact_sincos(angle, &s, &c);
    *v = vec3_rotate(*v, axis, c, s);
}

static Vec3 step_end(const Flower *flower, const Shoot *shoot, float step)
{
    return vec3_madd(flower->tree->position[shoot->node], step, shoot->heading);
}

// Appends a node at the shoot's end after a step along its heading, as child number `place`.
static bool step_on(Flower *flower, Shoot *shoot, float step, int64_t place, Error *e)
{
    OutTree *tree = flower->tree;
    Vec3 p = step_end(flower, shoot, step);
    uint64_t id = out_tree_child_id(tree->id[shoot->node], place);
    shoot->path += step;
    int32_t birth = (int32_t)(BIRTHS * 2.0f * shoot->path / flower->params->size);
    int32_t least = tree->birth[shoot->node] + 1;
    birth = birth > least ? birth : least;
    shoot->node = out_tree_add_node(tree, p, shoot->node, birth, shoot->colony, id, e);
    if (shoot->node < 0) {
        return false;
    }
    tree->normal[shoot->node] = shoot->normal;
    return true;
}

// Longest side at share t of the way along a branch, in that branch's lengths: a feather is widest
// at a third of its length; a side ends where the tip's growth has not yet reached.
static float reach_at(const Plan *plan, float t)
{
    float half = plan->order == 0 ? 0.5f * plan->width : 0.35f;
    float shape = 2.6f * sqrtf(t) * (1.0f - t);
    float ahead = 0.85f * (1.0f - t);
    return half * shape < ahead ? half * shape : ahead;
}

static bool grow_branch(Flower *flower, Shoot shoot, const Plan *plan, Error *e);

static bool grow_side(Flower *flower, const Shoot *from, const Plan *bearer, float t, int side,
                      Error *e)
{
    const FrostFlowerParams *params = flower->params;
    uint64_t id = flower->tree->id[from->node];
    uint64_t key = random_key(id, STREAM_SIDE + (uint64_t)side), both = random_key(id, STREAM_BOTH);
    float sign = side == 0 ? 1.0f : -1.0f;
    float most = reach_at(bearer, t) * bearer->length;
    if (bearer->order > 0) { // to the next of its own order, and no farther
        float next = 0.85f * flower->spacing[bearer->order - 1];
        most = most < next ? most : next;
    }
    // both sides met the same air
    float length = most * random_range(random_key(both, STREAM_REACH), 0.55f, 1.0f) *
                   random_range(random_key(key, STREAM_REACH), 0.85f, 1.05f);
    if (length < 0.4f * flower->spacing[bearer->order] ||
        random_unit(random_key(key, STREAM_SKIP)) < params->skip) {
        return true;
    }
    Shoot shoot = *from;
    float noise = 2.0f * random_normal(random_key(key, STREAM_ANGLE));
    turn(&shoot.heading, shoot.normal, sign * (params->angle + noise) * RADIANS_PER_DEGREE);
    if (bearer->cup != 0.0f) { // the plane folds along the rib
        turn(&shoot.heading, from->heading, sign * bearer->cup);
        turn(&shoot.normal, from->heading, sign * bearer->cup);
    }
    Plan plan = {.order = bearer->order + 1,
                 .place = 1 + side,
                 .length = length,
                 .curl = -sign * params->curl * RADIANS_PER_DEGREE * length / most,
                 .bend = 0.25f * bearer->bend};
    return grow_branch(flower, shoot, &plan, e);
}

static void bend_on(Shoot *shoot, const Plan *plan, float share)
{
    turn(&shoot->heading, shoot->normal, plan->curl * share);
    Vec3 across = vec3_normalize(vec3_cross(shoot->normal, shoot->heading));
    turn(&shoot->heading, across, plan->bend * share);
    turn(&shoot->normal, across, plan->bend * share);
    if (plan->twist != 0.0f) {
        turn(&shoot->normal, shoot->heading, plan->twist * share);
    }
}

static bool grow_branch(Flower *flower, Shoot shoot, const Plan *plan, Error *e)
{
    bool bears = plan->order < flower->params->orders;
    float wanted = flower->spacing[bears ? plan->order : plan->order - 1];
    int count = (int)(plan->length / wanted + 0.5f);
    count = count > 1 ? count : 1;
    float step = plan->length / (float)count;
    for (int i = 1; i <= count; i++) {
        float t = (float)i / (float)count;
        if (i > 1) { // a side leaves at its angle
            bend_on(&shoot, plan, 1.0f / (float)count);
        }
        if (step_end(flower, &shoot, step).y < 0.0f) {
            return true; // it has met the ice
        }
        if (!step_on(flower, &shoot, step, i == 1 ? plan->place : 0, e)) {
            return false;
        }
        for (int side = 0; bears && i < count && side < 2; side++) {
            if (!grow_side(flower, &shoot, plan, t, side, e)) {
                return false;
            }
        }
    }
    return true;
}

// A smooth number, -1..1, of the direction about the foot: another one for each `which`.
static float wave_about(uint64_t seed, int which, float azimuth)
{
    float sum = 0.0f, s, c;
    for (int k = 1; k <= 2; k++) {
        uint64_t key = random_key(seed, STREAM_WAVES + (uint64_t)(2 * which + k));
        exact_sincos((float)k * azimuth + 2.0f * PI_F * random_unit(key), &s, &c);
        sum += (k == 1 ? 0.6f : 0.4f) * s;
    }
    return sum;
}

// What makes a feather of an uneven flower differ from that of an even one.
typedef struct Uneven {
    float azimuth; // radians to add
    float tilt;    // degrees to add
    float length;  // factor
    float sway;    // factor on its bend in the plane
    float twist;   // radians
    Vec3 foot;     // m to add
} Uneven;

// Crystals stand in tufts with gaps between them, those toward the vapour grow long and those in
// the lee of older ones stay short, and a plate seldom stays flat as it grows.
static Uneven uneven_of(const FrostFlowerParams *params, int i, float azimuth, uint64_t key,
                        uint64_t seed)
{
    Uneven n = {.length = 1.0f, .sway = 1.0f};
    float most = params->uneven;
    if (most <= 0.0f) {
        return n;
    }
    n.azimuth = 0.9f * most * wave_about(seed, 0, azimuth);
    azimuth += n.azimuth;
    n.tilt = 26.0f * most * wave_about(seed, 1, azimuth);
    float stunt = random_unit(random_key(key, STREAM_STUNT));
    n.length =
        (1.0f + 0.3f * most * wave_about(seed, 2, azimuth)) * (1.0f - 0.6f * most * stunt * stunt);
    n.sway = 1.0f + 1.6f * most;
    n.twist = 0.9f * most * random_normal(random_key(key, STREAM_TWIST));
    uint64_t crown = random_key(random_key(seed, STREAM_CROWNS), (uint64_t)(i % CROWNS));
    float s, c;
    exact_sincos(2.0f * PI_F * random_unit(crown), &s, &c);
    float away = 0.13f * most * params->size * random_unit(random_key(crown, 1));
    n.foot = vec3(away * c, 0.0f, away * s);
    return n;
}

// The outer feathers lie lower and are longer; `open` tells how soon they do.
static bool grow_feather(Flower *flower, int i, float open, uint64_t seed, Error *e)
{
    const FrostFlowerParams *params = flower->params;
    uint64_t key = random_key(random_key(seed, STREAM_FEATHERS), (uint64_t)i);
    float u = ((float)i + 0.5f) / (float)params->feathers;
    float azimuth =
        GOLDEN_ANGLE * (float)i + 0.25f * random_normal(random_key(key, STREAM_AZIMUTH));
    const Uneven uneven = uneven_of(params, i, azimuth, key, seed);
    azimuth += uneven.azimuth;
    float tilt =
        params->spread * exact_pow(u, open) + 7.0f * random_normal(random_key(key, STREAM_TILT));
    tilt = clampf(tilt + uneven.tilt, 0.0f, 88.0f);
    float sa, ca, st, ct;
    exact_sincos(azimuth, &sa, &ca);
    exact_sincos(tilt * RADIANS_PER_DEGREE, &st, &ct);
    Vec3 out = vec3(ca, 0.0f, sa);
    Shoot shoot = {.heading = vec3(st * ca, ct, st * sa), .colony = i};
    shoot.normal = vec3(-ct * ca, st, -ct * sa); // the feather's upper face
    turn(&shoot.normal, shoot.heading, 0.6f * random_normal(random_key(key, STREAM_ROLL)));
    float bend =
        params->bend * (0.4f + 0.6f * u) + 22.0f * random_normal(random_key(key, STREAM_BEND));
    bend = clampf(bend, -60.0f, 95.0f - tilt); // its tip hangs, but not into the ice
    float short_by = random_unit(random_key(key, STREAM_LENGTH)); // few are short
    Plan plan = {.length = 0.5f * params->size * lerpf(0.8f, 1.0f, u) *
                           (1.05f - 0.55f * short_by * short_by) * uneven.length,
                 .curl = 0.25f * uneven.sway * random_normal(random_key(key, STREAM_SWAY)),
                 .bend = bend * RADIANS_PER_DEGREE,
                 .cup = random_range(random_key(key, STREAM_CUP), -0.1f, 0.35f),
                 .width = params->feather_width *
                          random_range(random_key(key, STREAM_WIDTH), 0.75f, 1.2f),
                 .twist = uneven.twist};
    Vec3 foot = vec3_add(vec3_scale(out, 0.05f * params->size * u), uneven.foot);
    uint64_t id = random_key(random_key(seed, STREAM_ROOTS), (uint64_t)i);
    shoot.node = out_tree_add_node(flower->tree, foot, -1, 0, i, id, e);
    if (shoot.node < 0) {
        return false;
    }
    flower->tree->normal[shoot.node] = shoot.normal;
    return grow_branch(flower, shoot, &plan, e);
}

bool frost_flower_grow(const void *given, const Recipe *recipe, Grown *whole, Error *e)
{
    const FrostFlowerParams *params = given;
    Flower flower = {.params = params, .tree = whole->tree = out_tree_new(e)};
    flower.spacing[0] = 0.5f * params->size / (float)params->barbs;
    for (int k = 1; k < FLOWER_MOST_ORDERS; k++) {
        flower.spacing[k] = FINER * flower.spacing[k - 1];
    }
    float open = random_range(random_key(recipe->seed, STREAM_OPEN), 0.45f, 0.9f);
    bool done = flower.tree != NULL;
    for (int i = 0; done && i < params->feathers; i++) {
        done = run_goes_on(recipe->run, i, e) && grow_feather(&flower, i, open, recipe->seed, e);
    }
    return done;
}

// Distance between the finest sides, m.
static float finest_spacing(const FrostFlowerParams *params)
{
    float spacing = 0.5f * params->size / (float)params->barbs;
    for (int k = 1; k < params->orders; k++) {
        spacing *= FINER;
    }
    return spacing;
}

bool frost_flower_finish(const void *given, const Recipe *recipe, const Grown *whole, Grown *grown,
                         Error *e)
{
    (void)recipe, (void)whole, (void)e;
    const FrostFlowerParams *params = given;
    out_tree_pipe_radii(grown->tree, 6.0f, params->width_share * finest_spacing(params), 0.0f);
    return true;
}

bool frost_flower_geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    const FrostFlowerParams *params = given;
    const BladeParams blades = {params->relief, params->rime, params->rime};
    return blades_add(grown->tree, &blades, placing,
                      (const int[2]){FROST_FLOWER_ICE, FROST_FLOWER_RIME}, e);
}
