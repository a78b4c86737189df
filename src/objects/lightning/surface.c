// Discharges that crawl over an object: growth on its surface, jitter that stays on it.
#include "base/memory.h"
#include "base/random.h"
#include "objects/common/on_surface.h"
#include "objects/lightning/parts.h"

#include "base/exact_math.h"

#include <stdlib.h>

enum { STREAM_ROOT_ID = 1 }; // of a root

// The vertex farthest along d.
static Vec3 extreme_point(const Envelope *envelope, Vec3 d)
{
    const Mesh *mesh = envelope_surface(envelope);
    Vec3 best = mesh->position[0];
    for (int64_t i = 1; i < mesh->vertex_count; i++) {
        best = vec3_dot(mesh->position[i], d) > vec3_dot(best, d) ? mesh->position[i] : best;
    }
    return best;
}

static bool plant(OutTree *tree, const LightningParams *params, const OnSurface *skin,
                  uint64_t seed, Error *e)
{
    for (int i = 0; i < params->bolts; i++) {
        float sine, cosine, east, south;
        exact_sincos(params->lean * RADIANS_PER_DEGREE, &sine, &cosine);
        exact_sincos(params->lean_azimuth * RADIANS_PER_DEGREE, &east, &south);
        Vec3 d = vec3(sine * east, cosine, sine * south);
        uint64_t key = random_key(seed, (uint64_t)i);
        d = i == 0 ? d : random_direction(key);
        Vec3 p = extreme_point(skin->envelope, d), normal = d;
        surface_project(skin, &p, &normal);
        int64_t node = out_tree_add_node(tree, p, -1, 0, i, random_key(key, STREAM_ROOT_ID), e);
        if (node < 0) {
            return false;
        }
        tree->normal[node] = normal;
    }
    return true;
}

static bool grow_over(OutTree *tree, const LightningParams *params, const Envelope *envelope,
                      const Recipe *recipe, Error *e)
{
    GrowLevel levels[LIGHTNING_MOST_LEVELS];
    ElementParams element = params->element;
    if (element.level_count == 0) {
        element.levels = levels;
        element.level_count = lightning_own_levels(params, levels);
    }
    // Away from the starting point, without hairpins: discharges avoid their own charge.
    FieldParams away = field_params_default(FIELD_NUCLEI);
    away.surface = true;
    if (element.field_count == 0) {
        element.fields = &away;
        element.field_count = 1;
        element.growth.field_weight = 0.7f;
    }
    if (element.growth.max_angle == 0.0f) {
        element.growth.max_angle = 60.0f;
    }
    return element.level_count == 0 ||
           element_grow_in(tree, tree->count, &element, envelope,
                           random_key(recipe->seed, STREAM_SURFACE_GROWTH), recipe, NULL, e);
}

// Marks the node of each colony farthest from its root along the branches: the end of the main
// channel.
static bool mark_ends(OutTree *tree, int bolts, Error *e)
{
    float *distance = memory_alloc(tree->count, sizeof *distance, e);
    float *furthest = memory_alloc_zero(bolts, sizeof *furthest, e);
    int64_t *end = memory_alloc_zero(bolts, sizeof *end, e);
    bool done = distance && furthest && end;
    for (int64_t i = 0; done && i < tree->count; i++) {
        int32_t parent = tree->parent[i], colony = tree->colony[i];
        float step = parent < 0 ? 0.0f : vec3_distance(tree->position[i], tree->position[parent]);
        distance[i] = parent < 0 ? 0.0f : distance[parent] + step;
        if (parent < 0 || distance[i] > furthest[colony]) {
            furthest[colony] = distance[i];
            end[colony] = i;
        }
    }
    for (int i = 0; done && i < bolts && tree->count > 0; i++) {
        tree->radius[end[i]] = LIGHTNING_STRIKE;
    }
    free(end);
    free(distance);
    free(furthest);
    return done;
}

static void free_envelope(void *envelope)
{
    envelope_free(envelope);
}

bool lightning_grow_surface(const LightningParams *params, const Recipe *recipe, Grown *whole,
                            Error *e)
{
    Envelope *envelope = element_envelope(&params->element, recipe->run, e);
    *whole = (Grown){envelope ? out_tree_new(e) : NULL, envelope, free_envelope};
    if (!whole->tree) {
        return false;
    }
    OnSurface skin = on_surface(envelope);
    return plant(whole->tree, params, &skin, random_key(recipe->seed, STREAM_SURFACE_ROOTS), e) &&
           grow_over(whole->tree, params, envelope, recipe, e);
}

bool lightning_finish_surface(const LightningParams *params, const Recipe *recipe,
                              const Envelope *envelope, Grown *grown, Error *e)
{
    OnSurface skin = on_surface(envelope);
    float size = skin.extent;
    float core = params->radius > 0.0f ? params->radius : size / 700.0f;
    Wander wander = {.project = surface_project,
                     .surface = &skin,
                     .stride = skin.stride,
                     .seed = random_key(recipe->seed, STREAM_WANDER),
                     .run = recipe->run};
    if (!mark_ends(grown->tree, params->bolts, e)) {
        return false;
    }
    OutTree *tree = grown->tree = lightning_wander(grown->tree, params, size, core, &wander, e);
    if (!tree || !surface_drop_strays(&skin, tree, 0.05f * size, e)) {
        return false;
    }
    float lift = params->lift > 0.0f ? params->lift : 2.0f * core;
    for (int64_t i = 0; i < tree->count; i++) {
        tree->position[i] = vec3_madd(tree->position[i], lift, tree->normal[i]);
    }
    return true;
}
