#include "objects/common/branches.h"

#include "base/memory.h"
#include "objects/common/foliage.h"

#include <stdlib.h>

SkinParams branches_skin(const SkinningParams *given)
{
    SkinParams skin = skin_params_default();
    skin.min_radius = given->curve_radius;
    skin.levels = given->levels;
    skin.collar = given->collar;
    skin.swelling = given->swelling;
    skin.fluting = given->fluting;
    if (given->ring_spacing > 0.0f) {
        skin.ring_spacing = given->ring_spacing;
    }
    return skin;
}

// A curve has the id of its first node, and curves are in the order of those nodes.
bool *branches_bare(const OutTree *tree, const CurveSet *curves, int32_t first, Error *e)
{
    bool *bare = memory_alloc(curves->curve_count, sizeof *bare, e);
    int64_t node = 0;
    for (int64_t i = 0; bare && i < curves->curve_count; i++) {
        while (tree->id[node] != curves->id[i]) {
            node++;
        }
        bare[i] = tree->colony[node] >= first;
    }
    return bare;
}

static bool add_leaves(const OutTree *tree, const TwigParams *params, const CurveSet *twigs,
                       const Placing *placing, Error *e)
{
    bool some = params->bare_from >= 0;
    bool *bare = some ? branches_bare(tree, twigs, params->bare_from, e) : NULL;
    bool done = (bare || !some) && foliage_add(twigs, bare, params->leaves, &params->light,
                                               params->seed, placing, params->leaf_role, e);
    free(bare);
    return done;
}

// Warns when most of what is thin enough to bear leaves is mesh, which bears none.
static void warn_of_lost_leaves(const OutTree *tree, const TwigParams *params, const Recipe *recipe)
{
    const float most = 0.5f; // of the length: less is the lower end of some twigs
    float thin = params->leaves->twig_radius, drawn = params->skin->curve_radius;
    double all = 0.0, lost = 0.0; // m
    for (int64_t i = 0; i < tree->count && drawn < thin; i++) {
        bool bears = params->bare_from < 0 || tree->colony[i] < params->bare_from;
        if (tree->parent[i] >= 0 && bears && tree->radius[i] < thin) {
            double length =
                (double)vec3_distance(tree->position[i], tree->position[tree->parent[i]]);
            all += length;
            lost += tree->radius[i] < drawn ? 0.0 : length;
        }
    }
    if (lost > (double)most * all) {
        recipe_warn(recipe, NULL,
                    "%.0f %% of the branches thinner than leaves.twig_radius, %g m, bear no "
                    "leaves, for only those thinner than skin.curve_radius, %g m, do; increase "
                    "skin.curve_radius to leaves.twig_radius",
                    100.0 * lost / all, (double)thin, (double)drawn);
    }
}

// Leaves of a rosette stand on the ends of trunks too, which no curves show.
static bool add_rosettes(const OutTree *tree, const TwigParams *params, const SkinParams *skin,
                         const Placing *placing, Error *e)
{
    CurveSet *curves = skin_curves(tree, params->leaves->twig_radius, skin, e);
    bool done = curves && add_leaves(tree, params, curves, placing, e);
    curves_free(curves);
    return done;
}

bool branches_add_twigs(const OutTree *tree, const TwigParams *params, const Placing *placing,
                        Error *e)
{
    bool drawn = params->skin->curve_radius > 0.0f;
    bool leafy =
        params->leaves && params->leaves->max_count > 0 && params->leaves->emergence > 0.0f;
    if (!drawn && !leafy) {
        return true;
    }
    SkinParams skin = branches_skin(params->skin);
    if (leafy && params->leaves->arrangement == ARRANGE_ROSETTE) {
        if (!add_rosettes(tree, params, &skin, placing, e)) {
            return false;
        }
        leafy = false;
        if (!drawn) {
            return true;
        }
    }
    if (drawn && leafy) {
        warn_of_lost_leaves(tree, params, placing->recipe);
    }
    float radius = drawn ? params->skin->curve_radius : params->leaves->twig_radius;
    CurveSet *twigs = skin_curves(tree, radius, &skin, e);
    if (!twigs) {
        return false;
    }
    bool done = !leafy || add_leaves(tree, params, twigs, placing, e);
    if (!done || !drawn) {
        curves_free(twigs);
        return done;
    }
    return placing_add(placing, (Part){.curves = twigs}, params->twig_role, e);
}
