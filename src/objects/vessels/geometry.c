// Geometry and measures of grown vessels.
#include "base/memory.h"
#include "objects/vessels/grow.h"
#include "objects/vessels/vessels.h"
#include "skin/skin.h"

#include <stdlib.h>

OutTree *vessels_colony(const OutTree *tree, int32_t colony, Error *e)
{
    OutTree *mine = out_tree_copy(tree, e);
    bool *keep = memory_alloc(tree->count, sizeof *keep, e);
    bool done = mine && keep;
    for (int64_t i = 0; done && i < tree->count; i++) {
        keep[i] = tree->colony[i] == colony;
    }
    done = done && out_tree_keep_nodes(mine, keep, e);
    free(keep);
    if (!done) {
        out_tree_free(mine);
        return NULL;
    }
    return mine;
}

// Thick vessels as a smooth skin, thin ones as round curves.
static bool add_colony(const OutTree *tree, const VesselsParams *params, int colony,
                       const Placing *placing, Error *e)
{
    SkinParams skin = skin_params_default();
    skin.levels = params->skin_levels;
    skin.ring_spacing = params->ring_spacing;
    skin.wall = params->wall;
    skin.min_radius = params->curve_radius > 0.0f ? params->curve_radius : INFINITY;
    if (params->curve_radius > 0.0f) {
        Part thick = {.mesh = skin_tree(tree, &skin, placing->recipe->run, e)};
        if (!placing_add(placing, thick, colony, e)) {
            return false;
        }
    }
    Part thin = {.curves = skin_curves(tree, skin.min_radius, &skin, e)};
    return placing_add(placing, thin, colony, e);
}

bool vessels_geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    const VesselsParams *params = given;
    bool done = true;
    for (int32_t colony = 0; done && colony < (params->veins ? 2 : 1); colony++) {
        OutTree *mine = vessels_colony(grown->tree, colony, e);
        done = mine && (mine->count < 2 || add_colony(mine, params, colony, placing, e));
        out_tree_free(mine);
    }
    return done;
}

// Least distance between surfaces of arteries and veins, m; NAN without veins.
static bool measure_gap(const OutTree *arteries, const OutTree *veins, double *gap, Error *e)
{
    *gap = (double)NAN;
    if (arteries->count < 2 || veins->count < 2) {
        return true;
    }
    SegmentGrid *grid = segment_grid_new(arteries, e);
    if (!grid) {
        return false;
    }
    float least = vec3_distance(arteries->position[0], veins->position[0]);
    for (int64_t i = 0; i < veins->count; i++) {
        if (veins->parent[i] >= 0) {
            least = segment_grid_gap(grid, veins->position[veins->parent[i]], veins->position[i],
                                     veins->radius[i], least);
        }
    }
    segment_grid_free(grid);
    *gap = (double)least;
    return true;
}

static bool add_measures(const OutTree *arteries, const OutTree *veins, const MurrayFit *fit,
                         MeasureList *list, Error *e)
{
    int64_t terminals[2];
    for (int i = 0; i < 2; i++) {
        int32_t *children = vessel_child_counts(i == 0 ? arteries : veins, &terminals[i], e);
        bool counted = children != NULL;
        free(children);
        if (!counted) {
            return false;
        }
    }
    double gap, none = (double)NAN;
    return measure_gap(arteries, veins, &gap, e) &&
           measures_add(list, "arterial_terminals", (double)terminals[0], "", none, none, e) &&
           measures_add(list, "venous_terminals", (double)terminals[1], "", none, none, e) &&
           measures_add(list, "flow_residual", fit->residual, "", 0.0, 1e-4, e) &&
           measures_add(list, "murray_angle_error_median", fit->angle_median, "degrees", none, none,
                        e) &&
           measures_add(list, "murray_angle_exact_share", fit->angle_exact, "", none, none, e) &&
           measures_add(list, "bifurcation_side_angle", fit->side_angle, "degrees", 13.0, 43.0,
                        e) &&
           measures_add(list, "artery_vein_gap", gap, "m", 0.0, none, e);
}

bool vessels_measure(const void *given, const Grown *grown, const Recipe *recipe, MeasureList *list,
                     Error *e)
{
    (void)recipe;
    const VesselsParams *params = given;
    const OutTree *tree = grown->tree;
    OutTree *trees[2] = {vessels_colony(tree, VESSELS_ARTERIES, e), NULL};
    trees[1] = trees[0] ? vessels_colony(tree, VESSELS_VEINS, e) : NULL;
    MurrayFit fit; // of both
    bool done = trees[0] && trees[1] && out_tree_murray_fit(tree, params->law, &fit, e) &&
                add_measures(trees[0], trees[1], &fit, list, e) &&
                vessels_measure_flow(trees[0], &params->flow, "artery", list, e) &&
                (!params->veins || vessels_measure_flow(trees[1], &params->flow, "vein", list, e));
    out_tree_free(trees[0]);
    out_tree_free(trees[1]);
    return done;
}
