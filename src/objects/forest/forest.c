#include "objects/forest/forest.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "objects/forest/individuals.h"
#include "objects/forest/stand_places.h"
#include "outtree/radii.h"

#include <math.h>
#include <stdlib.h>

// Of a stand; stand i has stream i of the object's seed.
enum { STREAM_TRUNKS = 1, STREAM_CROWNS = 2 };
// Of a tree; BENDS + i: piece i. The foot's streams are the height's and the lean's.
enum {
    STREAM_FOOT_X = 1,
    STREAM_FOOT_Z = 2,
    STREAM_HEIGHT = 1,
    STREAM_LEAN = 2,
    STREAM_ROOT_ID = 3,
    STREAM_BENDS = 10
};

#define GOLDEN_ANGLE 2.39996323f
#define STAND_GAP 1.5f // from stand to stand in the out-tree, in diameters

enum { TRUNK_PIECES = 24, CROWN_LEVELS = 3 };

ForestParams forest_params_default(void)
{
    TreeParams tree = tree_params_default();
    ForestParams forest = {.height = 22.0f,
                           .stand_trees = 7,
                           .stands = 3,
                           .crown = 0.55f,
                           .radius = 150.0f,
                           .glade = 4.0f,
                           .density = 1.0f,
                           .max_slope = 40.0f,
                           .fern_height = 0.7f,
                           .fern_radius = 40.0f,
                           .element = {.points.gradient = 0.25f,
                                       .growth = {.max_children = 3,
                                                  .noise = 0.28f,
                                                  .tropism = {0, 1, 0},
                                                  .field_weight = 1.0f}},
                           .radii = tree.radii,
                           .leaves = tree.leaves,
                           .skin = tree.skin};
    forest.radii.tip = 0.007f;
    forest.radii.flare = 0.7f;
    forest.leaves.max_count = 60000;
    forest.leaves.spacing = 0.045f;
    forest.leaves.twig_radius = 0.02f;
    forest.leaves.length = 0.2f;
    forest.leaves.width = 0.125f;
    forest.leaves.lobes = 0;
    forest.leaves.variants = 2;
    forest.skin.levels = 1;
    forest.skin.curve_radius = 0.018f;
    return forest;
}

ForestParams forest_params_resolve(const ForestParams *params)
{
    ForestParams resolved = *params;
    if (resolved.spacing == 0.0f) {
        resolved.spacing = 0.24f * params->height;
    }
    return resolved;
}

// Distance from trunk to trunk, m.
static float forest_spacing(const ForestParams *params)
{
    return forest_params_resolve(params).spacing;
}

float forest_stand_radius(const ForestParams *params)
{
    return forest_spacing(params) * sqrtf((float)params->stand_trees / PI_F);
}

// Centre of stand number `stand` during growth.
static Vec3 stand_center(const ForestParams *params, int stand)
{
    return vec3(2.0f * STAND_GAP * forest_stand_radius(params) * (float)stand, 0, 0);
}

// Plants one slightly bent trunk up to the start of the branches; its nodes are type-0 points.
static bool plant_trunk(OutTree *tree, const ForestParams *params, Vec3 foot, int colony,
                        uint64_t seed, Error *e)
{
    float top = params->height * (1.0f - 0.8f * params->crown) *
                random_range(random_key(seed, STREAM_HEIGHT), 0.85f, 1.05f);
    float sunk = 0.014f * params->height; // so that no foot hangs over a slope
    float length = (top + sunk) / TRUNK_PIECES;
    Vec3 lean = vec3_scale(random_direction(random_key(seed, STREAM_LEAN)), 0.04f);
    Vec3 p = vec3_add(foot, vec3(0, -sunk, 0));
    uint64_t id = random_key(seed, STREAM_ROOT_ID);
    int64_t parent = -1;
    for (int i = 0; i <= TRUNK_PIECES; i++) {
        parent = out_tree_add_node(tree, p, parent, i, colony, id, e);
        if (parent < 0) {
            return false;
        }
        id = out_tree_child_id(id, 0);
        lean =
            vec3_madd(lean, 0.018f, random_direction(random_key(seed, STREAM_BENDS + (uint64_t)i)));
        lean = vec3_scale(lean, 0.93f);
        p = vec3_madd(p, length, vec3_normalize(vec3_add(vec3(0, 1, 0), lean)));
    }
    return true;
}

static bool plant_stand(OutTree *tree, const ForestParams *params, int stand, uint64_t seed,
                        Error *e)
{
    Vec3 center = stand_center(params, stand);
    float radius = forest_stand_radius(params), spacing = forest_spacing(params);
    bool done = true;
    for (int i = 0; done && i < params->stand_trees; i++) {
        uint64_t key = random_key(seed, (uint64_t)i);
        float out = radius * sqrtf(((float)i + 0.5f) / (float)params->stand_trees), sine, cosine;
        exact_sincos((float)i * GOLDEN_ANGLE, &sine, &cosine);
        Vec3 foot = vec3_add(center, vec3(out * sine, 0, out * cosine));
        foot.x += random_range(random_key(key, STREAM_FOOT_X), -0.2f, 0.2f) * spacing;
        foot.z += random_range(random_key(key, STREAM_FOOT_Z), -0.2f, 0.2f) * spacing;
        done = plant_trunk(tree, params, foot, stand * params->stand_trees + i, key, e);
    }
    return done;
}

// The crown envelope shared by all trees of a stand: a drum from the lowest branches to the tops.
static Shape canopy(const ForestParams *params, int stand)
{
    Vec3 base = stand_center(params, stand);
    float depth = params->crown * params->height, radius = forest_stand_radius(params);
    base.y = params->height - depth;
    return (Shape){.kind = SHAPE_CONE,
                   .size = vec3(radius, depth, 0.94f * radius),
                   .transform = transform_compose(base, vec3_splat(0), vec3_splat(1))};
}

// The stand's guide fields: without a centre, at the centre of the stand. Copies; the caller frees
// them.
static FieldParams *stand_fields(const ForestParams *params, int stand, Error *e)
{
    int count = params->element.field_count;
    FieldParams *fields = memory_alloc(count, sizeof *fields, e);
    for (int i = 0; fields && i < count; i++) {
        fields[i] = params->element.fields[i];
        if (!fields[i].centered) {
            fields[i].center = stand_center(params, stand);
        }
    }
    return fields;
}

static bool grow_stand(OutTree *all, const ForestParams *params, int stand, uint64_t seed,
                       const Recipe *recipe, Error *e)
{
    int64_t trees = params->stand_trees;
    ElementParams element = params->element;
    float noise = element.growth.noise;
    GrowLevel levels[CROWN_LEVELS] = {
        {10 * trees, 0.12f, 0.45f, 4.0f, 0.88f, noise, 0.35f, 0.5f},
        {110 * trees, 0.22f, 0.75f, 2.5f, 0.96f, noise, 0.15f, 0.5f},
        {2200 * trees, 0.38f, 0.95f, 2.1f, 1.00f, noise, 0.05f, 0.5f},
    };
    Shape shape = canopy(params, stand);
    if (element.level_count == 0) {
        element.levels = levels;
        element.level_count = CROWN_LEVELS;
    }
    if (element.shape_count == 0) {
        element.shapes = &shape;
        element.shape_count = 1;
    }
    element.fields = stand_fields(params, stand, e);
    OutTree *tree = out_tree_new(e);
    bool done = tree && element.fields &&
                plant_stand(tree, params, stand, random_key(seed, STREAM_TRUNKS), e) &&
                element_grow(tree, &element, random_key(seed, STREAM_CROWNS), recipe, NULL, e);
    if (done) {
        float trunk = 0.0105f * params->height;
        out_tree_pipe_radii(tree, params->radii.exponent, params->radii.tip, trunk);
        out_tree_root_flare(tree, params->radii.flare, 0.0f, 3.0f * trunk);
        done = out_tree_append(all, tree, e);
    }
    out_tree_free(tree);
    free(element.fields);
    return done;
}

static bool grow_species(const ForestParams *params, const Recipe *recipe, OutTree *into, Error *e)
{
    Individuals all;
    bool done =
        individuals_init(&all, params, recipe->seed, e) && individuals_grow(&all, recipe, into, e);
    individuals_free(&all);
    return done;
}

bool forest_grow(const void *given, const Recipe *recipe, Grown *whole, Error *e)
{
    const ForestParams *params = given;
    whole->tree = out_tree_new(e);
    bool done = whole->tree;
    if (done && params->species_count > 0) {
        return grow_species(params, recipe, whole->tree, e);
    }
    for (int i = 0; done && i < params->stands; i++) {
        done = grow_stand(whole->tree, params, i, random_key(recipe->seed, (uint64_t)i), recipe, e);
    }
    return done;
}

float forest_tip_radius(const void *given, const OutTree *whole)
{
    (void)whole;
    const ForestParams *params = given;
    return params->radii.tip;
}

// The nodes of one stand, moved to the origin.
OutTree *forest_stand(const OutTree *all, const ForestParams *params, int stand, Error *e)
{
    OutTree *tree = out_tree_copy(all, e);
    bool *keep = memory_alloc(all->count, sizeof *keep, e);
    bool done = tree && keep;
    for (int64_t i = 0; done && i < all->count; i++) {
        keep[i] = all->colony[i] / params->stand_trees == stand;
        tree->position[i] = vec3_sub(tree->position[i], stand_center(params, stand));
    }
    done = done && out_tree_keep_nodes(tree, keep, e);
    free(keep);
    if (!done) {
        out_tree_free(tree);
        return NULL;
    }
    return tree;
}

static int compare_doubles(const void *a, const void *b)
{
    double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

// Distance to the nearest node of another tree of the same stand.
static double nearest_other(const OutTree *tree, int64_t node, int stand_trees)
{
    float best = INFINITY;
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->colony[i] != tree->colony[node] &&
            tree->colony[i] / stand_trees == tree->colony[node] / stand_trees) {
            best = fminf(best, vec3_distance(tree->position[i], tree->position[node]));
        }
    }
    return (double)best;
}

bool forest_crown_gap(const OutTree *tree, const ForestParams *params, double *gap, Error *e)
{
    enum { MOST_SAMPLES = 400 };
    int64_t every = tree->count / MOST_SAMPLES + 1, count = 0;
    double *distance = memory_alloc(tree->count / every + 1, sizeof *distance, e);
    if (!distance) {
        return false;
    }
    double near = 0.5 * (double)forest_spacing(params);
    for (int64_t i = 0; i < tree->count; i += every) {
        double d = nearest_other(tree, i, params->stand_trees);
        if (d < near) {
            distance[count++] = d;
        }
    }
    qsort(distance, (size_t)count, sizeof *distance, compare_doubles);
    *gap = count > 0 ? distance[count / 2] : (double)NAN;
    free(distance);
    return true;
}
