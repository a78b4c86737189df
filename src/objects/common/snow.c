#include "objects/common/snow.h"

#include "base/memory.h"
#include "base/random.h"
#include "objects/common/snow_fall.h"

#include <math.h>
#include <stdlib.h>

enum { STREAM_KEPT = 20, STREAM_DEPTH = 21 }; // of an instance
enum { SPRAY_CELLS = 9, SPRAY_CELLS_COARSE = 4 };

#define SPRAY_LEAST 0.08f // m: snow does not settle on smaller leaves
#define SPRAY_SHARE 0.12f // depth on a spray at most, of its length

// An instanced mesh that snow settles on.
typedef struct Spray {
    const Part *part;
    Vec3 size, middle; // m, of the mesh's bounds
    float length;      // m, the largest of its sizes
} Spray;

static bool spray_of(const Part *part, Spray *spray)
{
    if (part->kind != PART_MESH || part->instance_count == 0 || part->mesh->vertex_count == 0) {
        return false;
    }
    Aabb box = mesh_bounds(part->mesh);
    *spray = (Spray){.part = part,
                     .size = vec3_sub(box.high, box.low),
                     .middle = vec3_scale(vec3_add(box.low, box.high), 0.5f)};
    spray->length = vec3_largest(spray->size);
    return spray->length >= SPRAY_LEAST;
}

static Vec3 middle_of(const Spray *spray, int64_t instance)
{
    return transform_point(&spray->part->instance[instance], spray->middle);
}

// ---- how much snow comes through ----

static void add_instances(SnowFall *fall, const Spray *spray)
{
    float area = 0.5f * spray->length * spray->size.x;
    for (int64_t i = 0; i < spray->part->instance_count; i++) {
        snow_fall_add(fall, middle_of(spray, i), area);
    }
}

static void add_curves(SnowFall *fall, const CurveSet *curves)
{
    for (int64_t i = 0; i + 1 < curves->point_count; i++) {
        Vec3 step = vec3_sub(curves->position[i + 1], curves->position[i]);
        snow_fall_add(fall, curves->position[i], 2.0f * curves->radius[i] * vec3_length(step));
    }
}

static bool fall_init(SnowFall *fall, const CurveSet *curves, int64_t first,
                      const Geometry *geometry, Error *e)
{
    Aabb bounds = aabb_empty();
    Spray spray;
    for (int64_t i = 0; i < curves->point_count; i++) {
        bounds = aabb_add(bounds, curves->position[i]);
    }
    if (aabb_is_empty(bounds)) {
        bounds = aabb_add(bounds, vec3(0, 0, 0));
    }
    if (!snow_fall_init(fall, bounds, e)) {
        return false;
    }
    add_curves(fall, curves);
    for (int64_t i = first; i < geometry->count; i++) {
        if (spray_of(&geometry->part[i], &spray)) {
            add_instances(fall, &spray);
        }
    }
    snow_fall_finish(fall);
    return true;
}

static float share_of(const void *user, Vec3 p)
{
    return snow_fall_share(user, p);
}

// ---- sprays ----

enum { SPRAY_THIN, SPRAY_FULL, SPRAY_DEPTHS, SPRAY_SIDES = 2 };

typedef struct SprayPlaces {
    Transform *place;
    int64_t count, capacity;
} SprayPlaces;

typedef struct SpraySnow {
    const SnowParams *params;
    const SnowFall *fall;
    Spray spray;
    bool round; // needles all around: the upper side is wherever up is
    uint64_t seed;
    SprayPlaces places[SPRAY_SIDES][SPRAY_DEPTHS];
} SpraySnow;

// The placement turned about its Y so that its Z points up as far as it can.
static Transform turned_up(const Transform *t)
{
    Vec3 y = transform_vector(t, vec3(0, 1, 0));
    float scale = vec3_length(y);
    Vec3 along = vec3_scale(y, 1.0f / scale);
    Vec3 z = vec3_madd(vec3(0, 1, 0), -along.y, along);
    if (vec3_length(z) < 1e-3f) {
        return *t;
    }
    z = vec3_scale(vec3_normalize(z), scale);
    return transform_from_axes(vec3_cross(along, z), y, z, transform_point(t, vec3(0, 0, 0)));
}

static bool place_on_spray(SpraySnow *snow, int64_t i, Error *e)
{
    uint64_t key = random_key(snow->seed, (uint64_t)i);
    const Transform *given = &snow->spray.part->instance[i];
    Transform place = snow->round ? turned_up(given) : *given;
    Vec3 z = vec3_normalize(transform_vector(&place, vec3(0, 0, 1)));
    float amount = snow_stays(snow->params, fabsf(z.y)) *
                   snow_fall_share(snow->fall, middle_of(&snow->spray, i)) *
                   random_range(random_key(key, STREAM_DEPTH), 0.6f, 1.2f);
    if (random_unit(random_key(key, STREAM_KEPT)) < snow->params->gaps || amount < 0.2f) {
        return true;
    }
    SprayPlaces *places = &snow->places[z.y < 0.0f][amount > 0.55f ? SPRAY_FULL : SPRAY_THIN];
    if (!memory_reserve(&places->place, &places->capacity, places->count + 1, sizeof place, e)) {
        return false;
    }
    places->place[places->count++] = place;
    return true;
}

// Takes over the places.
static bool add_cushions(const Mesh *spray, float depth, bool turned, SprayPlaces *places,
                         const Placing *placing, int role, Error *e)
{
    Part part = {.mesh = snow_on_spray(spray, depth, turned, SPRAY_CELLS, e),
                 .instance = places->place,
                 .instance_count = places->count};
    places->place = NULL;
    if (!part.mesh || part.mesh->face_count == 0) {
        bool done = part.mesh;
        part_free_meshes(&part);
        free(part.instance);
        return done;
    }
    part.coarse[0].error = 0.5f * depth;
    part.coarse[0].mesh = snow_on_spray(spray, depth, turned, SPRAY_CELLS_COARSE, e);
    if (!part.coarse[0].mesh) {
        part_free_meshes(&part);
    }
    return placing_add(placing, part, role, e);
}

static bool add_on_sprays(SpraySnow *snow, const Placing *placing, int role, Error *e)
{
    const Spray *spray = &snow->spray;
    float depth = fminf(snow->params->depth, SPRAY_SHARE * spray->length);
    bool done = true;
    snow->round = spray->size.z > 0.6f * spray->size.x;
    for (int64_t i = 0; done && i < spray->part->instance_count; i++) {
        done = run_goes_on(placing->recipe->run, i, e) && place_on_spray(snow, i, e);
    }
    for (int k = 0; k < SPRAY_SIDES * SPRAY_DEPTHS; k++) {
        SprayPlaces *places = &snow->places[k / SPRAY_DEPTHS][k % SPRAY_DEPTHS];
        float share = k % SPRAY_DEPTHS == SPRAY_FULL ? 1.0f : 0.5f;
        if (done && places->count > 0) {
            done = add_cushions(spray->part->mesh, share * depth, k / SPRAY_DEPTHS > 0, places,
                                placing, role, e);
        }
        free(places->place);
    }
    return done;
}

static bool add_on_all_sprays(const SnowParams *params, const SnowFall *fall, int64_t first,
                              const Placing *placing, int role, Error *e)
{
    int64_t end = placing->geometry->count;
    bool done = true;
    for (int64_t i = first; done && i < end; i++) {
        Part part = placing->geometry->part[i]; // the list moves as parts are added
        SpraySnow snow = {.params = params,
                          .fall = fall,
                          .seed = random_key(placing->recipe->seed, (uint64_t)(i - first))};
        done = !spray_of(&part, &snow.spray) || add_on_sprays(&snow, placing, role, e);
    }
    return done;
}

// ---- branches ----

static bool add_on_branches(const CurveSet *curves, const OutTree *tree, const SnowParams *params,
                            int32_t bare_from, const SnowFall *fall, const Placing *placing,
                            int role, Error *e)
{
    bool *bare = bare_from >= 0 ? branches_bare(tree, curves, bare_from, e) : NULL;
    if (bare_from >= 0 && !bare) {
        return false;
    }
    SnowReach reach = {share_of, fall};
    Mesh *mesh = snow_on_curves(curves, bare, params, &reach, placing->recipe->run, e);
    free(bare);
    if (!mesh || mesh->face_count == 0) {
        bool done = mesh;
        mesh_free(mesh);
        return done;
    }
    return placing_add(placing, (Part){.mesh = mesh}, role, e);
}

bool snow_add(const OutTree *tree, const SkinningParams *skinning, const SnowParams *params,
              int32_t bare_from, int64_t first, const Placing *placing, int role, Error *e)
{
    if (params->depth <= 0.0f) {
        return true;
    }
    const float every_radius = 1e6f;
    SkinParams skin = branches_skin(skinning);
    CurveSet *curves = skin_curves(tree, every_radius, &skin, e);
    SnowFall fall = {0};
    bool done = curves && fall_init(&fall, curves, first, placing->geometry, e) &&
                add_on_all_sprays(params, &fall, first, placing, role, e) &&
                add_on_branches(curves, tree, params, bare_from, &fall, placing, role, e);
    snow_fall_free(&fall);
    curves_free(curves);
    return done;
}
