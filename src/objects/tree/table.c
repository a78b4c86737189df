// The tree: trunk, crown, roots, radii, leaves, skin.
#include "objects/common/tables.h"
#include "objects/tree/defaults.h"

static const Key TRUNK_KEYS[] = {
    {KEY_OF(TrunkParams, height, "height", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "From the ground to the trunk's last node; 0 = a share of the tree's height."},
    {KEY_OF(TrunkParams, radius, "radius", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Radius above the root flare; 0 = from the tree's height, by elastic similarity."},
    {KEY_OF(TrunkParams, lean, "lean", KEY_FLOAT), .high = 89, .unit = "degrees",
     .doc = "Angle from the vertical."},
    {KEY_OF(TrunkParams, lean_azimuth, "lean_azimuth", KEY_FLOAT), .low = -360, .high = 360,
     .unit = "degrees", .doc = "Where it leans to, from +Z toward +X."},
    {KEY_OF(TrunkParams, stems, "stems", KEY_INT), .low = 1, .high = 1000,
     .doc = "Stems that start on a circle about the base; 1 = a plain trunk."},
    {KEY_OF(TrunkParams, stem_circle, "stem_circle", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "Radius of that circle; 0 = the trunk's radius."},
    ELEMENT_ROWS(TrunkParams),
    {0},
};

static bool check_trunk(const Mapping *mapping, void *params)
{
    return check_element(mapping, &((const TrunkParams *)params)->element);
}

static const Table TRUNK_TABLE = {.name = "trunk",
                                  .doc = "The trunk: it grows straight up unless it leans, its "
                                         "growth has a tropism, or a field winds it.",
                                  .size = sizeof(TrunkParams),
                                  .keys = TRUNK_KEYS,
                                  .check = check_trunk};

static const Key CROWN_KEYS[] = {
    {KEY_OF(CrownParams, width, "width", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "Width of the crown; 0 = about the tree's height."},
    {KEY_OF(CrownParams, base, "base", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "Height above the ground where the crown begins; 0 = a share of the tree's height."},
    {KEY_OF(CrownParams, branches, "branches", KEY_INT), .high = 10000,
     .doc = "Main branches placed on the trunk, the first of them lowest; of two whose limbs would "
            "lie side by side the weaker is left out."},
    {KEY_OF(CrownParams, branch_from, "branch_from", KEY_FLOAT), .high = 1,
     .doc = "Share of the trunk's height where the lowest branch stands."},
    {KEY_OF(CrownParams, branch_angle, "branch_angle", KEY_FLOAT), .high = 180, .unit = "degrees",
     .doc = "Angle between a branch and the trunk where it starts."},
    {KEY_OF(CrownParams, branch_length, "branch_length", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "Length of the piece that a branch starts with; 0 = a share of the tree's height."},
    {KEY_OF(CrownParams, lobes, "lobes", KEY_INT), .high = TREE_MOST_LOBES,
     .doc = "Bulges about the ellipsoid that a crown without envelope fills: limbs that fight for "
            "light make an uneven outline; 0 = a plain ellipsoid."},
    ELEMENT_ROWS(CrownParams),
    {0},
};

static bool check_crown(const Mapping *mapping, void *params)
{
    return check_element(mapping, &((const CrownParams *)params)->element);
}

static const Table CROWN_TABLE = {
    .name = "crown",
    .doc = "The crown: main branches placed on the trunk, and all that grows from them toward the "
           "attractors in the crown's envelope.",
    .size = sizeof(CrownParams),
    .keys = CROWN_KEYS,
    .check = check_crown};

static const Key ROOTS_KEYS[] = {
    {KEY_OF(RootParams, count, "count", KEY_INT), .high = 10000, .doc = "Main roots; 0 = none."},
    {KEY_OF(RootParams, spread, "spread", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "How far they reach; 0 = a share of the tree's height."},
    {KEY_OF(RootParams, depth, "depth", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "How deep they go; 0 = 0.25 of the spread."},
    {KEY_OF(RootParams, radius, "radius", KEY_FLOAT), .flags = KEY_ABOVE, .high = 10,
     .doc = "Radius of a main root where it leaves the trunk, as a share of the trunk's."},
    ELEMENT_ROWS(RootParams),
    {0},
};

static bool check_roots(const Mapping *mapping, void *params)
{
    return check_element(mapping, &((const RootParams *)params)->element);
}

static const Table ROOTS_TABLE = {.name = "roots",
                                  .doc = "The roots, grown like the crown, but down and outward.",
                                  .size = sizeof(RootParams),
                                  .keys = ROOTS_KEYS,
                                  .check = check_roots};

static const EnumName RADIUS_MODELS[] = {{"pipe", RADIUS_PIPE}, {"birth", RADIUS_BIRTH}, {0}};

static const Key RADII_KEYS[] = {
    {KEY_OF(RadiiParams, model, "model", KEY_ENUM), .names = RADIUS_MODELS,
     .doc = "pipe: r_parent^e = sum of r_child^e; birth: older is thicker."},
    {KEY_OF(RadiiParams, exponent, "exponent", KEY_FLOAT), .low = 1, .high = 10,
     .doc = "e of the pipe model: 2 keeps the area (da Vinci), 3 is Murray's."},
    {KEY_OF(RadiiParams, tip, "tip", KEY_FLOAT), .flags = KEY_ABOVE, .high = 10, .unit = "m",
     .doc = "Radius of the twigs' tips; thickness adds up from there."},
    {KEY_OF(RadiiParams, flare, "flare", KEY_FLOAT), .high = 10,
     .doc = "How much wider the trunk is at the ground: 0.5 = half as wide again."},
    {KEY_OF(RadiiParams, flare_height, "flare_height", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "How far up the flare goes; 0 = 2.5 trunk radii."},
    {0},
};

const Table radii_table = {.name = "radii",
                           .doc = "Thickness of trunk, branches and roots.",
                           .example =
                               "objects:\n"
                               "  - name: old\n"
                               "    tree: {radii: {exponent: 2.1, tip: 0.003, flare: 1.2}}\n",
                           .size = sizeof(RadiiParams),
                           .keys = RADII_KEYS};

static const Key LEAVES_KEYS[] = {
    {KEY_OF(LeavesParams, max_count, "max_count", KEY_INT64), .high = 1e9,
     .doc = "Most leaves: when the twigs have room for more, they stand further apart. 0 = a bare "
            "tree."},
    {KEY_OF(LeavesParams, spacing, "spacing", KEY_FLOAT), .low = 1e-4, .high = 100, .unit = "m",
     .doc = "Distance from leaf to leaf along a twig."},
    {KEY_OF(LeavesParams, twig_radius, "twig_radius", KEY_FLOAT), .flags = KEY_ABOVE, .high = 100,
     .unit = "m", .doc = "Only branches thinner than this bear leaves."},
    {KEY_OF(LeavesParams, length, "length", KEY_FLOAT), .flags = KEY_ABOVE, .high = 100,
     .unit = "m", .doc = "Length of a blade."},
    {KEY_OF(LeavesParams, width, "width", KEY_FLOAT), .flags = KEY_ABOVE, .high = 100, .unit = "m",
     .doc = "Width of a blade."},
    {KEY_OF(LeavesParams, size_variation, "size_variation", KEY_FLOAT), .high = 1,
     .doc = "How far sizes differ from leaf to leaf: 0 = all alike."},
    {KEY_OF(LeavesParams, petiole, "petiole", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Length of the stalk."},
    {KEY_OF(LeavesParams, fold, "fold", KEY_FLOAT), .low = -90, .high = 90, .unit = "degrees",
     .doc = "How far the halves are folded up about the midrib."},
    {KEY_OF(LeavesParams, curl, "curl", KEY_FLOAT), .low = -360, .high = 360, .unit = "degrees",
     .doc = "How far the blade bends along its length."},
    {KEY_OF(LeavesParams, lobes, "lobes", KEY_INT), .high = 100,
     .doc = "Lobes a side; 0 = a plain oval."},
    {KEY_OF(LeavesParams, angle, "angle", KEY_FLOAT), .high = 180, .unit = "degrees",
     .doc = "Angle between a leaf and its twig."},
    {KEY_OF(LeavesParams, droop, "droop", KEY_FLOAT), .high = 1,
     .doc = "How far blades turn from the twig's frame toward hanging and facing the light."},
    {KEY_OF(LeavesParams, phyllotaxis, "phyllotaxis", KEY_FLOAT), .low = -360, .high = 360,
     .unit = "degrees", .doc = "Turn about the twig from one leaf to the next; 137.5 in nature."},
    {KEY_OF(LeavesParams, detail, "detail", KEY_INT), .low = 1, .high = 2,
     .doc = "Detail of a leaf's mesh: 1 for whole trees, 2 for close-ups."},
    {KEY_OF(LeavesParams, variants, "variants", KEY_INT), .low = 1, .high = 1000,
     .doc = "How many different blades there are."},
    {0},
};

const Table leaves_table = {
    .name = "leaves",
    .doc = "The leaves (or needles: narrow ones), copies of a few blades along the thin twigs.",
    .example = "objects:\n"
               "  - name: willow\n"
               "    tree: {leaves: {length: 0.09, width: 0.014, lobes: 0, droop: 0.9}}\n",
    .size = sizeof(LeavesParams),
    .keys = LEAVES_KEYS};

static const Key SKIN_KEYS[] = {
    {KEY_OF(SkinningParams, curve_radius, "curve_radius", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Twigs thinner than this are traced as round curves; 0 = everything is mesh."},
    {KEY_OF(SkinningParams, levels, "levels", KEY_INT), .high = 4,
     .doc = "How often the surface is subdivided: each level has four times as many faces."},
    {KEY_OF(SkinningParams, ring_spacing, "ring_spacing", KEY_FLOAT), .low = 0.1, .high = 100,
     .unit = "radii", .doc = "Distance between the rings of the coarse cage that is subdivided."},
    {0},
};

const Table skin_table = {.name = "skin",
                          .doc = "The surface that is put over the branches: mesh where they are "
                                 "thick, round curves where they are thin.",
                          .example = "objects:\n"
                                     "  - name: close\n"
                                     "    tree: {skin: {curve_radius: 0.004, levels: 3}}\n",
                          .size = sizeof(SkinningParams),
                          .keys = SKIN_KEYS};

static const Key TREE_KEYS[] = {
    {KEY_OF(TreeParams, position, "position", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Where the trunk stands."},
    {KEY_OF(TreeParams, height, "height", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1000, .unit = "m",
     .doc = "Height of the whole tree; what is left out elsewhere follows it."},
    {KEY_OF(TreeParams, trunk, "trunk", KEY_GROUP), .table = &TRUNK_TABLE,
     .doc = "The trunk: it grows straight up unless it leans, its growth has a tropism, or a field "
            "winds it."},
    {KEY_OF(TreeParams, crown, "crown", KEY_GROUP), .table = &CROWN_TABLE,
     .doc = "The crown: main branches placed on the trunk, and all that grows from them toward the "
            "attractors in the crown's envelope."},
    {KEY_OF(TreeParams, roots, "roots", KEY_GROUP), .table = &ROOTS_TABLE,
     .doc = "The roots, grown like the crown, but down and outward."},
    {KEY_OF(TreeParams, radii, "radii", KEY_GROUP), .table = &radii_table,
     .doc = "Thickness of trunk, branches and roots."},
    {KEY_OF(TreeParams, leaves, "leaves", KEY_GROUP), .table = &leaves_table,
     .doc = "The leaves (or needles: narrow ones), copies of a few blades along the thin twigs."},
    {KEY_OF(TreeParams, skin, "skin", KEY_GROUP), .table = &skin_table,
     .doc = "The surface that is put over the branches: mesh where they are thick, round curves "
            "where they are thin."},
    {0},
};

static void tree_defaults(void *out)
{
    *(TreeParams *)out = tree_params_default();
}

#define BELOW_HEIGHT " is %g m; it must be below the tree's height, %g m"

static bool check_tree(const Mapping *mapping, void *params)
{
    const TreeParams *tree = params;
    if (tree->crown.base >= tree->height) {
        return mapping_fail(mapping, "crown.base", BELOW_HEIGHT, (double)tree->crown.base,
                            (double)tree->height);
    }
    return tree->trunk.height <= tree->height ||
           mapping_fail(mapping, "trunk.height", BELOW_HEIGHT, (double)tree->trunk.height,
                        (double)tree->height);
}

const Table tree_table = {
    .name = "tree",
    .doc = "A tree: trunk, crown and roots grown as separate elements (Tanaka et al., section "
           "5.1). Everything left out makes an oak. Materials: bark, twig, leaf.",
    .example = "objects:\n"
               "  - name: pine\n"
               "    tree:\n"
               "      height: 9\n"
               "      trunk: {lean: 8, radius: 0.2}\n"
               "      crown: {width: 6, base: 4, branches: 12, branch_angle: 75}\n"
               "      leaves: {length: 0.07, width: 0.004, lobes: 0}\n",
    .size = sizeof(TreeParams),
    .keys = TREE_KEYS,
    .defaults = tree_defaults,
    .check = check_tree};
