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
    const ForestParams *forest = params;
    measures_set_range(list, "radius_exponent", 1.8, 2.3);
    measures_set_range(list, "branch_angle", 30.0, 70.0);
    measures_set_range(list, "horton_number", 3.0, 5.0);
    return forest->species_count > 0 || // these grow in stands without borders
           (forest_crown_gap(grown->tree, params, &gap, e) &&
            measures_add(list, "crown_gap", gap, "m", (double)NAN, (double)NAN, e));
}

static const char *further_material(const void *params, int index)
{
    const ForestParams *forest = params;
    return tree_mix_material(forest->species, forest->species_count, index);
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

static void needs_add_species(const ForestParams *forest, Needs *needs)
{
    enum { EDGE = 6, TREE_BYTES = 60000000, PARTS = 20 };
    double trees = (double)forest->stands * forest->stand_trees + EDGE + forest->species_count;
    double radius = (double)forest->radius, pitch = (double)forest_params_resolve(forest).spacing;
    needs_add(needs, "stand_trees", trees, TREE_BYTES);
    needs_add_groups(needs, "radius",
                     3.628 * radius * radius / (pitch * pitch) * (double)forest->density, PARTS);
    needs_add_copies(needs, "ferns", 0.5 * (double)forest->ferns, 1e9);
}

static void needs(const void *params, Needs *needs)
{
    enum { OWN_ATTRACTORS = 2320, LEAVES_AN_ATTRACTOR = 6, LEAF_BYTES = 2500, PARTS = 4 };
    const ForestParams *forest = params;
    if (forest->species_count > 0) {
        needs_add_species(forest, needs);
        return;
    }
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
    .further_material = further_material,
    .needs = needs,
    .measure = measure,
    .describe = describe,
    .copies = copies,
    .settle = settle,
    .grow = forest_grow,
    .tip_radius = forest_tip_radius,
    .geometry = forest_geometry};
