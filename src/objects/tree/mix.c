#include "objects/tree/mix.h"

#include "config/table.h"

#define SHARE_MATERIAL(INDEX, KEY, DOC)                                 \
    {                                                                   \
        KEY_OF(TreeShare, material[INDEX], KEY, KEY_TEXT), .doc = (DOC) \
    }

static const Key SHARE_KEYS[] = {
    {KEY_OF(TreeShare, share, "share", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e6,
     .doc = "Share of the trees that are of this kind, relative to the others'."},
    {KEY_OF(TreeShare, tree, "tree", KEY_POINTER), .flags = KEY_REQUIRED, .table = &tree_table,
     .doc = "The tree: a species of the library, or any keys of a tree. It grows by light; its "
            "position is not used."},
    SHARE_MATERIAL(TREE_BARK, "material", "Material of the bark; default: the species', or bark."),
    SHARE_MATERIAL(TREE_TWIG, "twig_material",
                   "Material of twigs; default: the species', or twig."),
    SHARE_MATERIAL(TREE_LEAF, "leaf_material",
                   "Material of leaves; default: the species', or leaf."),
    SHARE_MATERIAL(TREE_BLOSSOM, "blossom_material", "Material of petals."),
    SHARE_MATERIAL(TREE_FRUIT, "fruit_material", "Material of fruit."),
    SHARE_MATERIAL(TREE_CONE, "cone_material", "Material of cones, catkins and buds."),
    SHARE_MATERIAL(TREE_STALK, "stalk_material", "Material of stalks."),
    SHARE_MATERIAL(TREE_SNOW, "snow_material", "Material of settled snow."),
    SHARE_MATERIAL(TREE_DEADWOOD, "deadwood_material", "Material of dead wood without bark."),
    SHARE_MATERIAL(TREE_MISTLETOE, "mistletoe_material", "Material of mistletoe."),
    SHARE_MATERIAL(TREE_MOSS, "moss_material", "Material of moss."),
    SHARE_MATERIAL(TREE_RIME, "rime_material", "Material of hoar frost."),
    SHARE_MATERIAL(TREE_ANTHER, "anther_material", "Material of anthers."),
    {0},
};

static void share_defaults(void *out)
{
    *(TreeShare *)out = (TreeShare){.share = 1.0f};
}

const Table tree_share_table = {.name = "tree_share",
                                .doc = "One of the kinds of trees that a wood is made of.",
                                .example = "objects:\n"
                                           "  - name: wood\n"
                                           "    forest:\n"
                                           "      species:\n"
                                           "        - {share: 3, tree: {species: beech}}\n"
                                           "        - {share: 1, tree: {species: silver_birch}}\n",
                                .size = sizeof(TreeShare),
                                .keys = SHARE_KEYS,
                                .defaults = share_defaults};

const char *tree_mix_material(const TreeShare *mix, int count, int i)
{
    static const char *const OWN[TREE_ROLES] = {
        [TREE_BARK] = "bark",           [TREE_TWIG] = "twig",   [TREE_LEAF] = "leaf",
        [TREE_BLOSSOM] = "blossom",     [TREE_FRUIT] = "fruit", [TREE_CONE] = "cone",
        [TREE_STALK] = "stalk",         [TREE_SNOW] = "snow",   [TREE_DEADWOOD] = "deadwood",
        [TREE_MISTLETOE] = "mistletoe", [TREE_MOSS] = "moss",   [TREE_RIME] = "rime",
        [TREE_ANTHER] = "tree/anther"};
    if (i >= count * TREE_ROLES) {
        return NULL;
    }
    const char *name = mix[i / TREE_ROLES].material[i % TREE_ROLES];
    return name ? name : OWN[i % TREE_ROLES];
}

void tree_mix_set_season(TreeShare *mix, int count, float season)
{
    for (int i = 0; season > 0.0f && i < count; i++) {
        TreeParams *tree = mix[i].tree;
        tree->season = season;
        phenology_apply(&tree->phenology, season, tree->latitude, &tree->leaves);
    }
}

int tree_mix_choose(const TreeShare *mix, int count, float u)
{
    float all = 0.0f;
    for (int i = 0; i < count; i++) {
        all += mix[i].share;
    }
    float at = u * all;
    for (int i = 0; i + 1 < count; i++) {
        at -= mix[i].share;
        if (at < 0.0f) {
            return i;
        }
    }
    return count - 1;
}
