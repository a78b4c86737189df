// From a grown out-tree to what is seen of it.
#include "objects/outtree/outtree.h"

#include "base/memory.h"
#include "base/random.h"
#include "objects/common/balls.h"
#include "outtree/branching.h"

#include <stdlib.h>

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
                        .light.center = vec3_lerp(box.low, box.high, 0.5f),
                        .bare_from = -1,
                        .seed = random_key(placing->recipe->seed, STREAM_OUTTREE_LEAVES),
                        .twig_role = OUTTREE_TWIG,
                        .leaf_role = OUTTREE_LEAF};
    return branches_add_twigs(tree, &twigs, placing, e);
}

// Balls at tips, evenly chosen if there are too many.
static bool add_lamps(const LampsParams *lamps, const OutTree *tree, const Placing *placing,
                      Error *e)
{
    Branching branching;
    if (lamps->max_count == 0) {
        return true;
    }
    if (!branching_init(&branching, tree, e)) {
        return false;
    }
    Vec3 *place = memory_alloc(tree->count, sizeof *place, e);
    float *radius = place ? memory_alloc(tree->count, sizeof *radius, e) : NULL;
    uint64_t seed = random_key(placing->recipe->seed, STREAM_OUTTREE_LAMPS);
    int64_t tips = 0;
    for (int64_t i = 0; radius && i < tree->count; i++) {
        if (branching.children[i] == 0) {
            float smaller = lamps->variation * random_unit(random_key(seed, tree->id[i]));
            radius[tips] = lamps->radius * (1.0f - smaller);
            place[tips++] = vec3_madd(tree->position[i], lamps->drop, vec3(0, -1, 0));
        }
    }
    int64_t count = tips < lamps->max_count ? tips : lamps->max_count;
    for (int64_t i = 0; radius && i < count; i++) {
        int64_t from = (int64_t)((double)i * (double)tips / (double)count);
        place[i] = place[from];
        radius[i] = radius[from];
    }
    bool done = radius && balls_add_each(place, radius, count, placing, OUTTREE_LAMP, e);
    free(radius);
    free(place);
    branching_free(&branching);
    return done;
}

bool outtree_geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    const OuttreeParams *params = given;
    const OutTree *tree = grown->tree;
    const int blade_roles[2] = {OUTTREE_SKIN, OUTTREE_WHITE};
    bool done = true;
    if (params->form == OUTTREE_TUBES) {
        done = add_branches(params, tree, placing, e);
    } else if (params->form == OUTTREE_BLADES) {
        done = blades_add(tree, &params->blades, placing, blade_roles, e);
    }
    return done && add_lamps(&params->lamps, tree, placing, e) &&
           outtree_show(params, tree, grown->state, placing, e);
}
