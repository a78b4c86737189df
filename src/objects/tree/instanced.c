#include "objects/tree/instanced.h"

bool tree_add_instanced(const TreeParams *params, const Grown *grown, const InstancedTree *how,
                        const Placing *placing, Error *e)
{
    if (how->at.count == 0) {
        return true;
    }
    Geometry single = {0};
    Recipe recipe = *placing->recipe;
    recipe.seed = how->at.seed;
    Placing own = *placing;
    own.recipe = &recipe;
    own.geometry = &single;
    own.material = how->material;
    TreeParams tree = *params;
    tree.leaves.litter = 0.0f; // it would lie once for all places
    tree.organ_count = how->at.distant ? 0 : tree.organ_count;
    bool done =
        tree_geometry(&tree, grown, &own, e) && instanced_add(&single, &how->at, placing, e);
    geometry_clear(&single);
    return done;
}
