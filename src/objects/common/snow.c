#include "objects/common/snow.h"

#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"
#include "mesh/ball.h"
#include "objects/common/snow_boughs.h"
#include "objects/common/snow_fall.h"
#include "objects/common/snow_spray.h"

#include <stdlib.h>

enum { STREAM_CRUMB_SHAPES = 21 }; // of an object

#define NEEDLED_RADIUS 0.006f // m: thinner branches of plants with sprays are hidden by them

// ---- how much snow comes through ----

static void add_instances(SnowFall *fall, const Spray *spray)
{
    float area = 0.5f * spray->length * spray->size.x;
    for (int64_t i = 0; i < spray->part->instance_count; i++) {
        snow_fall_add(fall, snow_spray_middle(spray, i), area);
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
        if (snow_spray_of(&geometry->part[i], &spray)) {
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

// ---- what it lies on ----

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

// A lump that is less round than a ball, of radius about 1.
static Mesh *crumb_mesh(uint64_t seed, Error *e)
{
    enum { RINGS = 4 };
    Mesh *mesh = ball_mesh(RINGS, e);
    for (int64_t i = 0; mesh && i < mesh->vertex_count; i++) {
        Vec3 p = mesh->position[i];
        float lump = noise_plane(1.7f * p.x + 0.8f * p.y, 1.7f * p.z - 0.8f * p.y, seed);
        mesh->position[i] = vec3_scale(p, 1.0f + 0.7f * lump);
    }
    if (mesh && !mesh_compute_normals(mesh, e)) {
        mesh_free(mesh);
        return NULL;
    }
    return mesh;
}

// Adds the crumbs as copies of a few lumps, and frees them.
static bool add_crumbs(SnowCrumbs *crumbs, const Placing *placing, int role, Error *e)
{
    enum { SHAPES = 3 };
    uint64_t seed = random_key(placing->recipe->seed, STREAM_CRUMB_SHAPES);
    bool done = true;
    for (int k = 0; done && k < SHAPES && crumbs->count >= SHAPES; k++) {
        int64_t most = crumbs->count / SHAPES + 1;
        Part part = {.instance = memory_alloc(most, sizeof *part.instance, e)};
        part.mesh = part.instance ? crumb_mesh(random_key(seed, (uint64_t)k), e) : NULL;
        for (int64_t i = k; part.mesh && i < crumbs->count; i += SHAPES) {
            uint64_t key = random_key(seed, (uint64_t)(SHAPES + i));
            float r = crumbs->crumb[i].radius, turn = random_range(key, 0.0f, 360.0f);
            Vec3 size = {r * random_range(key + 1, 0.8f, 1.7f), r * random_range(key + 2, 0.6f, 1),
                         r * random_range(key + 3, 0.8f, 1.3f)};
            part.instance[part.instance_count++] =
                transform_compose(crumbs->crumb[i].p, vec3(0, turn, 0), size);
        }
        done = placing_add(placing, part, role, e);
    }
    free(crumbs->crumb);
    *crumbs = (SnowCrumbs){0};
    return done;
}

// *pillows: whether there are any.
static bool add_on_boughs(const OutTree *tree, const SnowParams *params, const SnowReach *reach,
                          int64_t first, const Placing *placing, int role, bool *pillows, Error *e)
{
    SnowCrumbs crumbs = {0};
    Mesh *mesh = snow_on_boughs(tree, params, reach, first, placing, &crumbs, e);
    *pillows = mesh && mesh->face_count > 0;
    bool done = add_snow(mesh, placing, role, e);
    if (!done) {
        free(crumbs.crumb);
        return false;
    }
    return add_crumbs(&crumbs, placing, role, e);
}

// Twigs among needles lie below pillows, and show no snow of their own.
static void hide_twigs(const CurveSet *curves, bool *bare)
{
    for (int64_t i = 0; i < curves->curve_count; i++) {
        bare[i] = bare[i] || curves->radius[curves->first[i]] < NEEDLED_RADIUS;
    }
}

static bool add_on_branches(const CurveSet *curves, const OutTree *tree, const SnowParams *params,
                            int32_t bare_from, bool pillows, const SnowReach *reach,
                            const Placing *placing, int role, Error *e)
{
    bool *bare = branches_bare(tree, curves, bare_from >= 0 ? bare_from : INT32_MAX, e);
    if (!bare) {
        return false;
    }
    if (pillows) {
        hide_twigs(curves, bare);
    }
    Mesh *mesh = snow_on_curves(curves, bare, params, reach, placing->recipe->run, e);
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
    SnowReach reach = {share_of, &fall};
    bool pillows = false;
    bool done = curves && fall_init(&fall, curves, first, placing->geometry, e) &&
                add_on_boughs(tree, params, &reach, first, placing, role, &pillows, e) &&
                add_on_branches(curves, tree, params, bare_from, pillows, &reach, placing, role, e);
    snow_fall_free(&fall);
    curves_free(curves);
    return done;
}
