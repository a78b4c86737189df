// Leaves with their veins.
#include "objects/common/tables.h"
#include "objects/venation/venation.h"

static const Key VENATION_KEYS[] = {
    {KEY_OF(VenationParams, position, "position", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Position of the blade's base."},
    {KEY_OF(VenationParams, rotation, "rotation", KEY_VECTOR), .count = 3, .unit = "degrees",
     .doc = "Rotation about x, then y, then z; without it the leaf stands upright, facing +Z."},
    {KEY_OF(VenationParams, outline.length, "length", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1000,
     .unit = "m", .doc = "Length of the blade."},
    {KEY_OF(VenationParams, outline.width, "width", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "Width of the blade; 0 = half its length."},
    {KEY_OF(VenationParams, outline.widest, "widest", KEY_FLOAT), .low = 0.05, .high = 0.95,
     .doc = "Position of the greatest width, as a fraction of the length from the base."},
    {KEY_OF(VenationParams, outline.tip, "tip", KEY_FLOAT), .low = 0.2, .high = 10,
     .doc = "How pointed base and tip are: 1 = elliptical, 2 = drawn out."},
    {KEY_OF(VenationParams, outline.teeth, "teeth", KEY_INT), .high = 400,
     .doc = "Number of teeth on each side of the margin, to whose points veins lead: about 50 on a "
            "cherry's leaf, 25 on a hazel's; 0 = an entire margin."},
    {KEY_OF(VenationParams, outline.tooth_depth, "tooth_depth", KEY_FLOAT), .high = 1000,
     .unit = "m",
     .doc = "Depth of a tooth; at most 0.3 of the blade's half width. 0 = 0.4 of a "
            "tooth's length."},
    {KEY_OF(VenationParams, outline.tooth_round, "tooth_round", KEY_FLOAT), .high = 1,
     .doc = "From saw teeth that point to the tip, 0, to round scallops, 1."},
    {KEY_OF(VenationParams, outline.double_teeth, "double_teeth", KEY_BOOL),
     .doc = "Three small teeth on each, as birch's and hazel's."},
    {KEY_OF(VenationParams, outline.uneven, "uneven", KEY_FLOAT), .high = 1,
     .doc =
         "How much teeth differ in length and depth, and the two sides of the blade in width (up "
         "to 6 %)."},
    {KEY_OF(VenationParams, closed, "closed", KEY_BOOL),
     .doc = "Veins form loops, as in most leaves; false = they form a tree."},
    {KEY_OF(VenationParams, marginal, "marginal", KEY_BOOL),
     .doc =
         "The blade grows at its margin; false = it grows uniformly and carries its veins along."},
    {KEY_OF(VenationParams, secondaries, "secondaries", KEY_INT), .high = 200,
     .doc = "Number of secondary veins on each half of the young blade, which bend toward the tip "
            "and arch to one another near the margin; 0 = they grow as all finer veins do."},
    {KEY_OF(VenationParams, tertiaries, "tertiaries", KEY_INT), .high = 200,
     .doc =
         "Number of tertiary veins that cross from each secondary vein to the next, as rungs of a "
         "ladder: about 10 on a beech's or hazel's leaf; 0 = they grow as all finer veins do. "
         "Needs secondaries."},
    {KEY_OF(VenationParams, detail, "detail", KEY_INT), .low = 4, .high = 2000,
     .doc = "Number of areoles (meshes of the vein network) along the leaf's length."},
    {KEY_OF(VenationParams, midrib, "midrib", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Radius of the midrib at the base; 0 = 0.008 of the length."},
    {KEY_OF(VenationParams, vein, "vein", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Radius of the finest veins; 0 = 0.06 of an areole."},
    {KEY_OF(VenationParams, embedded, "embedded", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Radius below which veins lie in the blade, as in most broad leaves: lines with little "
            "chlorophyll above and below them, which shine against the light, between areoles that "
            "differ a little. Thicker ones stand out as tubes, the more the thicker they are. At "
            "most 0.95 of the midrib. 0 = all stand out. Needs a blade."},
    {KEY_OF(VenationParams, rows, "rows", KEY_INT), .high = 10000,
     .doc =
         "Rows of the blade's grid along the leaf, which carries its relief and the veins that lie "
         "in it; 0 = 4 to an areole, 6 with embedded veins, from 160 to 1600. A macro needs one "
         "to each pixel or two."},
    {KEY_OF(VenationParams, smoothing, "smoothing", KEY_INT), .high = 1000,
     .doc = "Number of passes that smooth the bends of veins, which then taper without steps; 0 = "
            "straight pieces as they grew."},
    {KEY_OF(VenationParams, veinlets, "veinlets", KEY_FLOAT), .high = 1,
     .doc = "Share of the areoles in which a veinlet ends freely; above 0, other free ends, which "
            "growth leaves by chance, are cleared away. Only of closed veins."},
    {KEY_OF(VenationParams, relief, "relief", KEY_FLOAT), .low = -1000, .high = 1000, .unit = "m",
     .doc =
         "Depth of the furrow in which the midrib lies, seen from the front; lesser veins lie in "
         "lesser ones, so that the blade bulges between them. Below 0 they stand out, as on a "
         "leaf's underside."},
    {KEY_OF(VenationParams, wave, "wave", KEY_FLOAT), .low = -1000, .high = 1000, .unit = "m",
     .doc = "Height of the blade's waves, which grow from the midrib to the margin: furrows along "
            "the secondary veins, and longer waves of the margin."},
    {KEY_OF(VenationParams, hairs, "hairs", KEY_FLOAT), .high = 1, .unit = "m",
     .doc = "Length of the fine hairs along the margin, as on a young beech leaf, in the material "
            "of the veins: 0.001 is natural; 0 = none. Needs a blade."},
    {KEY_OF(VenationParams, vein_hairs, "vein_hairs", KEY_FLOAT), .high = 1, .unit = "m",
     .doc = "Length of the fine hairs on the front of the veins that stand out, as below a hazel's "
            "or lime's leaf, in the material of the veins: 0.0006 is natural; 0 = none. Needs a "
            "blade."},
    {KEY_OF(VenationParams, wear, "wear", KEY_FLOAT), .high = 1,
     .doc = "Traces of insects, with dead rims: up to 16 holes and 3 bites at the margin. Thick "
            "veins are left whole. Needs a blade."},
    {KEY_OF(VenationParams, spots, "spots", KEY_FLOAT), .high = 1,
     .doc = "Age: up to 110 dead spots with yellow halos, patches that turn yellow, and a margin "
            "that dries here and there. Needs a blade."},
    {KEY_OF(VenationParams, autumn, "autumn", KEY_FLOAT), .high = 1,
     .doc = "How far the blade has turned: areole by areole it goes yellow (faded_color of its "
            "material), last along the thick veins, and brown from the margin on: 0 = green, 0.5 = "
            "yellow with green veins, 1 = no green is left. Needs a blade."},
    {KEY_OF(VenationParams, petiole, "petiole", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "Length of the stalk; 0 = none."},
    {KEY_OF(VenationParams, curl, "curl", KEY_FLOAT), .low = -360, .high = 360, .unit = "degrees",
     .doc = "Angle by which the blade bends back along its length."},
    {KEY_OF(VenationParams, fold, "fold", KEY_FLOAT), .low = -80, .high = 80, .unit = "degrees",
     .doc = "Angle by which each half is folded up about the midrib."},
    {KEY_OF(VenationParams, blade, "blade", KEY_BOOL),
     .doc = "Show the blade between the veins; false = a skeleton leaf."},
    {0},
};

static void venation_defaults(void *out)
{
    *(VenationParams *)out = venation_params_default();
}

const Table venation_table = {.name = "venation",
                              .doc = "A single leaf with its network of veins (Runions et al. "
                                     "2005). Materials: leaf, leaf_vein.",
                              .example = "objects:\n"
                                         "  - name: blade\n"
                                         "    venation: {length: 0.12, width: 0.07, detail: 60}\n",
                              .size = sizeof(VenationParams),
                              .keys = VENATION_KEYS,
                              .defaults = venation_defaults};
