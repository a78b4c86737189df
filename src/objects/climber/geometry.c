// From a grown climber to what is seen of it.
#include "objects/climber/climber.h"

#include "base/random.h"
#include "field/point_tree.h"

// The nodes, to find the nearest of a leaf.
typedef struct Stems {
    const OutTree *tree;
    PointTree nodes;
} Stems;

// Leaves turn away from what the climber holds to: as the normal of the nearest node.
static Vec3 outward(const void *user, Vec3 p)
{
    const Stems *stems = user;
    return stems->tree->normal[point_tree_nearest(&stems->nodes, p, -1)->index];
}

static bool add_stems(const ClimberParams *params, const OutTree *tree, const Placing *placing,
                      Error *e)
{
    bool thick = false;
    for (int64_t i = 0; i < tree->count && !thick; i++) {
        thick = tree->parent[i] >= 0 && tree->radius[i] >= params->skin.curve_radius;
    }
    SkinParams skin = branches_skin(&params->skin);
    Mesh *mesh = thick ? skin_tree(tree, &skin, placing->recipe->run, e) : NULL;
    return !thick || placing_add(placing, (Part){.mesh = mesh}, CLIMBER_BARK, e);
}

static bool add_rootlets(const ClimberParams *params, const Grown *grown, const Placing *placing,
                         Error *e)
{
    if (params->rootlets.spacing <= 0.0f) {
        return true;
    }
    uint64_t seed = random_key(placing->recipe->seed, STREAM_CLIMBER_ROOTLETS);
    Part part = {.kind = PART_CURVES,
                 .curves = climber_rootlets(params, grown->tree, grown->state, seed, e)};
    if (part.curves && part.curves->curve_count == 0) {
        curves_free(part.curves);
        return true;
    }
    return part.curves && placing_add(placing, part, CLIMBER_BARK, e);
}

bool climber_geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    const ClimberParams *params = given;
    Stems stems = {.tree = grown->tree};
    if (!add_stems(params, grown->tree, placing, e) || !add_rootlets(params, grown, placing, e) ||
        !point_tree_init(&stems.nodes, grown->tree->position, grown->tree->count, e)) {
        return false;
    }
    TwigParams twigs = {.skin = &params->skin,
                        .leaves = &params->leaves,
                        .light = {.facing = outward, .user = &stems},
                        .bare_from = -1,
                        .seed = random_key(placing->recipe->seed, STREAM_CLIMBER_LEAVES),
                        .twig_role = CLIMBER_TWIG,
                        .leaf_role = CLIMBER_LEAF};
    OrgansParams organs = {.group = params->organs,
                           .count = params->organ_count,
                           .time = phenology_time(params->season, params->latitude),
                           .skin = &params->skin,
                           .bare_from = -1,
                           .light = twigs.light,
                           .seed = random_key(placing->recipe->seed, STREAM_CLIMBER_ORGANS),
                           .role = {[TISSUE_PETAL] = CLIMBER_BLOSSOM,
                                    [TISSUE_FLESH] = CLIMBER_FRUIT,
                                    [TISSUE_WOOD] = CLIMBER_CONE,
                                    [TISSUE_GREEN] = CLIMBER_STALK,
                                    [TISSUE_WING] = CLIMBER_LEAF,
                                    [TISSUE_ANTHER] = CLIMBER_ANTHER}};
    bool done = branches_add_twigs(grown->tree, &twigs, placing, e) &&
                organs_add(grown->tree, &organs, placing, e);
    point_tree_free(&stems.nodes);
    return done;
}
