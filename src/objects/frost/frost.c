// Growth of frost: spines along the turned field, then sides at their angle.
#include "objects/frost/frost.h"

#include "base/memory.h"
#include "base/random.h"
#include "grow/colonize.h"
#include "objects/frost/ferns.h"
#include "objects/frost/surface.h"
#include "outtree/chains.h"
#include "outtree/crossings.h"
#include "outtree/radii.h"

#include <stdlib.h>

// Distance between nodes, in spacings of the sides' attractors.
static const float SIDE_STEP = 0.55f;

// Length without sides, in spacings between spines, beyond which a blade is cut.
static const float MOST_BARE = 1.5f;

FrostParams frost_params_default(FrostSurface surface)
{
    return frost_habit_default(surface, FROST_SPINES);
}

FrostParams frost_habit_default(FrostSurface surface, FrostHabit habit)
{
    bool pane = surface == FROST_PANE;
    FrostParams params = {.surface = surface,
                          .width = 0.6f,
                          .height = 0.45f,
                          .radius = 0.03f,
                          .nuclei = pane ? 13 : 1,
                          .turn = pane ? 110.0f : 120.0f,
                          .field_weight = pane ? 1.0f : 1.5f,
                          .spines = pane ? 420 : 700,
                          .sides = pane ? 150000 : 100000,
                          .angle = 60.0f,
                          .skip = 0.33f,
                          .orders = 3,
                          .width_share = 0.22f,
                          .relief = 0.5f,
                          .rime = 0.4f,
                          .grains = pane ? 30000 : 6000};
    if (habit == FROST_FERNS) {
        params.habit = FROST_FERNS;
        params.spines = pane ? 300 : 200;
        params.sides = pane ? 700000 : 300000;
        params.field_weight = 4.0f;
        params.angle = 50.0f;
        params.curl = 30.0f;
        params.skip = 0.03f;
        params.orders = 2;
        params.width_share = 0.32f;
        params.clear = 0.1f;
        params.scratches = pane ? 3 : 0;
    }
    return params;
}

static bool add_nuclei(OutTree *tree, const FrostParams *params, uint64_t seed, Error *e)
{
    for (int i = 0; i < frost_nucleus_total(params); i++) {
        Vec3 normal, p = frost_nucleus(params, i, seed, &normal);
        int64_t root = out_tree_add_node(tree, p, -1, 0, i, random_key(seed, (uint64_t)i), e);
        if (root < 0) {
            return false;
        }
        tree->normal[root] = normal;
    }
    return true;
}

static GuideField *make_field(const OutTree *tree, const FrostParams *params,
                              const PointSet *points, const Run *run, Error *e)
{
    FieldParams field = field_params_default(FIELD_NUCLEI);
    FieldSite site = {tree->position, tree->normal, tree->count, aabb_empty(), NULL};
    for (int64_t i = 0; i < points->count; i++) {
        site.bounds = aabb_add(site.bounds, points->position[i]);
    }
    field.turn = params->turn;
    field.profile = params->profile;
    field.pull = field_params_pull(&field, params->field_weight);
    field.surface = true;
    field.spherical = params->surface == FROST_BUBBLE;
    field.center = params->position;
    return guide_field_new(&field, 1, &site, run, e);
}

// Grows the spines by plain space colonization, steered by the turned field (Tanaka eq. (9)-(13)).
static bool grow_spines(OutTree *tree, const FrostParams *params, const Recipe *recipe, Error *e)
{
    PointSet *points =
        frost_points(params, params->spines, random_key(recipe->seed, STREAM_FROST_SPINE_POINTS),
                     recipe->run, e);
    GuideField *field = points ? make_field(tree, params, points, recipe->run, e) : NULL;
    bool done = field != NULL;
    if (done) {
        ColonizeParams growth = colonize_params_default();
        colonize_auto(&growth, points_spacing(points), 0.3f, 1.2f, 4.0f);
        growth.on_surface = true;
        growth.max_children = 2;
        growth.noise = 0.06f;
        growth.field = field;
        growth.field_weight = params->field_weight;
        growth.room = recipe->room;
        growth.seed = random_key(recipe->seed, STREAM_FROST_SPINES);
        done = colonize(tree, points, &growth, recipe->run, NULL, e);
    }
    guide_field_free(field);
    points_free(points);
    return done;
}

// Smooths the spines: nodes between forks move to the middle of their neighbours.
static void smooth_spines(OutTree *tree, const int32_t *only_child)
{
    for (int pass = 0; pass < 4; pass++) {
        for (int64_t i = 0; i < tree->count; i++) {
            if (tree->parent[i] >= 0 && only_child[i] >= 0) {
                Vec3 ends =
                    vec3_lerp(tree->position[tree->parent[i]], tree->position[only_child[i]], 0.5f);
                tree->position[i] = vec3_lerp(tree->position[i], ends, 0.5f);
            }
        }
    }
}

static bool smooth(OutTree *tree, Error *e)
{
    int32_t *only_child = memory_alloc(tree->count, sizeof *only_child, e); // -1 none, -2 several
    if (!only_child) {
        return false;
    }
    for (int64_t i = 0; i < tree->count; i++) {
        only_child[i] = -1;
        if (tree->parent[i] >= 0) {
            int32_t *of_parent = &only_child[tree->parent[i]];
            *of_parent = *of_parent == -1 ? (int32_t)i : -2;
        }
    }
    smooth_spines(tree, only_child);
    free(only_child);
    return true;
}

// Resamples the spines to the closest spacing of sides, on the surface. Takes the tree.
static OutTree *refine_spines(OutTree *tree, const FrostParams *params, Error *e)
{
    OutTree *fine =
        smooth(tree, e) ? out_tree_resample(tree, SIDE_STEP * frost_side_spacing(params), e) : NULL;
    out_tree_free(tree);
    for (int64_t i = 0; fine && i < fine->count; i++) {
        fine->normal[i] = frost_project(params, &fine->position[i]);
    }
    return fine;
}

// Grows the sides along their sector's axis, not along the mean direction of attractors, which
// would make them look like hair.
static bool grow_sides(OutTree *tree, const FrostParams *params, const Recipe *recipe, Error *e)
{
    PointSet *points = frost_points(
        params, params->sides, random_key(recipe->seed, STREAM_FROST_SIDE_POINTS), recipe->run, e);
    if (!points) {
        return false;
    }
    ColonizeParams growth = colonize_params_default();
    colonize_auto(&growth, points_spacing(points), SIDE_STEP, 0.9f, 5.0f);
    growth.rule = GROW_SECTORS;
    growth.sector_angle = params->angle;
    growth.sector_axis = true;
    growth.max_angle = 1.02f * params->angle; // forward and to both sides
    growth.on_surface = true;
    growth.max_order = params->orders;
    growth.new_orders = true;
    growth.apical = params->skip;
    growth.noise = 0.02f;
    growth.room = recipe->room;
    growth.seed = random_key(recipe->seed, STREAM_FROST_SIDES);
    bool done = colonize(tree, points, &growth, recipe->run, NULL, e);
    points_free(points);
    for (int64_t i = 0; done && i < tree->count; i++) { // steps are chords
        tree->normal[i] = frost_project(params, &tree->position[i]);
    }
    return done;
}

// Sets births from the distance along the path: spines grow ahead, sides follow at half their
// speed.
static void give_births(OutTree *tree, int64_t spine_count)
{
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        tree->birth[i] = parent < 0 ? 0 : tree->birth[parent] + (i < spine_count ? 1 : 2);
    }
}

// since[i]: number of nodes up to and including i since the last fork, on a path without further
// forks; 0 if forks follow.
static void count_bare(const OutTree *tree, int32_t *since, uint8_t *children)
{
    for (int64_t i = tree->count - 1; i >= 0; i--) { // 2 = several, or a later fork
        int32_t parent = tree->parent[i];
        if (parent >= 0) {
            children[parent] = children[parent] > 0 || children[i] > 1 ? 2 : 1;
        }
    }
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        since[i] = children[i] > 1 ? 0 : (parent >= 0 ? since[parent] : 0) + 1;
    }
}

// Cuts every path soon after its last side, to remove rods that grew into empty space.
static bool trim_rods(OutTree *tree, const FrostParams *params, Error *e)
{
    float spine_spacing = sqrtf(frost_area(params) / (float)params->spines);
    float most = MOST_BARE * spine_spacing / (SIDE_STEP * frost_side_spacing(params));
    int32_t *since = memory_alloc(tree->count, sizeof *since, e);
    uint8_t *children = memory_alloc_zero(tree->count, sizeof *children, e);
    bool *keep = memory_alloc(tree->count, sizeof *keep, e);
    bool done = since && children && keep;
    if (done) {
        count_bare(tree, since, children);
        for (int64_t i = 0; i < tree->count; i++) {
            keep[i] = (float)since[i] <= most;
        }
        done = out_tree_keep_nodes(tree, keep, e);
    }
    free(since);
    free(children);
    free(keep);
    return done;
}

bool frost_grow(const void *given, const Recipe *recipe, Grown *whole, Error *e)
{
    const FrostParams *params = given;
    if (params->habit == FROST_FERNS) {
        return ferns_grow(params, recipe, whole, e);
    }
    OutTree *tree = out_tree_new(e);
    if (!tree || !add_nuclei(tree, params, random_key(recipe->seed, STREAM_FROST_NUCLEI), e) ||
        !grow_spines(tree, params, recipe, e)) {
        out_tree_free(tree);
        return false;
    }
    tree = whole->tree = refine_spines(tree, params, e);
    if (!tree) {
        return false;
    }
    int64_t spine_count = tree->count;
    if (params->sides > 0 && !grow_sides(tree, params, recipe, e)) {
        return false;
    }
    give_births(tree, spine_count);
    return out_tree_drop_crossings(tree, recipe->run, e) &&
           (params->sides == 0 || trim_rods(tree, params, e));
}

bool frost_finish(const void *given, const Recipe *recipe, const Grown *whole, Grown *grown,
                  Error *e)
{
    (void)recipe, (void)whole, (void)e;
    const FrostParams *params = given;
    out_tree_pipe_radii(grown->tree, 6.0f, params->width_share * frost_side_spacing(params), 0.0f);
    return true;
}
