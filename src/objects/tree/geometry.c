// From a grown tree to geometry: bark mesh, twigs as curves, leaves and organs as instances.
#include "objects/tree/buttress.h"
#include "objects/tree/defaults.h"
#include "objects/tree/hazards.h"
#include "objects/tree/ribs.h"
#include "objects/tree/tree.h"
#include "objects/tree/veteran.h"

#include "base/random.h"

enum { RIBBED_SIDES = 32 }; // of the cage

static bool add_bark(const OutTree *tree, const TreeParams *params, const SkinParams *skin,
                     const Placing *placing, Error *e)
{
    Mesh *mesh = skin_tree(tree, skin, placing->recipe->run, e);
    if (mesh && (!tree_buttress(mesh, tree, params, e) || !tree_ribs(mesh, params, e) ||
                 !tree_add_moss(mesh, params, placing, e))) {
        mesh_free(mesh);
        return false;
    }
    return placing_add(placing, (Part){.mesh = mesh}, TREE_BARK, e);
}

// What has lost its bark.
static bool add_dead(const OutTree *dead, const TreeParams *params, const SkinParams *skin,
                     const Placing *placing, Error *e)
{
    TwigParams twigs = {
        .skin = &params->skin, .twig_role = TREE_DEADWOOD, .leaf_role = TREE_DEADWOOD};
    Mesh *mesh = skin_tree(dead, skin, placing->recipe->run, e);
    return placing_add(placing, (Part){.mesh = mesh}, TREE_DEADWOOD, e) &&
           branches_add_twigs(dead, &twigs, placing, e);
}

static bool add_living(const OutTree *tree, const TreePlan *plan, const SkinParams *skin,
                       const Placing *placing, Error *e)
{
    const TreeParams *params = &plan->params;
    int32_t leafless = plan->grown_by == GROWN_BY_ATTRACTORS ? -1 : TREE_SNAGS;
    TwigParams twigs = {.skin = &params->skin,
                        .leaves = &params->leaves,
                        .light.center =
                            vec3_add(params->position, vec3(0, 0.5f * params->height, 0)),
                        .bare_from = params->roots.count > 0 ? TREE_ROOTS : leafless,
                        .seed = random_key(placing->recipe->seed, STREAM_TREE_LEAVES),
                        .twig_role = TREE_TWIG,
                        .leaf_role = TREE_LEAF};
    OrgansParams organs = {.group = params->organs,
                           .count = params->organ_count,
                           .time = phenology_time(params->season, params->latitude),
                           .skin = &params->skin,
                           .bare_from = twigs.bare_from,
                           .seed = random_key(placing->recipe->seed, STREAM_TREE_ORGANS),
                           .role = {[TISSUE_PETAL] = TREE_BLOSSOM,
                                    [TISSUE_FLESH] = TREE_FRUIT,
                                    [TISSUE_WOOD] = TREE_CONE,
                                    [TISSUE_GREEN] = TREE_STALK,
                                    [TISSUE_WING] = TREE_LEAF,
                                    [TISSUE_ANTHER] = TREE_ANTHER}};
    return add_bark(tree, params, skin, placing, e) &&
           branches_add_twigs(tree, &twigs, placing, e) && organs_add(tree, &organs, placing, e);
}

// Dead wood is a part of its own if limbs have died or been overgrown; stubs alone have bark.
static bool add_veteran(const OutTree *tree, const TreePlan *plan, const SkinParams *skin,
                        const Placing *placing, Error *e)
{
    OutTree *living = NULL, *dead = NULL;
    bool done =
        tree_split_dead(tree, &living, &dead, e) && add_living(living, plan, skin, placing, e) &&
        (!dead || add_dead(dead, &plan->params, skin, placing, e)) &&
        tree_add_knots(tree, placing, e) && tree_add_mistletoe(tree, &plan->params, placing, e);
    out_tree_free(living);
    out_tree_free(dead);
    return done;
}

bool tree_geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    TreePlan plan;
    tree_plan_make(&plan, given, placing->recipe->seed);
    const TreeParams *params = &plan.params;
    if (tree_is_dead(grown->tree, &params->hazards)) {
        plan.params.leaves.max_count = 0;
        plan.params.organ_count = 0;
    }
    SkinParams skin = branches_skin(&params->skin);
    skin.sides = params->trunk.ribs > 0 ? RIBBED_SIDES : 0;
    bool marked = params->veteran.dead_limbs > 0.0f || params->light.healing > 0 ||
                  tree_has_hazards(&params->hazards);
    bool veteran = plan.grown_by != GROWN_BY_ATTRACTORS && marked;
    int64_t first = placing->geometry->count;
    bool done = veteran ? add_veteran(grown->tree, &plan, &skin, placing, e)
                        : add_living(grown->tree, &plan, &skin, placing, e) &&
                              tree_add_mistletoe(grown->tree, params, placing, e);
    return done &&
           snow_add(grown->tree, &params->skin, &params->snow,
                    params->roots.count > 0 ? TREE_ROOTS : -1, first, placing, TREE_SNOW, e) &&
           hoar_add(grown->tree, &params->skin, &params->hoar, placing, TREE_RIME, e);
}
