#include "objects/ice_cracks/ice_cracks.h"

#include "base/exact_math.h"
#include "base/noise.h"
#include "base/random.h"
#include "objects/ice_cracks/crack_field.h"

enum { STREAM_CRACK = 1 }; // of the object's seed
// Of a crack's key.
enum { STREAM_PLACE = 1, STREAM_COURSE = 2, STREAM_STAR = 3, STREAM_STRAY = 4, STREAM_ARM = 8 };
enum { STREAM_LOOSE = 1, STREAM_LENGTH = 2, STREAM_WANDER = 3 }; // of an arm's key
enum {
    CANDIDATES = 8,     // places of which a crack takes the one farthest from older cracks
    STEPS = 32,         // of growth over a spacing
    MOST_CRACKS = 24,   // in a square of the spacing
    MOST_SQUARES = 1000 // such squares along a side
};

#define FINEST 1e-4f     // of the depth or the spacing: the least grain
#define REACH 0.75f      // in spacings: how far off an older crack is felt where one starts
#define BEND_REACH 0.35f // and where one runs
#define BEND 0.22f       // share of the angle to an older crack by which a step turns beside it
#define NOISE_RMS 0.25f  // of noise_plane
#define STRAY 0.2f       // radians, rms, from the way straight off an older crack

float ice_cracks_step(const IceCracksParams *params)
{
    return params->spacing / (float)STEPS;
}

float ice_cracks_grain(const IceCracksParams *params)
{
    float larger = params->depth > params->spacing ? params->depth : params->spacing;
    float least = FINEST * larger;
    float grain = params->grain > 0.0f ? params->grain : 0.01f * params->spacing;
    return grain > least ? grain : least;
}

static uint64_t crack_key(uint64_t seed, int32_t crack)
{
    return random_key(random_key(seed, STREAM_CRACK), (uint64_t)crack);
}

bool ice_cracks_arm_is_loose(const IceCracksParams *params, uint64_t seed, int32_t crack, int arm,
                             float *length)
{
    uint64_t key = random_key(crack_key(seed, crack), STREAM_ARM + (uint64_t)arm);
    *length = params->spacing * random_range(random_key(key, STREAM_LENGTH), 0.25f, 1.25f);
    return random_unit(random_key(key, STREAM_LOOSE)) < params->loose;
}

// ---- growth

typedef struct Growing {
    const IceCracksParams *params;
    uint64_t seed;
    OutTree *tree;
    CrackField field;
    double length; // m, of all cracks
    int32_t birth; // of the last node
    float step;    // m
} Growing;

// v turned about the vertical.
static Vec3 turned(Vec3 v, float angle)
{
    float s, c;
    exact_sincos(angle, &s, &c);
    return vec3(c * v.x + s * v.z, 0.0f, c * v.z - s * v.x);
}

// Angle by which to turn a to the direction of b, in (-pi, pi].
static float angle_between(Vec3 a, Vec3 b)
{
    return exact_atan2(a.z * b.x - a.x * b.z, vec3_dot(a, b));
}

// Where a crack starts, and which way: off the nearest older one.
static void choose_start(const Growing *g, uint64_t key, Vec3 *place, Vec3 *course)
{
    float farthest = -1.0f, half = 0.5f * g->params->size;
    uint64_t places = random_key(key, STREAM_PLACE);
    *course = turned(vec3(1, 0, 0), 6.2831853f * random_unit(random_key(key, STREAM_COURSE)));
    Vec3 any = *course;
    for (uint64_t k = 0; k < CANDIDATES; k++) {
        uint64_t at = random_key(places, k);
        Vec3 p = vec3(random_range(random_key(at, 0), -half, half), 0.0f,
                      random_range(random_key(at, 1), -half, half));
        CrackContact contact;
        bool near = crack_field_nearest(&g->field, p, -1, &contact);
        if (contact.distance > farthest) {
            Vec3 off = vec3_sub(p, contact.at);
            farthest = contact.distance;
            *place = p;
            *course = near && vec3_dot(off, off) > 0.0f ? vec3_normalize(off) : any;
        }
    }
    *course = turned(*course, STRAY * random_normal(random_key(key, STREAM_STRAY)));
}

// Adds a node of the arm at p; *node becomes it.
static bool add(Growing *g, int64_t *node, Vec3 p, int64_t place, Vec3 heading, Error *e)
{
    OutTree *tree = g->tree;
    int64_t parent = *node;
    g->length += (double)vec3_distance(tree->position[parent], p);
    *node = out_tree_add_node(tree, p, parent, ++g->birth, tree->colony[parent],
                              out_tree_child_id(tree->id[parent], place), e);
    if (*node < 0) {
        return false;
    }
    tree->normal[*node] = vec3(-heading.z, 0.0f, heading.x);
    return true;
}

// Tension acts along an older crack only, so a crack beside it turns to it.
static Vec3 bent(const Growing *g, Vec3 p, Vec3 course)
{
    CrackContact contact;
    float reach = BEND_REACH * g->params->spacing;
    if (!crack_field_nearest(&g->field, p, -1, &contact) || contact.distance >= reach ||
        !(contact.distance > 0.0f)) {
        return course;
    }
    Vec3 to = vec3_scale(vec3_sub(contact.at, p), 1.0f / contact.distance);
    if (vec3_dot(course, to) <= 0.0f) {
        return course; // it leaves
    }
    return turned(course, BEND * (1.0f - contact.distance / reach) * angle_between(course, to));
}

// Shortens the way from a to *b to the square; returns whether it was longer.
static bool clip_to_square(float half, Vec3 a, Vec3 *b)
{
    Vec3 way = vec3_sub(*b, a);
    float t = 1.0f;
    const float from[2] = {a.x, a.z}, by[2] = {way.x, way.z};
    for (int i = 0; i < 2; i++) {
        float edge = by[i] > 0.0f ? half : -half, end = from[i] + by[i];
        if (end > half || end < -half) {
            float share = (edge - from[i]) / by[i];
            t = share < t ? share : t;
        }
    }
    *b = vec3_madd(a, t > 0.0f ? t : 0.0f, way);
    return t < 1.0f;
}

static bool grow_arm(Growing *g, int64_t root, Vec3 course, int arm, Error *e)
{
    const IceCracksParams *params = g->params;
    int32_t crack = g->tree->colony[root];
    float most, path = 0.0f, reach = 4.0f * params->size;
    bool loose = ice_cracks_arm_is_loose(params, g->seed, crack, arm, &most);
    most = loose ? most : reach; // enough to leave the square
    uint64_t wander = random_key(random_key(crack_key(g->seed, crack), STREAM_ARM + (uint64_t)arm),
                                 STREAM_WANDER);
    float swing = params->wander * RADIANS_PER_DEGREE / NOISE_RMS;
    int64_t node = root;
    for (bool ended = false; !ended && path < most;) {
        Vec3 p = g->tree->position[node], at;
        course = bent(g, p, course);
        Vec3 heading = turned(course, swing * noise_plane(path / params->spacing, 0.0f, wander));
        float step = g->step < most - path ? g->step : most - path;
        Vec3 end = vec3_madd(p, step, heading);
        ended = clip_to_square(0.5f * params->size, p, &end);
        if (crack_field_crossing(&g->field, p, end, &at)) {
            end = at;
            ended = true;
        }
        if (!add(g, &node, end, path > 0.0f ? 0 : arm, heading, e)) {
            return false;
        }
        path += step;
    }
    return true;
}

static bool grow_crack(Growing *g, int32_t crack, Error *e)
{
    uint64_t key = crack_key(g->seed, crack);
    Vec3 place = vec3(0, 0, 0), course;
    choose_start(g, key, &place, &course);
    int arms = random_unit(random_key(key, STREAM_STAR)) < g->params->stars ? ICE_CRACK_ARMS : 2;
    int64_t root = out_tree_add_node(g->tree, place, -1, g->birth, crack, key, e);
    if (root < 0) {
        return false;
    }
    g->tree->normal[root] = vec3(-course.z, 0.0f, course.x);
    for (int arm = 0; arm < arms; arm++) {
        Vec3 way = turned(course, 6.2831853f * (float)arm / (float)arms);
        if (!grow_arm(g, root, way, arm, e)) {
            return false;
        }
    }
    for (int64_t i = root + 1; i < g->tree->count; i++) { // it feels older ones only, not itself
        if (!crack_field_add(&g->field, g->tree->position[g->tree->parent[i]], g->tree->position[i],
                             crack, e)) {
            return false;
        }
    }
    return true;
}

bool ice_cracks_grow(const void *given, const Recipe *recipe, Grown *whole, Error *e)
{
    const IceCracksParams *params = given;
    double squares = (double)params->size / (double)params->spacing; // along a side
    if (squares > (double)MOST_SQUARES) {
        error_set(e, ERROR_INPUT,
                  "cracks %g m apart over %g m are too many: spacing must be at least %g m, a "
                  "thousandth of size",
                  (double)params->spacing, (double)params->size,
                  (double)params->size / (double)MOST_SQUARES);
        return recipe_fail(recipe, NULL, e);
    }
    Growing g = {.params = params,
                 .seed = recipe->seed,
                 .step = ice_cracks_step(params),
                 .tree = whole->tree = out_tree_new(e)};
    if (!g.tree || !crack_field_new(&g.field, params->size, REACH * params->spacing, e)) {
        return false;
    }
    double wanted = 1.5707963 * squares * (double)params->size; // Crofton's formula
    double most = (double)MOST_CRACKS * (squares * squares + 1.0);
    most = most < 1e8 ? most : 1e8;
    bool done = true;
    for (int32_t crack = 0; done && g.length < wanted && crack < (int32_t)most; crack++) {
        done = (!run_is_cancelled(recipe->run) || run_cancel_error(e)) && grow_crack(&g, crack, e);
    }
    crack_field_clear(&g.field);
    return done;
}
