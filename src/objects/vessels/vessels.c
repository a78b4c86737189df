#include "objects/vessels/vessels.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "objects/vessels/grow.h"
#include "objects/vessels/stem.h"

#include <stdlib.h>

VesselsParams vessels_params_default(void)
{
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
                           .skin_levels = 2};
}

static bool is_body(const VesselsParams *params)
{
    return params->element.shapes[0].kind == SHAPE_BODY;
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
        if (!tree->tree ||
            !(body ? vessels_plant_great(tree->tree, &params->element.shapes[0], t, bed->seed, e)
                   : vessels_plant_stem(tree->tree, params, bed->envelope, t, root, reach,
                                        bed->seed, e))) {
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

static bool append(OutTree *tree, const OutTree *other, Error *e)
{
    int64_t base = tree->count;
    for (int64_t i = 0; i < other->count; i++) {
        int64_t parent = other->parent[i] < 0 ? -1 : base + other->parent[i];
        int64_t node = out_tree_add_node(tree, other->position[i], parent, other->birth[i],
                                         other->colony[i], other->id[i], e);
        if (node < 0) {
            return false;
        }
        tree->radius[node] = other->radius[i];
        tree->normal[node] = other->normal[i];
    }
    return true;
}

static float finest_radius(const OutTree *tree)
{
    float radius = tree->radius[0];
    for (int64_t i = 1; i < tree->count; i++) {
        radius = tree->radius[i] < radius ? tree->radius[i] : radius;
    }
    return radius;
}

// The tree as it was at step `last`, by Murray's law then too: thinner than it will be.
static bool cut(OutTree *tree, MurrayLaw law, float last, Error *e)
{
    bool *keep = memory_alloc(tree->count, sizeof *keep, e);
    if (!keep) {
        return false;
    }
    float tip = finest_radius(tree);
    for (int64_t i = 0; i < tree->count; i++) {
        keep[i] = (float)tree->birth[i] <= last;
    }
    bool done = out_tree_keep_nodes(tree, keep, e);
    if (done) {
        out_tree_murray_radii(tree, law, tip);
    }
    free(keep);
    return done;
}

// Shows the trees at recipe->grow_to and joins them.
static OutTree *show(VesselBed *bed, const Recipe *recipe, Error *e)
{
    int32_t last = 0;
    for (int t = 0; t < bed->tree_count; t++) {
        int32_t mine = out_tree_last_birth(bed->trees[t].tree);
        last = mine > last ? mine : last;
    }
    OutTree *all = bed->trees[0].tree;
    for (int t = 0; t < bed->tree_count; t++) {
        OutTree *tree = bed->trees[t].tree;
        if ((recipe->grow_to < 1.0f &&
             !cut(tree, bed->params->law, recipe->grow_to * (float)last, e)) ||
            (t > 0 && !append(all, tree, e))) {
            return NULL;
        }
    }
    bed->trees[0].tree = NULL;
    return all;
}

static void report(const VesselBed *bed)
{
    if (bed->turned.multiple > 0) {
        run_warn(bed->run,
                 "%s: %lld nodes have more than two children; Murray's angles are not "
                 "set there: keep growth.max_children at 2",
                 bed->label, (long long)bed->turned.multiple);
    }
}

// Everything, before it is cut.
static bool grow_whole(VesselBed *bed, const Recipe *recipe, Error *e)
{
    if (!plant(bed, e) || !vessel_bed_grow(bed, e) || !vessel_bed_finish(bed, e)) {
        return false;
    }
    report(bed);
    bool kept = true;
    for (int t = bed->tree_count - 1; kept && t >= 0; t--) { // the first, which is asked for, last
        kept = recipe_keep(recipe, t, bed->trees[t].tree, e);
    }
    return kept;
}

static bool recall(VesselBed *bed, const Recipe *recipe, Error *e)
{
    bool done = true;
    for (int t = 0; done && t < bed->tree_count; t++) {
        bed->trees[t].tree = recipe_recall(recipe, t, e);
        done = bed->trees[t].tree;
    }
    return done;
}

OutTree *vessels_grow(const VesselsParams *params, const Recipe *recipe, Error *e)
{
    EnvelopeParams shapes = {params->element.shapes, params->element.shape_count,
                             params->element.voxel};
    Envelope *envelope = recipe_remembers(recipe, 0) ? NULL : envelope_new(&shapes, recipe->run, e);
    VesselBed bed = {.params = params,
                     .envelope = envelope,
                     .tree_count = params->veins ? 2 : 1,
                     .limbs = is_body(params),
                     .seed = recipe->seed,
                     .label = recipe->label,
                     .run = recipe->run};
    OutTree *tree = NULL;
    bool again = recipe_remembers(recipe, 0);
    if (again ? recall(&bed, recipe, e)
              : envelope && growth_witness(recipe->run, recipe->label, envelope, NULL, e) &&
                    grow_whole(&bed, recipe, e)) {
        tree = show(&bed, recipe, e);
    }
    out_tree_free(bed.trees[0].tree);
    out_tree_free(bed.trees[1].tree);
    envelope_free(envelope);
    return tree;
}
