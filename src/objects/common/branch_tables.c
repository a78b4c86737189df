// The tables of radii, leaves and skin.
#include "config/table.h"
#include "objects/common/branches.h"

static const EnumName RADIUS_MODELS[] = {{"pipe", RADIUS_PIPE}, {"birth", RADIUS_BIRTH}, {0}};

static const Key RADII_KEYS[] = {
    {KEY_OF(RadiiParams, model, "model", KEY_ENUM), .names = RADIUS_MODELS,
     .doc = "pipe: r_parent^e = sum of r_child^e; birth: thickness increases with age."},
    {KEY_OF(RadiiParams, exponent, "exponent", KEY_FLOAT), .low = 1, .high = 10,
     .doc = "Exponent e of the pipe model: 2 preserves the cross-section area (da Vinci), 3 is "
            "Murray's law."},
    {KEY_OF(RadiiParams, tip, "tip", KEY_FLOAT), .flags = KEY_ABOVE, .high = 10, .unit = "m",
     .doc = "Radius of the tips of twigs; thickness accumulates from there."},
    {KEY_OF(RadiiParams, flare, "flare", KEY_FLOAT), .high = 10,
     .doc = "Root flare: how much wider the trunk is at the ground; 0.5 = 50 % wider."},
    {KEY_OF(RadiiParams, flare_height, "flare_height", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "Height of the root flare; 0 = 2.5 trunk radii."},
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
     .doc = "Maximum number of leaves; if the twigs have room for more, the spacing increases. 0 = "
            "a bare tree."},
    {KEY_OF(LeavesParams, spacing, "spacing", KEY_FLOAT), .low = 1e-4, .high = 100, .unit = "m",
     .doc = "Distance between leaves along a twig."},
    {KEY_OF(LeavesParams, twig_radius, "twig_radius", KEY_FLOAT), .flags = KEY_ABOVE, .high = 100,
     .unit = "m", .doc = "Maximum radius of branches that bear leaves."},
    {KEY_OF(LeavesParams, length, "length", KEY_FLOAT), .flags = KEY_ABOVE, .high = 100,
     .unit = "m", .doc = "Length of a blade."},
    {KEY_OF(LeavesParams, width, "width", KEY_FLOAT), .flags = KEY_ABOVE, .high = 100, .unit = "m",
     .doc = "Width of a blade."},
    {KEY_OF(LeavesParams, size_variation, "size_variation", KEY_FLOAT), .high = 1,
     .doc = "Variation of size between leaves: 0 = all equal."},
    {KEY_OF(LeavesParams, petiole, "petiole", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Length of the stalk."},
    {KEY_OF(LeavesParams, fold, "fold", KEY_FLOAT), .low = -90, .high = 90, .unit = "degrees",
     .doc = "Angle by which each half is folded up about the midrib."},
    {KEY_OF(LeavesParams, curl, "curl", KEY_FLOAT), .low = -360, .high = 360, .unit = "degrees",
     .doc = "Angle by which the blade bends along its length."},
    {KEY_OF(LeavesParams, lobes, "lobes", KEY_INT), .high = 100,
     .doc = "Number of lobes on each side; 0 = a plain oval."},
    {KEY_OF(LeavesParams, angle, "angle", KEY_FLOAT), .high = 180, .unit = "degrees",
     .doc = "Angle between a leaf and its twig."},
    {KEY_OF(LeavesParams, droop, "droop", KEY_FLOAT), .high = 1,
     .doc = "How far blades turn from the twig's frame toward hanging down and facing the light."},
    {KEY_OF(LeavesParams, phyllotaxis, "phyllotaxis", KEY_FLOAT), .low = -360, .high = 360,
     .unit = "degrees",
     .doc = "Divergence angle about the twig from one leaf to the next; 137.5 in nature."},
    {KEY_OF(LeavesParams, detail, "detail", KEY_INT), .low = 1, .high = 2,
     .doc = "Detail of a leaf's mesh: 1 for whole trees, 2 for close-ups."},
    {KEY_OF(LeavesParams, variants, "variants", KEY_INT), .low = 1, .high = 1000,
     .doc = "Number of different blades."},
    {0},
};

const Table leaves_table = {
    .name = "leaves",
    .doc = "Leaves, or needles (narrow leaves): copies of a few blades along the thin twigs.",
    .example = "objects:\n"
               "  - name: willow\n"
               "    tree: {leaves: {length: 0.09, width: 0.014, lobes: 0, droop: 0.9}}\n",
    .size = sizeof(LeavesParams),
    .keys = LEAVES_KEYS};

static const Key SKIN_KEYS[] = {
    {KEY_OF(SkinningParams, curve_radius, "curve_radius", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Branches thinner than this are rendered as round curves; 0 = everything is a mesh."},
    {KEY_OF(SkinningParams, levels, "levels", KEY_INT), .high = 4,
     .doc = "Number of subdivision levels of the surface; each has four times as many faces."},
    {KEY_OF(SkinningParams, ring_spacing, "ring_spacing", KEY_FLOAT), .low = 0.1, .high = 100,
     .unit = "radii", .doc = "Distance between the rings of the control cage that is subdivided."},
    {0},
};

const Table skin_table = {
    .name = "skin",
    .doc =
        "Surface of the branches: a mesh where they are thick, round curves where they are thin.",
    .example = "objects:\n"
               "  - name: close\n"
               "    tree: {skin: {curve_radius: 0.004, levels: 3}}\n",
    .size = sizeof(SkinningParams),
    .keys = SKIN_KEYS};
