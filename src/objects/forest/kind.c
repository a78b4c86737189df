// A forest as a kind of object.
#include "objects/kind.h"
#include "objects/forest/forest.h"
#include "objects/forest/stand_places.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static bool measure(const void *params, const Grown *grown, const Recipe *recipe, MeasureList *list,
                    Error *e)
{
    (void)recipe;
    double gap;
    measures_set_range(list, "radius_exponent", 1.8, 2.3);
    measures_set_range(list, "branch_angle", 30.0, 70.0);
    measures_set_range(list, "horton_number", 3.0, 5.0);
    return forest_crown_gap(grown->tree, params, &gap, e) &&
           measures_add(list, "crown_gap", gap, "m", (double)NAN, (double)NAN, e);
}

static void describe(const void *params, char *text, size_t size)
{
    const ForestParams *forest = params;
    snprintf(text, size, ", %g m, %d stands of %d trees", (double)forest->height, forest->stands,
             forest->stand_trees);
}

static int64_t copies(const void *params)
{
    const ForestParams *forest = params;
    return forest->ferns + forest->leaves.max_count * forest->stands;
}

static void needs(const void *params, Needs *needs)
{
    enum { OWN_ATTRACTORS = 2320, LEAVES_AN_ATTRACTOR = 6, LEAF_BYTES = 2500, PARTS = 4 };
    const ForestParams *forest = params;
    double pitch = 1.86 * (double)forest_stand_radius(forest), radius = (double)forest->radius;
    double each = forest->element.level_count > 0 ? (double)element_attractors(&forest->element)
                                                  : (double)OWN_ATTRACTORS * forest->stand_trees;
    double leaves = fmin((double)forest->leaves.max_count, LEAVES_AN_ATTRACTOR * each);
    needs_add_skinned_growth(needs, "stand_trees", each * forest->stands, forest->skin.levels,
                             (double)(forest->skin.curve_radius / forest->radii.tip));
    needs_add(needs, "leaves.max_count", leaves * forest->stands, LEAF_BYTES);
    double places =
        3.628 * radius * radius / (pitch * pitch) * (double)forest->density; // 2 pi / sqrt 3
    needs_add_groups(needs, "radius", places, PARTS);
    needs_add_copies(needs, "ferns", 0.5 * (double)forest->ferns, 1e9);
}

static void settle(const void *params, void *settled)
{
    ForestParams p = forest_params_resolve(params);
    memcpy(settled, &p, sizeof p);
}

static const Key MATERIALS[] = {
    OWN_MATERIAL_ROW(0), TWIG_MATERIAL_ROW(1), LEAF_MATERIAL_ROW(2), GRASS_MATERIAL_ROW(3), {0},
};

const Kind kind_forest = {
    .variant = {KIND_ROW("forest", &forest_table, "A forest: stands of trees, with ferns."),
                MATERIALS},
    .reads_scene = true,
    .reads_water = true,
    .materials = {"bark", "twig", "leaf", "grass"},
    .needs = needs,
    .measure = measure,
    .describe = describe,
    .copies = copies,
    .settle = settle,
    .grow = forest_grow,
    .tip_radius = forest_tip_radius,
    .geometry = forest_geometry};
