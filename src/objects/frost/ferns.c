#include "objects/frost/ferns.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"
#include "base/turn.h"
#include "grow/plume/plume.h"
#include "objects/frost/surface.h"
#include "outtree/crossings.h"

#include <stdlib.h>

// In mean spacings of the attractors.
static const float STEP = 0.8f, KILL = 0.75f, INFLUENCE = 3.5f;
static const float BARB_SPACING = 4.2f, BARBULE_SPACING = 1.9f;

enum { STREAM_TURN = 90, STREAM_SENSE = 91, STREAM_LATE = 92, STREAM_FAN = 93 };

static void project(const void *surface, Vec3 *p, Vec3 *normal)
{
    *normal = frost_project(surface, p);
}

// Mean distance between ribs, m.
static float rib_spacing(const FrostParams *params)
{
    return sqrtf(frost_area(params) / (float)params->spines);
}

// Ribs, in order of their births. Some start late, so that some plumes lie before others.
typedef struct Starts {
    PlumeStart *start;
    int64_t count, capacity;
} Starts;

static int by_birth(const void *a, const void *b)
{
    const PlumeStart *one = a, *other = b;
    int order = (one->birth > other->birth) - (one->birth < other->birth);
    return order != 0 ? order : (one->number > other->number) - (one->number < other->number);
}

// A rib from p in the tangent direction nearest to `aim`, turned by an angle.
static bool add_start(Starts *starts, const FrostParams *params, Vec3 p, Vec3 aim, float degrees,
                      uint64_t key, Error *e)
{
    Vec3 normal = frost_project(params, &p);
    Vec3 heading = vec3_madd(aim, -vec3_dot(aim, normal), normal);
    heading =
        vec3_dot(heading, heading) > 1e-8f ? vec3_normalize(heading) : vec3_perpendicular(normal);
    float strength = random_range(random_key(key, STREAM_TURN), 0.4f, 1.3f);
    strength *= random_unit(random_key(key, STREAM_SENSE)) < 0.3f ? -1.0f : 1.0f;
    float late = random_unit(random_key(key, STREAM_LATE));
    float path = 0.35f * sqrtf(frost_area(params)) / (STEP * frost_side_spacing(params));
    PlumeStart start = {.position = p,
                        .heading = vec3_turn(heading, normal, degrees),
                        .turn = strength * params->turn * RADIANS_PER_DEGREE /
                                sqrtf(frost_area(params)),
                        .birth = (int32_t)(late * late * path),
                        .number = starts->count};
    if (!memory_reserve(&starts->start, &starts->capacity, starts->count + 1, sizeof *starts->start,
                        e)) {
        return false;
    }
    starts->start[starts->count++] = start;
    return true;
}

// A fan of ribs from every nucleus, inward on a pane.
static bool add_nuclei(Starts *starts, const FrostParams *params, uint64_t seed, Error *e)
{
    bool inward = params->surface == FROST_PANE && params->place == FROST_BORDER;
    for (int i = 0; i < frost_nucleus_total(params); i++) {
        Vec3 normal, p = frost_nucleus(params, i, seed, &normal);
        uint64_t key = random_key(random_key(seed, (uint64_t)i), STREAM_FAN);
        Vec3 to = vec3_sub(params->position, p);
        to = vec3(to.x / params->width, to.y / params->height, 0.0f);
        bool flat = fabsf(to.x) > fabsf(to.y);
        Vec3 aim =
            flat ? vec3(to.x > 0.0f ? 1.0f : -1.0f, 0, 0) : vec3(0, to.y > 0.0f ? 1.0f : -1.0f, 0);
        aim = inward ? aim : random_direction(random_key(key, 0));
        int ribs = inward ? 1 + (int)(3.0f * random_unit(random_key(key, 1))) : 6;
        float fan = inward ? 50.0f : 60.0f, first = inward ? -0.5f * fan * (float)(ribs - 1) : 0.0f;
        for (int k = 0; k < ribs; k++) {
            uint64_t own = random_key(key, 2 + (uint64_t)k);
            float degrees = first + fan * (float)k + 10.0f * random_normal(own);
            if (!add_start(starts, params, p, aim, degrees, own, e)) {
                return false;
            }
        }
    }
    return true;
}

// Ribs along a scratch, in turn to both sides.
static bool add_scratches(Starts *starts, const FrostParams *params, uint64_t seed, Error *e)
{
    for (int i = 0; i < params->scratches; i++) {
        uint64_t key = random_key(seed, (uint64_t)i);
        Vec3 middle = vec3(random_range(random_key(key, 0), -0.4f, 0.4f) * params->width,
                           random_range(random_key(key, 1), -0.4f, 0.4f) * params->height, 0.0f);
        float s, c, length = params->width * random_range(random_key(key, 2), 0.15f, 0.5f);
        exact_sincos(random_range(random_key(key, 3), 0.0f, PI_F), &s, &c);
        int count = 1 + (int)(1.2f * length / rib_spacing(params));
        for (int k = 0; k < count; k++) {
            uint64_t own = random_key(key, 4 + (uint64_t)k);
            float t = ((float)k + random_range(random_key(own, 0), -0.3f, 0.3f)) / (float)count;
            Vec3 p = vec3_madd(vec3_add(params->position, middle), (t - 0.5f) * length,
                               vec3(c, s, 0.0f));
            if (fabsf(p.x - params->position.x) < 0.5f * params->width &&
                fabsf(p.y - params->position.y) < 0.5f * params->height &&
                !add_start(starts, params, p, vec3(c, s, 0.0f),
                           (k % 2 == 0 ? 60.0f : -60.0f) + 12.0f * random_normal(own), own, e)) {
                return false;
            }
        }
    }
    return true;
}

static int by_value(const void *a, const void *b)
{
    float one = *(const float *)a, other = *(const float *)b;
    return (one > other) - (one < other);
}

// How much moisture there was at p, in no unit: noise.
static float moisture(const FrostParams *params, Vec3 p, uint64_t seed)
{
    p = vec3_scale(p, 4.0f / sqrtf(frost_area(params)));
    return noise_space(p, seed) + 0.5f * noise_space(vec3_scale(p, 2.1f), seed + 1);
}

// Removes the attractors of the clear islands, the driest ones.
static bool clear_islands(PointSet *points, const FrostParams *params, uint64_t seed, Error *e)
{
    float *wet = memory_alloc(2 * points->count, sizeof *wet, e);
    if (!wet) {
        return false;
    }
    float *sorted = wet + points->count;
    for (int64_t i = 0; i < points->count; i++) {
        sorted[i] = wet[i] = moisture(params, points->position[i], seed);
    }
    qsort(sorted, (size_t)points->count, sizeof *sorted, by_value);
    int64_t first = (int64_t)((double)params->clear * (double)points->count), kept = 0;
    float least = sorted[first < points->count ? first : points->count - 1];
    for (int64_t i = 0; i < points->count; i++) {
        if (wet[i] >= least) {
            points->position[kept] = points->position[i];
            points->normal[kept] = points->normal[i];
            points->id[kept++] = points->id[i];
        }
    }
    points->measure *= (double)kept / (double)points->count;
    points->count = kept;
    free(wet);
    return true;
}

static PointSet *fern_points(const FrostParams *params, const Recipe *recipe, Error *e)
{
    int64_t count = params->sides > 0 ? params->sides : 1;
    PointSet *points = frost_points(
        params, count, random_key(recipe->seed, STREAM_FROST_SIDE_POINTS), recipe->run, e);
    uint64_t seed = random_key(recipe->seed, STREAM_FROST_ISLANDS);
    if (points && params->clear > 0.0f && !clear_islands(points, params, seed, e)) {
        points_free(points);
        return NULL;
    }
    return points;
}

static PlumeParams plume_params(const FrostParams *params, const Recipe *recipe)
{
    float s = frost_side_spacing(params);
    float ribs = rib_spacing(params);
    return (PlumeParams){.step = STEP * s,
                         .kill = KILL * s,
                         .influence = INFLUENCE * s,
                         .order = {{.spacing = BARB_SPACING * s,
                                    .angle = params->angle,
                                    .curl = params->curl,
                                    .length = 1.6f * ribs,
                                    .period = 1},
                                   {.spacing = BARBULE_SPACING * s,
                                    .angle = params->angle,
                                    .curl = 0.5f * params->curl,
                                    .length = 3.0f * BARB_SPACING * s,
                                    .taper = 0.8f,
                                    .period = 2},
                                   {.spacing = BARBULE_SPACING * s,
                                    .angle = params->angle,
                                    .curl = 0.5f * params->curl,
                                    .length = 2.0f * BARB_SPACING * s,
                                    .taper = 0.8f,
                                    .period = 3}},
                         .orders = params->orders < PLUME_MOST_ORDERS ? params->orders
                                                                      : PLUME_MOST_ORDERS,
                         .side_rib = 2.0f * BARB_SPACING * s / ribs,
                         .side_length = 4.0f * ribs,
                         .field_weight = params->field_weight,
                         .spread = 2.0f,
                         .skip = params->skip,
                         .project = project,
                         .surface = params,
                         .room = recipe->room,
                         .seed = random_key(recipe->seed, STREAM_FROST_PLUMES)};
}

static bool grow_from(const Starts *starts, const FrostParams *params, const Recipe *recipe,
                      OutTree *tree, Error *e)
{
    PlumeParams growth = plume_params(params, recipe);
    PointSet *points = fern_points(params, recipe, e);
    bool done = points &&
                plume_grow(tree, starts->start, starts->count, points, &growth, recipe->run, e) &&
                out_tree_drop_crossings(tree, recipe->run, e);
    points_free(points);
    return done;
}

bool ferns_grow(const FrostParams *params, const Recipe *recipe, Grown *whole, Error *e)
{
    Starts starts = {0};
    uint64_t nuclei = random_key(recipe->seed, STREAM_FROST_NUCLEI);
    uint64_t scratches = random_key(recipe->seed, STREAM_FROST_SCRATCHES);
    bool done = add_nuclei(&starts, params, nuclei, e) &&
                add_scratches(&starts, params, scratches, e) && (whole->tree = out_tree_new(e));
    if (done && starts.start) { // there is a nucleus at least
        qsort(starts.start, (size_t)starts.count, sizeof *starts.start, by_birth);
        done = grow_from(&starts, params, recipe, whole->tree, e);
    }
    free(starts.start);
    return done;
}
