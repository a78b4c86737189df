// The tables of radii and skin.
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

static const Key SKIN_KEYS[] = {
    {KEY_OF(SkinningParams, curve_radius, "curve_radius", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Branches thinner than this are rendered as round curves; 0 = everything is a mesh."},
    {KEY_OF(SkinningParams, levels, "levels", KEY_INT), .high = 4,
     .doc = "Number of subdivision levels of the surface; each has four times as many faces."},
    {KEY_OF(SkinningParams, ring_spacing, "ring_spacing", KEY_FLOAT), .low = 0.1, .high = 100,
     .unit = "radii", .doc = "Distance between the rings of the control cage that is subdivided."},
    {KEY_OF(SkinningParams, collar, "collar", KEY_FLOAT), .high = 1,
     .doc =
         "Branch collars: how much thicker a branch is where it leaves its parent, as a share of "
         "its radius."},
    {KEY_OF(SkinningParams, swelling, "swelling", KEY_FLOAT), .high = 1, .unit = "radii",
     .doc = "How far a branch swells where a limb as thick as itself leaves it; less at thinner "
            "ones, and at places where limbs may have been shed. 0 = not at all."},
    {KEY_OF(SkinningParams, fluting, "fluting", KEY_FLOAT), .high = 0.5, .unit = "radii",
     .doc = "How far the strand of wood that runs down from such a limb stands out of the "
            "section, which is uneven between them, too. Bark is wider where the section is "
            "flatter: 0.1 to 0.2 "
            "for trunks close by, 0.4 far away. 0 = round branches."},
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
