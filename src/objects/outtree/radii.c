// Thickness of a general out-tree's branches.
#include "objects/outtree/outtree.h"

#include "base/exact_math.h"
#include "outtree/chains.h"
#include "outtree/murray.h"
#include "outtree/radii.h"

#define TIP_SHARE 0.12f     // of the mean distance between nodes
#define BIRTH_CONTRAST 8.0f // root over tip
#define ORDER_CONTRAST 4.0f

static float mean_segment(const OutTree *tree)
{
    double sum = 0.0, count = 0.0;
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->parent[i] >= 0) {
            sum += (double)vec3_distance(tree->position[i], tree->position[tree->parent[i]]);
            count += 1.0;
        }
    }
    return count > 0.0 && sum > 0.0 ? (float)(sum / count) : 1.0f;
}

// The main branch has the root's radius; a branch of the next order starts at `ratio` of that.
static bool order_radii(OutTree *tree, float root, float tip, float ratio, Error *e)
{
    ChainSet *chains = out_tree_chains(tree, e);
    for (int64_t c = 0; chains && c < chains->count; c++) {
        float radius = root;
        for (int k = 0; k < chains->order[c] && radius > tip; k++) {
            radius *= ratio;
        }
        // a side chain begins with the fork that it leaves
        int64_t begin = chains->first[c] + (chains->parent[c] >= 0);
        for (int64_t i = begin; i < chains->first[c + 1]; i++) {
            tree->radius[chains->node[i]] = radius > tip ? radius : tip;
        }
    }
    bool done = chains;
    chains_free(chains);
    return done;
}

ThicknessParams outtree_resolve_radii(const OutTree *tree, const ThicknessParams *given)
{
    ThicknessParams params = *given;
    params.tip = params.tip > 0.0f ? params.tip : TIP_SHARE * mean_segment(tree);
    return params;
}

bool outtree_radii(OutTree *tree, const ThicknessParams *params, Error *e)
{
    float tip = params->tip, root = params->root;
    switch (params->model) {
    case OUTTREE_PIPE:
        out_tree_pipe_radii(tree, params->exponent, tip, root);
        return true;
    case OUTTREE_MURRAY:
        out_tree_murray_radii(tree, (MurrayLaw){0}, tip);
        return true;
    case OUTTREE_BIRTH:
        out_tree_birth_radii(tree, tip, root > 0.0f ? root : BIRTH_CONTRAST * tip);
        return true;
    case OUTTREE_ORDER:
        return order_radii(tree, root > 0.0f ? root : ORDER_CONTRAST * tip, tip, params->ratio, e);
    case OUTTREE_EVEN:
        for (int64_t i = 0; i < tree->count; i++) {
            tree->radius[i] = tip;
        }
        return true;
    }
    return true;
}
