// From a grown tree to geometry: bark mesh, twigs as curves, leaves and organs as instances.
#include "objects/tree/buttress.h"
#include "objects/tree/defaults.h"
#include "objects/tree/ribs.h"
#include "objects/tree/tree.h"

#include "base/random.h"

enum { RIBBED_SIDES = 32 }; // of the cage

static bool add_bark(const OutTree *tree, const TreeParams *params, const SkinParams *skin,
                     const Placing *placing, Error *e)
{
    Mesh *mesh = skin_tree(tree, skin, placing->recipe->run, e);
    if (mesh && (!tree_buttress(mesh, tree, params, e) || !tree_ribs(mesh, params, e))) {
        mesh_free(mesh);
        return false;
    }
    return placing_add(placing, (Part){.mesh = mesh}, TREE_BARK, e);
}

bool tree_geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    TreePlan plan;
    tree_plan_make(&plan, given, placing->recipe->seed);
    const TreeParams *params = &plan.params;
    int32_t leafless = plan.grown_by == GROWN_BY_ATTRACTORS ? -1 : TREE_SNAGS;
    SkinParams skin = branches_skin(&params->skin);
    skin.sides = params->trunk.ribs > 0 ? RIBBED_SIDES : 0;
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
                                    [TISSUE_WING] = TREE_LEAF}};
    int64_t first = placing->geometry->count;
    return add_bark(grown->tree, params, &skin, placing, e) &&
           branches_add_twigs(grown->tree, &twigs, placing, e) &&
           organs_add(grown->tree, &organs, placing, e) &&
           snow_add(grown->tree, &params->skin, &params->snow,
                    params->roots.count > 0 ? TREE_ROOTS : -1, first, placing, TREE_SNOW, e);
}
