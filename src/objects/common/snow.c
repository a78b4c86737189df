#include "objects/common/snow.h"

#include "base/memory.h"
#include "base/random.h"
#include "objects/common/boughs.h"
#include "objects/common/snow_fall.h"

#include <math.h>
#include <stdlib.h>

enum { STREAM_PILLOWS = 20 }; // of an object

#define SPRAY_LEAST 0.08f     // m: snow does not settle on smaller leaves
#define NEEDLED_RADIUS 0.006f // m: thinner branches of plants with sprays are hidden by them
#define BEARER_SIZE 0.012f    // m: needles nearer to each other bear snow as one

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

// ---- boughs ----

// What of a spray bears snow: its faces, gathered in small cubes.
typedef struct SprayBearers {
    SnowBearer *bearer; // in the spray's space
    int64_t count, capacity;
} SprayBearers;

static void cube_of(const SnowBearer *bearer, int cube[3])
{
    cube[0] = (int)floorf(bearer->p.x / BEARER_SIZE);
    cube[1] = (int)floorf(bearer->p.y / BEARER_SIZE);
    cube[2] = (int)floorf(bearer->p.z / BEARER_SIZE);
}

static bool same_cube(const SnowBearer *a, const SnowBearer *b)
{
    int s[3], t[3];
    cube_of(a, s);
    cube_of(b, t);
    return s[0] == t[0] && s[1] == t[1] && s[2] == t[2];
}

static int compare_floats(float a, float b)
{
    return (a > b) - (a < b);
}

// By cubes; within one by place and area, so that sums do not depend on how the library sorts.
static int compare_bearers(const void *a, const void *b)
{
    const SnowBearer *left = a, *right = b;
    int s[3], t[3];
    cube_of(left, s);
    cube_of(right, t);
    int order[7] = {s[0] - t[0],
                    s[1] - t[1],
                    s[2] - t[2],
                    compare_floats(left->p.x, right->p.x),
                    compare_floats(left->p.y, right->p.y),
                    compare_floats(left->p.z, right->p.z),
                    compare_floats(left->area, right->area)};
    int k = 0;
    while (k < 6 && order[k] == 0) {
        k++;
    }
    return order[k];
}

// Each run of bearers of one cube becomes one of them.
static void merge_bearers(SprayBearers *all)
{
    int64_t kept = 0;
    for (int64_t i = 0; i < all->count;) {
        SnowBearer sum = {{0, 0, 0}, 0.0f};
        int64_t first = i;
        for (; i < all->count && same_cube(&all->bearer[first], &all->bearer[i]); i++) {
            sum.p = vec3_madd(sum.p, all->bearer[i].area, all->bearer[i].p);
            sum.area += all->bearer[i].area;
        }
        if (sum.area > 0.0f) {
            sum.p = vec3_scale(sum.p, 1.0f / sum.area);
            all->bearer[kept++] = sum;
        }
    }
    all->count = kept;
}

static bool bearers_of(const Mesh *mesh, SprayBearers *all, Error *e)
{
    *all = (SprayBearers){.bearer = memory_alloc(mesh->face_count, sizeof(SnowBearer), e)};
    for (int64_t f = 0; all->bearer && f < mesh->face_count; f++) {
        const uint32_t *corner = mesh->index + f * mesh->face_size;
        Vec3 a = mesh->position[corner[0]], b = mesh->position[corner[1]];
        Vec3 c = mesh->position[corner[2]], d = mesh->position[corner[mesh->face_size - 1]];
        Vec3 sum = vec3_add(vec3_add(a, b), vec3_add(c, d));
        all->bearer[all->count++] = (SnowBearer){
            vec3_scale(sum, 0.25f), 0.5f * vec3_length(vec3_cross(vec3_sub(c, a), vec3_sub(d, b)))};
    }
    if (all->bearer) {
        qsort(all->bearer, (size_t)all->count, sizeof *all->bearer, compare_bearers);
        merge_bearers(all);
    }
    return all->bearer;
}

// A spray at its place on a bough.
typedef struct Placed {
    int32_t bough;
    int32_t part;
    int64_t instance;
} Placed;

typedef struct BoughSnow {
    const SnowParams *params;
    SnowReach reach;
    const Placing *placing;
    int64_t first; // part of the geometry
    int parts;
    SprayBearers *of_part;
    Placed *placed; // by bough
    int64_t placed_count, placed_capacity;
    SnowBearer *bearer; // of the bough at hand
    int64_t bearer_count, bearer_capacity;
    SnowPile pile;
} BoughSnow;

static const Part *part_of(const BoughSnow *snow, int part)
{
    return &snow->placing->geometry->part[snow->first + part];
}

static int compare_placed(const void *a, const void *b)
{
    const Placed *s = a, *t = b;
    if (s->bough != t->bough) {
        return s->bough < t->bough ? -1 : 1;
    }
    if (s->part != t->part) {
        return s->part < t->part ? -1 : 1;
    }
    return s->instance < t->instance ? -1 : s->instance > t->instance;
}

// Finds every spray's bough.
static bool sort_sprays(BoughSnow *snow, const Boughs *boughs, Error *e)
{
    Spray spray;
    for (int k = 0; k < snow->parts; k++) {
        const Part *part = part_of(snow, k);
        if (!spray_of(part, &spray)) {
            continue;
        }
        if (!bearers_of(part->mesh, &snow->of_part[k], e)) {
            return false;
        }
        for (int64_t i = 0; i < part->instance_count; i++) {
            Vec3 stem = transform_point(&part->instance[i], vec3(0, 0, 0));
            Placed placed = {boughs_nearest(boughs, stem), k, i};
            if (!run_goes_on(snow->placing->recipe->run, i, e) ||
                !memory_reserve(&snow->placed, &snow->placed_capacity, snow->placed_count + 1,
                                sizeof placed, e)) {
                return false;
            }
            snow->placed[snow->placed_count++] = placed;
        }
    }
    if (snow->placed_count > 0) {
        qsort(snow->placed, (size_t)snow->placed_count, sizeof *snow->placed, compare_placed);
    }
    return true;
}

// Adds what of the spray bears snow to that of its bough.
static bool add_bearers(BoughSnow *snow, const Placed *placed, Error *e)
{
    const SprayBearers *all = &snow->of_part[placed->part];
    const Transform *t = &part_of(snow, placed->part)->instance[placed->instance];
    float scale = vec3_length(transform_vector(t, vec3(0, 1, 0)));
    if (!memory_reserve(&snow->bearer, &snow->bearer_capacity, snow->bearer_count + all->count,
                        sizeof *snow->bearer, e)) {
        return false;
    }
    for (int64_t i = 0; i < all->count; i++) {
        snow->bearer[snow->bearer_count++] =
            (SnowBearer){transform_point(t, all->bearer[i].p), scale * scale * all->bearer[i].area};
    }
    return true;
}

static bool pile_up(BoughSnow *snow, Error *e)
{
    uint64_t seed = random_key(snow->placing->recipe->seed, STREAM_PILLOWS);
    bool done = true;
    for (int64_t i = 0; done && i < snow->placed_count;) {
        int32_t bough = snow->placed[i].bough;
        snow->bearer_count = 0;
        for (; done && i < snow->placed_count && snow->placed[i].bough == bough; i++) {
            done = add_bearers(snow, &snow->placed[i], e);
        }
        done = done && run_goes_on(snow->placing->recipe->run, 0, e) &&
               snow_add_pillows(&snow->pile, snow->bearer, snow->bearer_count, snow->params,
                                &snow->reach, random_key(seed, (uint64_t)bough), e);
    }
    return done;
}

static void bough_snow_clear(BoughSnow *snow)
{
    for (int k = 0; snow->of_part && k < snow->parts; k++) {
        free(snow->of_part[k].bearer);
    }
    free(snow->of_part);
    free(snow->placed);
    free(snow->bearer);
    snow_pile_clear(&snow->pile);
}

// Adds a mesh that may be empty or NULL, with e; takes it over.
static bool add_snow(Mesh *mesh, const Placing *placing, int role, Error *e)
{
    if (!mesh || mesh->face_count == 0) {
        bool done = mesh;
        mesh_free(mesh);
        return done;
    }
    return placing_add(placing, (Part){.mesh = mesh}, role, e);
}

// *pillows: whether there are any.
static bool add_on_boughs(const OutTree *tree, const SnowParams *params, const SnowFall *fall,
                          int64_t first, const Placing *placing, int role, bool *pillows, Error *e)
{
    BoughSnow snow = {.params = params,
                      .reach = {share_of, fall},
                      .placing = placing,
                      .first = first,
                      .parts = (int)(placing->geometry->count - first)};
    Boughs boughs = {0};
    snow.of_part = memory_alloc_zero(snow.parts, sizeof *snow.of_part, e);
    bool done = snow.of_part && boughs_init(&boughs, tree, e) && sort_sprays(&snow, &boughs, e) &&
                pile_up(&snow, e) && add_snow(snow_pile_mesh(&snow.pile, e), placing, role, e);
    *pillows = snow.pile.index_count > 0;
    boughs_free(&boughs);
    bough_snow_clear(&snow);
    return done;
}

// ---- branches ----

// Twigs among needles lie below pillows, and show no snow of their own.
static void hide_twigs(const CurveSet *curves, bool *bare)
{
    for (int64_t i = 0; i < curves->curve_count; i++) {
        bare[i] = bare[i] || curves->radius[curves->first[i]] < NEEDLED_RADIUS;
    }
}

static bool add_on_branches(const CurveSet *curves, const OutTree *tree, const SnowParams *params,
                            int32_t bare_from, bool pillows, const SnowFall *fall,
                            const Placing *placing, int role, Error *e)
{
    bool *bare = branches_bare(tree, curves, bare_from >= 0 ? bare_from : INT32_MAX, e);
    if (!bare) {
        return false;
    }
    if (pillows) {
        hide_twigs(curves, bare);
    }
    SnowReach reach = {share_of, fall};
    Mesh *mesh = snow_on_curves(curves, bare, params, &reach, placing->recipe->run, e);
    free(bare);
    return add_snow(mesh, placing, role, e);
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
    bool pillows = false;
    bool done = curves && fall_init(&fall, curves, first, placing->geometry, e) &&
                add_on_boughs(tree, params, &fall, first, placing, role, &pillows, e) &&
                add_on_branches(curves, tree, params, bare_from, pillows, &fall, placing, role, e);
    snow_fall_free(&fall);
    curves_free(curves);
    return done;
}
