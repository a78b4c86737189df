// A tree as a kind of object.
#include "objects/kind.h"
#include "base/memory.h"
#include "objects/common/swept.h"
#include "objects/tree/defaults.h"
#include "objects/tree/tree.h"
#include "objects/tree/veteran.h"
#include "outtree/measure_wood.h"
#include "render/material/material.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Origin at the trunk's base, not rotated.
static bool own_space(OwnSpace *own, void *params, Error *e)
{
    TreeParams *tree = params;
    own_space_stand(own, tree->position, vec3(0, 0, 0));
    tree->position = vec3(0, 0, 0);
    return own_space_take_element(own, &tree->trunk.element, e) &&
           own_space_take_element(own, &tree->crown.element, e) &&
           own_space_take_element(own, &tree->light.attractors.element, e) &&
           own_space_take_element(own, &tree->roots.element, e);
}

static uint64_t own_seed(const void *params)
{
    const TreeParams *tree = params;
    return tree->seed;
}

static void describe(const void *params, char *text, size_t size)
{
    TreePlan plan;
    tree_plan_make(&plan, params, 0); // the seed does not affect the height
    snprintf(text, size, ", %g m", (double)plan.params.height);
}

static void settle(const void *params, void *settled)
{
    TreePlan plan;
    tree_plan_make(&plan, params, 0); // the seed does not affect numbers of the file's keys
    memcpy(settled, &plan.params, sizeof plan.params);
}

typedef struct TreeAttractors {
    int64_t trunk, crown, roots, reached;
} TreeAttractors;

// Includes the default levels.
static TreeAttractors count_attractors(const void *params)
{
    TreePlan plan;
    tree_plan_make(&plan, params, 0); // the seed does not affect their number
    const TreeParams *p = &plan.params;
    bool none = plan.grown_by == GROWN_BY_LIGHT;
    return (TreeAttractors){none ? 0 : element_attractors(&p->trunk.element),
                            none ? 0 : element_attractors(&p->crown.element),
                            p->roots.count > 0 ? element_attractors(&p->roots.element) : 0,
                            plan.grown_by == GROWN_BY_ATTRACTORS ? 0 : p->light.attractors.count};
}

// Metamers of a tree that grows by light: a measured average.
static double count_metamers(const void *params)
{
    enum { A_SQUARED_SEASON = 40 };
    const TreeParams *tree = params;
    TreePlan plan;
    tree_plan_make(&plan, params, 0);
    double seasons = plan.grown_by == GROWN_BY_ATTRACTORS ? 0.0 : (double)plan.seasons;
    Vec2 control = tree->light.growth.apical_control;
    bool forks = control.x < 1.0f || control.y < 1.0f; // a palm's axis gets all growth
    return A_SQUARED_SEASON * seasons * (forks ? seasons : 1.0);
}

static int64_t attractors(const void *params)
{
    TreeAttractors count = count_attractors(params);
    return count.trunk + count.crown + count.roots + count.reached;
}

static int64_t copies(const void *params)
{
    const TreeParams *tree = params;
    int64_t count = tree->leaves.max_count;
    for (int i = 0; i < tree->organ_count; i++) {
        count += tree->organs[i].max_count;
    }
    return count;
}

static SweptAxis trunk_axis(const void *context, const OutTree *tree, int64_t base)
{
    (void)tree, (void)base;
    const TreeParams *params = context;
    return (SweptAxis){params->position, vec3(0, 1, 0)};
}

// How far the stems of the trunk and the leaders of the crown wind about the vertical axis.
static bool measure_swept(const TreeParams *params, const OutTree *tree, MeasureList *list,
                          Error *e)
{
    bool *is_in = memory_alloc(tree->count, sizeof *is_in, e);
    bool done = is_in;
    for (int32_t colony = TREE_TRUNK; done && colony <= TREE_CROWN; colony++) {
        for (int64_t i = 0; i < tree->count; i++) {
            is_in[i] = tree->colony[i] == colony;
        }
        done = swept_measure(tree, is_in, trunk_axis, params,
                             colony == TREE_TRUNK ? "trunk_swept" : "crown_swept", list, e);
    }
    free(is_in);
    return done;
}

static bool measure_height(const TreeParams *params, const OutTree *tree, MeasureList *list,
                           Error *e)
{
    float top = params->position.y;
    for (int64_t i = 0; i < tree->count; i++) {
        top = fmaxf(top, tree->position[i].y);
    }
    return measures_add(list, "height_above_ground", (double)(top - params->position.y), "m",
                        (double)NAN, (double)NAN, e);
}

// Measures of the wood above the ground: the roots are left out.
static bool measure_wood(const TreeParams *params, const OutTree *tree, MeasureList *list, Error *e)
{
    OutTree *above = out_tree_copy(tree, e);
    bool *keep = above ? memory_alloc(tree->count, sizeof *keep, e) : NULL;
    for (int64_t i = 0; keep && i < tree->count; i++) {
        keep[i] = tree->colony[i] != TREE_ROOTS && tree->colony[i] != TREE_KNOTS;
    }
    bool done = keep && out_tree_keep_nodes(above, keep, e) &&
                out_tree_measure_wood(above, params->position.y, list, e);
    free(keep);
    out_tree_free(above);
    return done;
}

static bool measure_veteran(const TreeParams *given, const OutTree *tree, uint64_t seed,
                            MeasureList *list, Error *e)
{
    TreePlan plan;
    tree_plan_make(&plan, given, seed);
    int64_t knots = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        knots += tree->colony[i] == TREE_KNOTS;
    }
    return measures_add(list, "dead_share", tree_dead_share(tree), "", (double)NAN, (double)NAN,
                        e) &&
           measures_add(list, "mistletoe", tree_mistletoe(tree, &plan.params, seed, NULL), "",
                        (double)NAN, (double)NAN, e) &&
           measures_add(list, "knots", (double)knots, "", (double)NAN, (double)NAN, e);
}

// Natural ranges: radii after Eloy (2011); the others are typical of broad-leaved trees.
static bool measure(const void *given, const Grown *grown, const Recipe *recipe, MeasureList *list,
                    Error *e)
{
    measures_set_range(list, "radius_exponent", 1.8, 2.3);
    measures_set_range(list, "branch_angle", 30.0, 70.0);
    measures_set_range(list, "horton_number", 3.0, 5.0);
    measures_set_range(list, "tip_radius", 0.0005, 0.002);
    return measure_height(given, grown->tree, list, e) &&
           measure_wood(given, grown->tree, list, e) &&
           measure_swept(given, grown->tree, list, e) &&
           measure_veteran(given, grown->tree, recipe ? recipe->seed : 0, list, e);
}

static void needs(const void *params, Needs *needs)
{
    const TreeParams *tree = params;
    enum { LEAF_FACES = 25, LEAVES_AN_ATTRACTOR = 6, SNOW_BYTES = 9500 };
    TreeAttractors each = count_attractors(params);
    double count = (double)attractors(params), leaves = (double)tree->leaves.max_count;
    int levels = tree->skin.levels;
    double twig = (double)(tree->skin.curve_radius / tree->radii.tip);
    needs_add_skinned_growth(needs, "trunk.growth.levels", (double)each.trunk, levels, twig);
    needs_add_skinned_growth(needs, "crown.growth.levels", (double)each.crown, levels, twig);
    needs_add_skinned_growth(needs, "roots.growth.levels", (double)each.roots, levels, twig);
    double metamers = count_metamers(params);
    needs_add_skinned_growth(needs, "light.seasons", metamers, levels, twig);
    needs_add_copies(needs, "leaves.max_count",
                     fmin(leaves, LEAVES_AN_ATTRACTOR * (count + metamers)), LEAF_FACES);
    if (tree->snow.depth > 0.0f) {
        needs_add(needs, "snow.depth", count + metamers, SNOW_BYTES);
    }
    if (tree->hoar.length > 0.0f) { // as many as fit on a metamer of 3 cm
        double tufts = fmin((double)tree->hoar.max_count,
                            (count + metamers) * 0.06 / (double)tree->hoar.length);
        needs_add(needs, "hoar.max_count", tufts, HOAR_TUFT_BYTES);
    }
}

// Snow: nearly white, with grains. Petals: white with a touch of pink, thin. Fruit: a ripe apple.
// Cones: dry wood. Dead wood: weathered to grey.
static const Material BUILTIN[] = {
    {.name = "snow",
     .kind = MATERIAL_DIFFUSE,
     .color = {0.90f, 0.925f, 0.95f},
     .color2 = {0.84f, 0.88f, 0.93f},
     .roughness = 0.5f,
     .ior = 1.31f,
     .pattern = PATTERN_NOISE,
     .pattern_scale = 0.03f,
     .pattern_depth = 0.003f},
    {.name = "blossom",
     .kind = MATERIAL_LEAF,
     .color = {0.62f, 0.50f, 0.53f},
     .color2 = {0.62f, 0.36f, 0.42f},
     .transmittance = {0.28f, 0.21f, 0.23f},
     .autumn_color = {0.45f, 0.36f, 0.30f},
     .roughness = 0.7f,
     .specular = 0.15f,
     .ior = 1.5f,
     .variation = 0.2f},
    {.name = "fruit",
     .kind = MATERIAL_PRINCIPLED,
     .color = {0.38f, 0.045f, 0.022f},
     .color2 = {0.42f, 0.26f, 0.05f},
     .roughness = 0.35f,
     .specular = 0.5f,
     .ior = 1.5f,
     .pattern = PATTERN_NOISE,
     .pattern_scale = 0.06f,
     .variation = 0.35f},
    {.name = "cone",
     .kind = MATERIAL_PRINCIPLED,
     .color = {0.165f, 0.095f, 0.050f},
     .color2 = {0.085f, 0.048f, 0.026f},
     .roughness = 0.75f,
     .specular = 0.3f,
     .ior = 1.5f,
     .pattern = PATTERN_NOISE,
     .pattern_scale = 0.012f,
     .variation = 0.3f},
    {.name = "stalk",
     .kind = MATERIAL_PRINCIPLED,
     .color = {0.150f, 0.185f, 0.055f},
     .color2 = {0.150f, 0.105f, 0.055f},
     .roughness = 0.6f,
     .specular = 0.4f,
     .ior = 1.5f,
     .variation = 0.25f},
    {.name = "tree/anther",
     .kind = MATERIAL_PRINCIPLED,
     .color = {0.62f, 0.43f, 0.075f},
     .color2 = {0.42f, 0.26f, 0.06f},
     .roughness = 0.85f,
     .specular = 0.2f,
     .ior = 1.5f,
     .variation = 0.4f},
    {.name = "deadwood",
     .kind = MATERIAL_PRINCIPLED,
     .color = {0.300f, 0.275f, 0.245f},
     .color2 = {0.120f, 0.100f, 0.082f},
     .roughness = 0.85f,
     .specular = 0.2f,
     .ior = 1.5f,
     .pattern = PATTERN_BARK,
     .bark = BARK_FIBROUS,
     .pattern_scale = 0.03f,
     .pattern_depth = 0.003f},
    {.name = "mistletoe",
     .kind = MATERIAL_LEAF,
     .color = {0.150f, 0.185f, 0.050f},
     .color2 = {0.185f, 0.200f, 0.070f},
     .transmittance = {0.050f, 0.075f, 0.010f},
     .roughness = 0.6f,
     .specular = 0.2f,
     .ior = 1.5f,
     .variation = 0.25f},
    {.name = "moss",
     .kind = MATERIAL_LEAF,
     .color = {0.055f, 0.085f, 0.018f},
     .color2 = {0.095f, 0.110f, 0.028f},
     .transmittance = {0.035f, 0.055f, 0.006f},
     .roughness = 0.8f,
     .specular = 0.1f,
     .ior = 1.5f,
     .variation = 0.4f},
    {.name = ""},
};

static const Key MATERIALS[] = {
    OWN_MATERIAL_ROW(0),
    TWIG_MATERIAL_ROW(1),
    LEAF_MATERIAL_ROW(2),
    ORGAN_MATERIAL_ROWS(TREE_BLOSSOM, TREE_FRUIT, TREE_CONE, TREE_STALK),
    SNOW_MATERIAL_ROW(TREE_SNOW),
    VETERAN_MATERIAL_ROWS(TREE_DEADWOOD, TREE_MISTLETOE, TREE_MOSS),
    RIME_MATERIAL_ROW(TREE_RIME),
    ANTHER_MATERIAL_ROW(TREE_ANTHER),
    {0},
};

const Kind kind_tree = {
    .variant = {KIND_ROW("tree", &tree_table, "A tree; the defaults make an oak."), MATERIALS},
    .carried = true,
    .materials = {"bark", "twig", "leaf", "blossom", "fruit", "cone", "stalk", "snow", "deadwood",
                  "mistletoe", "moss", "rime", "tree/anther"},
    .builtin = BUILTIN,
    .own_space = own_space,
    .seed = own_seed,
    .keeps_clear = true,
    .contends = true,
    .needs = needs,
    .measure = measure,
    .describe = describe,
    .settle = settle,
    .attractors = attractors,
    .copies = copies,
    .grow = tree_grow,
    .tip_radius = tree_tip_radius,
    .finish = tree_finish,
    .geometry = tree_geometry};
