#include "objects/vessels/vessels.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "objects/vessels/grow.h"
#include "objects/vessels/stem.h"

#include <math.h>

VesselsParams vessels_params_default(void)
{
    FlowParams flow = flow_params_default();
    flow.returning = VESSELS_VEINS;
    return (VesselsParams){.element.growth = {.max_children = 2,
                                              .max_angle = 100.0f,
                                              .noise = 0.2f,
                                              .field_weight = 1.0f},
                           .terminals = 6000,
                           .veins = true,
                           .vein_radius = 1.2f,
                           .law = {2.7f},
                           .gap = 0.3f,
                           .turn = true,
                           .skin_levels = 2,
                           .ring_spacing = 1.0f,
                           .flow = flow};
}

static bool is_body(const VesselsParams *params)
{
    return params->element.shapes[0].kind == SHAPE_BODY;
}

// Plants the vessels from which one tree grows: those that the user has placed, else those of the
// body, else a stem at the inlet.
static bool plant_tree(const VesselBed *bed, OutTree *tree, int32_t colony, float root, float reach,
                       Error *e)
{
    const VesselsParams *params = bed->params;
    uint64_t seed = bed->recipe->seed;
    if (!vessels_plant_placed(tree, params, colony, reach, seed, e)) {
        return false;
    }
    if (tree->count > 0) {
        return true;
    }
    return is_body(params)
               ? vessels_plant_great(tree, &params->element.shapes[0], colony, seed, e)
               : vessels_plant_stem(tree, params, bed->envelope, colony, root, reach, seed, e);
}

static bool plant(VesselBed *bed, Error *e)
{
    const VesselsParams *params = bed->params;
    float reach =
        (float)exact_exp(exact_log(envelope_volume(bed->envelope)) / 3.0); // of a cube as large
    bool body = is_body(params);
    float root = params->root_radius;
    if (!(root > 0.0f)) {
        root = body ? vessels_aorta_radius(&params->element.shapes[0]) : 0.035f * reach;
    }
    for (int t = 0; t < bed->tree_count; t++) {
        VesselTree *tree = &bed->trees[t];
        tree->colony = t;
        tree->root_radius = root * (t == VESSELS_VEINS ? params->vein_radius : 1.0f);
        tree->tree = out_tree_new(e);
        if (!tree->tree || !plant_tree(bed, tree->tree, t, root, reach, e)) {
            return false;
        }
        tree->stem_count = tree->tree->count;
    }
    int32_t last = 0;
    for (int t = 0; t < bed->tree_count; t++) {
        int32_t mine = out_tree_last_birth(bed->trees[t].tree);
        last = mine > last ? mine : last;
    }
    bed->trees[0].last_birth = bed->trees[1].last_birth = last;
    return true;
}

static void report(const VesselBed *bed)
{
    if (bed->turned.multiple > 0) {
        recipe_warn(bed->recipe, NULL,
                    "%lld nodes have more than two children; Murray's angles are not "
                    "set there: keep growth.max_children at 2",
                    (long long)bed->turned.multiple);
    }
    if (bed->lost_stems > 0) {
        recipe_warn(bed->recipe, NULL,
                    "great vessels of arteries and veins touch; %lld of their nodes were removed, "
                    "with all that grew from them: place them farther apart",
                    (long long)bed->lost_stems);
    }
}

static bool grow_all(VesselBed *bed, Error *e)
{
    if (!bed->envelope || !growth_observe(bed->recipe, NULL, bed->envelope, NULL, e) ||
        !plant(bed, e) || !vessel_bed_grow(bed, e) || !vessel_bed_finish(bed, e)) {
        return false;
    }
    report(bed);
    return bed->tree_count == 1 || out_tree_append(bed->trees[0].tree, bed->trees[1].tree, e);
}

bool vessels_grow(const void *given, const Recipe *recipe, Grown *whole, Error *e)
{
    const VesselsParams *params = given;
    Envelope *envelope = element_envelope(&params->element, recipe->run, e);
    VesselBed bed = {.params = params,
                     .envelope = envelope,
                     .tree_count = params->veins ? 2 : 1,
                     .limbs = is_body(params),
                     .recipe = recipe};
    bool done = grow_all(&bed, e);
    whole->tree = bed.trees[0].tree;
    out_tree_free(bed.trees[1].tree);
    envelope_free(envelope);
    return done;
}

static float finest_radius(const OutTree *tree, int32_t colony)
{
    float radius = INFINITY;
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->colony[i] == colony) {
            radius = tree->radius[i] < radius ? tree->radius[i] : radius;
        }
    }
    return radius;
}

// Radii of the trees at an earlier time: by Murray's law, so thinner than the final ones.
bool vessels_finish(const void *given, const Recipe *recipe, const Grown *whole, Grown *grown,
                    Error *e)
{
    (void)recipe, (void)e;
    const VesselsParams *params = given;
    OutTree *tree = grown->tree;
    if (tree->count == whole->tree->count) {
        return true;
    }
    OutTree arteries = *tree; // come first
    arteries.count = 0;
    while (arteries.count < tree->count && tree->colony[arteries.count] == VESSELS_ARTERIES) {
        arteries.count++;
    }
    out_tree_murray_radii(tree, params->law, finest_radius(whole->tree, VESSELS_VEINS));
    out_tree_murray_radii(&arteries, params->law, finest_radius(whole->tree, VESSELS_ARTERIES));
    return true;
}
