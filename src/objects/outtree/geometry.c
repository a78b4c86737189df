// From a grown out-tree to what is seen of it.
#include "objects/outtree/outtree.h"

#include "base/random.h"

static bool has_skin(const OutTree *tree, float curve_radius)
{
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->parent[i] >= 0 && tree->radius[i] >= curve_radius) {
            return true;
        }
    }
    return false;
}

static bool add_branches(const OuttreeParams *params, const OutTree *tree, const Placing *placing,
                         Error *e)
{
    SkinParams skin = branches_skin(&params->skin);
    if (has_skin(tree, params->skin.curve_radius)) {
        Mesh *mesh = skin_tree(tree, &skin, placing->recipe->run, e);
        if (!placing_add(placing, (Part){.mesh = mesh}, OUTTREE_SKIN, e)) {
            return false;
        }
    }
    Aabb box = out_tree_bounds(tree);
    TwigParams twigs = {.skin = &params->skin,
                        .leaves = &params->leaves,
                        .center = vec3_lerp(box.low, box.high, 0.5f),
                        .bare_colony = -1,
                        .seed = random_key(placing->recipe->seed, STREAM_OUTTREE_LEAVES),
                        .twig_role = OUTTREE_TWIG,
                        .leaf_role = OUTTREE_LEAF};
    return branches_add_twigs(tree, &twigs, placing, e);
}

bool outtree_geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    return add_branches(given, grown->tree, placing, e);
}
