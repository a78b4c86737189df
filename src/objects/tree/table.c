// The tree: trunk, crown, roots, radii, leaves, skin.
#include "objects/common/tables.h"
#include "objects/tree/defaults.h"

static const Key TRUNK_KEYS[] = {
    {KEY_OF(TrunkParams, height, "height", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc =
         "Height of the trunk's last node above the ground; 0 = a fraction of the tree's height."},
    {KEY_OF(TrunkParams, radius, "radius", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Radius above the root flare; 0 = computed from the tree's height, by elastic "
            "similarity."},
    {KEY_OF(TrunkParams, lean, "lean", KEY_FLOAT), .high = 89, .unit = "degrees",
     .doc = "Angle between the trunk and the vertical."},
    {KEY_OF(TrunkParams, lean_azimuth, "lean_azimuth", KEY_FLOAT), .low = -360, .high = 360,
     .unit = "degrees", .doc = "Direction of the lean, from +Z toward +X."},
    {KEY_OF(TrunkParams, stems, "stems", KEY_INT), .low = 1, .high = 1000,
     .doc = "Number of stems, which start on a circle about the base; 1 = a single trunk."},
    {KEY_OF(TrunkParams, stem_circle, "stem_circle", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "Radius of the circle of stems; 0 = the trunk's radius."},
    ELEMENT_ROWS(TrunkParams),
    {0},
};

static bool check_trunk(const Mapping *mapping, void *params)
{
    return check_element(mapping, &((const TrunkParams *)params)->element);
}

static const Table TRUNK_TABLE = {
    .name = "trunk",
    .doc =
        "The trunk. It grows straight up unless lean, a tropism of its growth or a field bends it.",
    .size = sizeof(TrunkParams),
    .keys = TRUNK_KEYS,
    .check = check_trunk};

static const Key CROWN_KEYS[] = {
    {KEY_OF(CrownParams, width, "width", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "Width of the crown; 0 = about the tree's height."},
    {KEY_OF(CrownParams, base, "base", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc =
         "Height of the crown's lower end above the ground; 0 = a fraction of the tree's height."},
    {KEY_OF(CrownParams, branches, "branches", KEY_INT), .high = 10000,
     .doc = "Number of main branches placed on the trunk, from the lowest up. If the limbs of two "
            "branches would lie side by side, the weaker one is omitted."},
    {KEY_OF(CrownParams, branch_from, "branch_from", KEY_FLOAT), .high = 1,
     .doc = "Height of the lowest branch, as a fraction of the trunk's height."},
    {KEY_OF(CrownParams, branch_angle, "branch_angle", KEY_FLOAT), .high = 180, .unit = "degrees",
     .doc = "Angle between a branch and the trunk at the branch's base."},
    {KEY_OF(CrownParams, branch_length, "branch_length", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "Length of a branch's first segment; 0 = a fraction of the tree's height."},
    {KEY_OF(CrownParams, lobes, "lobes", KEY_INT), .high = TREE_MOST_LOBES,
     .doc = "Number of bulges of the default envelope, an ellipsoid: they give the uneven outline "
            "of limbs that compete for light; 0 = a plain ellipsoid."},
    ELEMENT_ROWS(CrownParams),
    {0},
};

static bool check_crown(const Mapping *mapping, void *params)
{
    return check_element(mapping, &((const CrownParams *)params)->element);
}

static const Table CROWN_TABLE = {
    .name = "crown",
    .doc = "The crown: main branches on the trunk, and everything that grows from them toward the "
           "attractors in the crown's envelope.",
    .size = sizeof(CrownParams),
    .keys = CROWN_KEYS,
    .check = check_crown};

static const Key ROOTS_KEYS[] = {
    {KEY_OF(RootParams, count, "count", KEY_INT), .high = 10000,
     .doc = "Number of main roots; 0 = none."},
    {KEY_OF(RootParams, spread, "spread", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "Horizontal reach of the roots; 0 = a fraction of the tree's height."},
    {KEY_OF(RootParams, depth, "depth", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "Depth of the roots; 0 = 0.25 of the spread."},
    {KEY_OF(RootParams, radius, "radius", KEY_FLOAT), .flags = KEY_ABOVE, .high = 10,
     .doc =
         "Radius of a main root where it leaves the trunk, as a fraction of the trunk's radius."},
    ELEMENT_ROWS(RootParams),
    {0},
};

static bool check_roots(const Mapping *mapping, void *params)
{
    return check_element(mapping, &((const RootParams *)params)->element);
}

static const Table ROOTS_TABLE = {.name = "roots",
                                  .doc =
                                      "The roots. They grow like the crown, but down and outward.",
                                  .size = sizeof(RootParams),
                                  .keys = ROOTS_KEYS,
                                  .check = check_roots};

static const Key TREE_KEYS[] = {
    {KEY_OF(TreeParams, species, "species", KEY_TEXT),
     .doc =
         "Name of a species of the library, or path of a species file relative to this file: all "
         "keys, materials and targets of that file apply, as far as the scene gives no other. "
         "If it gives another height, lengths of trunk, crown and roots follow. A file "
         "species/NAME.yaml beside the scene comes before the library's."},
    {KEY_OF(TreeParams, position, "position", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Position of the trunk's base."},
    {KEY_OF(TreeParams, height, "height", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1000, .unit = "m",
     .doc = "Height of the whole tree; other sizes that are omitted or 0 follow it."},
    {KEY_OF(TreeParams, seed, "seed", KEY_UINT64), .high = 18446744073709551615.0,
     .doc = "Seed of this tree; 0 = the object's."},
    {KEY_OF(TreeParams, trunk, "trunk", KEY_GROUP), .table = &TRUNK_TABLE,
     .doc = "The trunk. It grows straight up unless lean, a tropism of its growth or a field bends "
            "it."},
    {KEY_OF(TreeParams, crown, "crown", KEY_GROUP), .table = &CROWN_TABLE,
     .doc = "The crown: main branches on the trunk, and everything that grows from them toward the "
            "attractors in the crown's envelope."},
    {KEY_OF(TreeParams, roots, "roots", KEY_GROUP), .table = &ROOTS_TABLE,
     .doc = "The roots. They grow like the crown, but down and outward."},
    {KEY_OF(TreeParams, radii, "radii", KEY_GROUP), .table = &radii_table,
     .doc = "Thickness of trunk, branches and roots."},
    {KEY_OF(TreeParams, leaves, "leaves", KEY_GROUP), .table = &leaves_table,
     .doc = "Leaves, or needles (narrow leaves): copies of a few blades along the thin twigs."},
    {KEY_OF(TreeParams, skin, "skin", KEY_GROUP), .table = &skin_table,
     .doc =
         "Surface of the branches: a mesh where they are thick, round curves where they are thin."},
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
           "5.1). The defaults make an oak. Materials: bark, twig, leaf.",
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
