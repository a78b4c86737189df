// Where the copies of a swarm are and where they head: random points of its region, of which those
// are kept that are not too near to another; neighbours head alike.
#include "base/noise.h"
#include "base/random.h"
#include "base/turn.h"
#include "objects/swarm/swarm.h"
#include "shape/point_hash.h"
#include "shape/points.h"

enum { TRIES = 8 }; // points drawn for each copy where some are too near to another

// Of the object's seed.
enum { STREAM_POINTS = 1, STREAM_CLUMPS, STREAM_SWIRL };
// Of a point's id.
enum {
    STREAM_THING = 1,
    STREAM_VARIANT,
    STREAM_SIZE,
    STREAM_STRAY,
    STREAM_CLIMB,
    STREAM_ROLL,
};

typedef struct Clumps {
    const SwarmParams *params;
    uint64_t seed;
} Clumps;

// Share of the points that are kept at a place.
static float density(const void *user, Vec3 p)
{
    const Clumps *clumps = user;
    float noise = noise_space(vec3_scale(p, 1.0f / clumps->params->clump_size), clumps->seed);
    return things_clump_share(clumps->params->clumping, noise);
}

static Transform stand(const SwarmParams *params, uint64_t seed, Vec3 p, uint64_t key)
{
    // the noise reaches 0.7
    float swirl =
        noise_space(vec3_scale(p, 1.0f / params->swirl_size), random_key(seed, STREAM_SWIRL)) /
        0.7f;
    float azimuth = params->azimuth + params->swirl * swirl +
                    random_range(random_key(key, STREAM_STRAY), -params->stray, params->stray);
    Vec3 up = vec3(0, 1, 0), forward = vec3_turn(vec3(0, 0, -1), up, -azimuth);
    Vec3 left = vec3_cross(up, forward);
    forward = vec3_turn(forward, left,
                        random_range(random_key(key, STREAM_CLIMB), -params->climb, params->climb));
    left = vec3_turn(left, forward,
                     random_range(random_key(key, STREAM_ROLL), -params->roll, params->roll));
    float size = random_range(random_key(key, STREAM_SIZE), params->scale[0], params->scale[1]);
    return transform_from_axes(vec3_scale(left, size), vec3_scale(vec3_cross(forward, left), size),
                               vec3_scale(forward, size), p);
}

static void add_place(ThingPlaces *places, const SwarmParams *params, uint64_t seed, Vec3 p,
                      uint64_t key)
{
    const Things *things = &params->things;
    int thing = things_choose(things, random_unit(random_key(key, STREAM_THING)));
    float variant = random_unit(random_key(key, STREAM_VARIANT)) * (float)things->variants;
    places->thing[places->count] = thing * things->variants + (int)variant;
    places->place[places->count++] = stand(params, seed, p, key);
}

// The region's points in their order, but for those too near to one before.
static bool keep_apart(ThingPlaces *places, const SwarmParams *params, const PointSet *points,
                       uint64_t seed, Error *e)
{
    PointHash *taken = params->spacing > 0.0f ? point_hash_new(params->spacing, e) : NULL;
    bool done = taken || !(params->spacing > 0.0f);
    for (int64_t i = 0; done && i < points->count && places->count < params->count; i++) {
        Vec3 p = points->position[i], nearest;
        float least = params->spacing;
        if (taken && point_hash_nearest(taken, p, &least, &nearest)) {
            continue;
        }
        done = !taken || point_hash_add(taken, p, e);
        add_place(places, params, seed, p, points->id[i]);
    }
    point_hash_free(taken);
    return done;
}

bool swarm_places_init(ThingPlaces *places, const SwarmParams *params, const Recipe *recipe,
                       Error *e)
{
    Clumps clumps = {params, random_key(recipe->seed, STREAM_CLUMPS)};
    EnvelopeParams region = {
        .shapes = params->shapes, .shape_count = params->shape_count, .voxel = params->voxel};
    ScatterParams scatter = scatter_params_default();
    scatter.count = params->spacing > 0.0f ? TRIES * params->count : params->count;
    scatter.seed = random_key(recipe->seed, STREAM_POINTS);
    if (params->clumping > 0.0f) {
        scatter.density = density;
        scatter.density_user = &clumps;
    }
    Envelope *envelope = NULL;
    PointSet *points = NULL;
    bool done = thing_places_alloc(places, params->count, e) &&
                (envelope = envelope_new(&region, recipe->run, e)) &&
                (points = points_scatter(envelope, &scatter, recipe->run, e)) &&
                keep_apart(places, params, points, recipe->seed, e);
    points_free(points);
    envelope_free(envelope);
    return done;
}
