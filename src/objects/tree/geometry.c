// From a grown tree to geometry: bark mesh, twigs as curves, leaves as instances.
#include "objects/common/foliage.h"
#include "objects/tree/buttress.h"
#include "objects/tree/defaults.h"
#include "objects/tree/tree.h"
#include "skin/skin.h"

#include "base/memory.h"
#include "base/random.h"

#include <stdlib.h>

static bool add_bark(const OutTree *tree, const TreeParams *params, const SkinParams *skin,
                     const Placing *placing, Error *e)
{
    Mesh *mesh = skin_tree(tree, skin, placing->recipe->run, e);
    if (mesh && !tree_buttress(mesh, tree, params, e)) {
        mesh_free(mesh);
        return false;
    }
    return placing_add(placing, (Part){.mesh = mesh}, TREE_BARK, e);
}

// Marks the curves that are roots, which bear no leaves. A curve has the id of its first node, and
// curves are in the order of those nodes.
static bool *find_roots(const OutTree *tree, const CurveSet *curves, Error *e)
{
    bool *root = memory_alloc(curves->curve_count, sizeof *root, e);
    int64_t node = 0;
    for (int64_t i = 0; root && i < curves->curve_count; i++) {
        while (tree->id[node] != curves->id[i]) {
            node++;
        }
        root[i] = tree->colony[node] == TREE_ROOTS;
    }
    return root;
}

static bool add_leaves(const OutTree *tree, const TreeParams *params, const CurveSet *twigs,
                       const Placing *placing, Error *e)
{
    Vec3 center = vec3_add(params->position, vec3(0, 0.5f * params->height, 0));
    bool rooted = params->roots.count > 0;
    bool *bare = rooted ? find_roots(tree, twigs, e) : NULL;
    bool done =
        (bare || !rooted) &&
        foliage_add(twigs, bare, &params->leaves, center,
                    random_key(placing->recipe->seed, STREAM_TREE_LEAVES), placing, TREE_LEAF, e);
    free(bare);
    return done;
}

// Leaves are placed on the curves drawn as twigs, so that none floats. If every twig is mesh, the
// curves are made for the leaves alone.
static bool add_twigs_and_leaves(const OutTree *tree, const TreeParams *params,
                                 const SkinParams *skin, const Placing *placing, Error *e)
{
    bool drawn = params->skin.curve_radius > 0.0f;
    bool leafy = params->leaves.max_count > 0;
    if (!drawn && !leafy) {
        return true;
    }
    float radius = drawn ? params->skin.curve_radius : params->leaves.twig_radius;
    CurveSet *twigs = skin_curves(tree, radius, skin, e);
    if (!twigs) {
        return false;
    }
    bool done = !leafy || add_leaves(tree, params, twigs, placing, e);
    if (!done || !drawn) {
        curves_free(twigs);
        return done;
    }
    return placing_add(placing, (Part){.curves = twigs}, TREE_TWIG, e);
}

bool tree_geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    const TreeParams *params = given;
    SkinParams skin = skin_params_default();
    skin.min_radius = params->skin.curve_radius;
    skin.levels = params->skin.levels;
    if (params->skin.ring_spacing > 0.0f) {
        skin.ring_spacing = params->skin.ring_spacing;
    }
    return add_bark(grown->tree, params, &skin, placing, e) &&
           add_twigs_and_leaves(grown->tree, params, &skin, placing, e);
}
