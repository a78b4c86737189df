// The table of leaves.
#include "config/load.h"
#include "objects/common/leaves.h"

static const EnumName SHAPES[] = {{"oak", LEAF_OAK},         {"ovate", LEAF_OVATE},
                                  {"obovate", LEAF_OBOVATE}, {"lanceolate", LEAF_LANCEOLATE},
                                  {"linear", LEAF_LINEAR},   {"cordate", LEAF_CORDATE},
                                  {"rhombic", LEAF_RHOMBIC}, {"palmate", LEAF_PALMATE},
                                  {"fan", LEAF_FAN},         {"pad", LEAF_PAD},
                                  {"needles", LEAF_NEEDLES}, {"tuft", LEAF_TUFT},
                                  {"scales", LEAF_SCALES},   {0}};
static const EnumName COMPOUNDS[] = {{"none", COMPOUND_NONE},
                                     {"pinnate", COMPOUND_PINNATE},
                                     {"bipinnate", COMPOUND_BIPINNATE},
                                     {"palmate", COMPOUND_PALMATE},
                                     {0}};
static const EnumName ARRANGEMENTS[] = {
    {"spiral", ARRANGE_SPIRAL},         {"alternate", ARRANGE_ALTERNATE},
    {"distichous", ARRANGE_DISTICHOUS}, {"opposite", ARRANGE_OPPOSITE},
    {"whorled", ARRANGE_WHORLED},       {"spurs", ARRANGE_SPURS},
    {"rosette", ARRANGE_ROSETTE},       {0}};

static const Key LEAVES_KEYS[] = {
    {KEY_OF(LeavesParams, max_count, "max_count", KEY_INT64), .high = 1e9,
     .doc = "Maximum number of leaves, or of pieces with needles; if the twigs have room for more, "
            "the spacing increases. 0 = a bare tree."},
    {KEY_OF(LeavesParams, spacing, "spacing", KEY_FLOAT), .low = 1e-4, .high = 100, .unit = "m",
     .doc = "Distance between leaves, pairs, whorls or short shoots along a twig; of needles the "
            "length of twig that one instance covers."},
    {KEY_OF(LeavesParams, twig_radius, "twig_radius", KEY_FLOAT), .flags = KEY_ABOVE, .high = 100,
     .unit = "m", .doc = "Maximum radius of branches that bear leaves."},
    {KEY_OF(LeavesParams, arrangement, "arrangement", KEY_ENUM), .names = ARRANGEMENTS,
     .doc = "Places on the twig. spiral: one leaf at a time, turned by phyllotaxis; alternate: by "
            "144 degrees; distichous: in two rows, left and right (beech, lime, hazel); opposite: "
            "in pairs that cross (maple, ash); whorled: per_node at a time; spurs: per_node on "
            "each short shoot (ginkgo, apple); rosette: per_node around the ends of twigs or "
            "trunks alone (palms, tree ferns)."},
    {KEY_OF(LeavesParams, per_node, "per_node", KEY_INT), .high = 1000,
     .doc = "Leaves of each whorl, short shoot or rosette; 0 = 3, 5 or 40."},
    {KEY_OF(LeavesParams, withered, "withered", KEY_INT), .high = 1000,
     .doc = "Dead leaves of a rosette, in their material's autumn_color, that hang below the "
            "living ones about the trunk, as a palm's skirt; 0 = none."},
    {KEY_OF(LeavesParams, phyllotaxis, "phyllotaxis", KEY_FLOAT), .low = -360, .high = 360,
     .unit = "degrees",
     .doc = "Arrangement spiral: divergence angle about the twig from one leaf to the next; 137.5 "
            "in nature."},
    {KEY_OF(LeavesParams, crowding, "crowding", KEY_FLOAT), .high = 0.95,
     .doc = "How much closer the last five leaves of a twig stand, as an oak's or a cherry's: 0 = "
            "evenly spaced."},
    {KEY_OF(LeavesParams, tip_leaves, "tip_leaves", KEY_INT), .high = 1000,
     .doc = "Number of places at a twig's end whose leaves are smaller and closer toward it, as a "
            "fern's pinnules: of 9 the last leaf has 1/10 of the size, the one before it 2/10. Not "
            "of needles on the twig itself. 0 = all have the same size."},
    {KEY_OF(LeavesParams, base_leaves, "base_leaves", KEY_INT), .high = 1000,
     .doc = "Number of places at the lower end of a twig's leafy part whose leaves are smaller "
            "toward it, as a lady fern's pinnae: the lowest has a third of the size. Not of "
            "needles on the twig itself. 0 = all have the same size."},
    {KEY_OF(LeavesParams, foot, "foot", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Length of a twig's leafy part, from its lower end, that bears leaves, as a bluebell's "
            "stem does at the ground alone. Not of a rosette. 0 = all of it."},
    {KEY_OF(LeavesParams, angle, "angle", KEY_FLOAT), .high = 180, .unit = "degrees",
     .doc = "Angle between a leaf and its twig; of a rosette that of its lowest leaves."},
    {KEY_OF(LeavesParams, droop, "droop", KEY_FLOAT), .high = 1,
     .doc = "How far blades turn from the twig's frame toward hanging down and facing the light."},
    {KEY_OF(LeavesParams, hang, "hang", KEY_FLOAT), .high = 1,
     .doc = "How far leaves hang straight down from their stalk, as eucalyptus' and weeping "
            "willow's."},
    {KEY_OF(LeavesParams, plane, "plane", KEY_FLOAT), .high = 1,
     .doc = "How far leaves turn into one level spray with their twig, as beech's, or those of a "
            "rosette into a level plane, as water lilies': upper sides up."},
    {KEY_OF(LeavesParams, shape, "shape", KEY_ENUM), .names = SHAPES,
     .doc =
         "Outline of a blade or leaflet. oak: rounded lobes; ovate: egg-shaped (beech, cherry, "
         "hazel); obovate: widest above the middle (alder, horse chestnut's leaflets); lanceolate: "
         "narrow (willow, olive, eucalyptus); linear: parallel sides (bamboo, palms' leaflets); "
         "cordate: heart (lime); rhombic: with corners (birch, poplar); palmate: lobed (maple, "
         "plane, ivy); fan: ginkgo; pad: nearly round about the stalk's end, with a notch (water "
         "lily); needles: a piece of twig with needles (spruce, fir, pine); "
         "tuft: a rosette of needles (larch, cedar); scales: a spray of scaly twiglets (cypress)."},
    {KEY_OF(LeavesParams, length, "length", KEY_FLOAT), .flags = KEY_ABOVE, .high = 100,
     .unit = "m", .doc = "Length of a blade, of a whole compound leaf, of a needle or twiglet."},
    {KEY_OF(LeavesParams, width, "width", KEY_FLOAT), .flags = KEY_ABOVE, .high = 100, .unit = "m",
     .doc = "Width of a blade, of a whole compound leaf, of a needle or twiglet."},
    {KEY_OF(LeavesParams, size_variation, "size_variation", KEY_FLOAT), .high = 1,
     .doc = "Variation of size between leaves: 0 = all equal."},
    {KEY_OF(LeavesParams, petiole, "petiole", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Length of the stalk."},
    {KEY_OF(LeavesParams, nod, "nod", KEY_FLOAT), .high = 150, .unit = "degrees",
     .doc = "Angle by which the blade bends down from the direction of its stalk, as maples' and "
            "horse chestnut's."},
    {KEY_OF(LeavesParams, fold, "fold", KEY_FLOAT), .low = -90, .high = 90, .unit = "degrees",
     .doc = "Angle by which each half is folded up about the midrib."},
    {KEY_OF(LeavesParams, curl, "curl", KEY_FLOAT), .low = -360, .high = 360, .unit = "degrees",
     .doc = "Angle by which the blade, or the rachis of a compound leaf or frond, bends along its "
            "length; by which a pad's rim bends up in some places."},
    {KEY_OF(LeavesParams, wave, "wave", KEY_FLOAT), .high = 1,
     .doc = "Ripple of the edge, as a fraction of the width."},
    {KEY_OF(LeavesParams, widest, "widest", KEY_FLOAT), .high = 0.95,
     .doc = "Where an undivided blade is widest, 0 to 1 from its base; 0 = the shape's own."},
    {KEY_OF(LeavesParams, tip, "tip", KEY_FLOAT), .high = 1,
     .doc = "Form of the tip: near 0 = rounded, 0.5 = pointed, 1 = drawn out; 0 = the shape's "
            "own."},
    {KEY_OF(LeavesParams, sickle, "sickle", KEY_FLOAT), .low = -180, .high = 180, .unit = "degrees",
     .doc =
         "Angle by which an undivided blade bends to one side along its length, as eucalyptus'."},
    {KEY_OF(LeavesParams, lobes, "lobes", KEY_INT), .high = 100,
     .doc = "Number of lobes: of an oak on each side, 0 = a plain oval; of a palmate leaf in all, "
            "an odd number of 3 to 15."},
    {KEY_OF(LeavesParams, lobe_depth, "lobe_depth", KEY_FLOAT), .high = 0.95,
     .doc = "Depth of the bays between lobes, as a fraction of an oak's half width or of a palmate "
            "lobe's length."},
    {KEY_OF(LeavesParams, teeth, "teeth", KEY_INT), .high = 80,
     .doc = "Number of teeth on each side of a blade or lobe, at detail 2; 0 = a smooth edge."},
    {KEY_OF(LeavesParams, tooth_depth, "tooth_depth", KEY_FLOAT), .high = 0.5,
     .doc = "Depth of the teeth, as a fraction of the width; of a palmate leaf, of its length; 0 = "
            "0.05."},
    {KEY_OF(LeavesParams, double_teeth, "double_teeth", KEY_BOOL),
     .doc = "Three small teeth on each, as birch's and hazel's."},
    {KEY_OF(LeavesParams, wear, "wear", KEY_FLOAT), .high = 1,
     .doc = "Bites and holes, more in some of the variants, at detail 2: 0 = none."},
    {KEY_OF(LeavesParams, compound, "compound", KEY_ENUM), .names = COMPOUNDS,
     .doc = "Leaflets in place of one blade. pinnate: in two rows (ash, rowan, date palm); "
            "bipinnate: pinnate leaves in two rows (acacia, tree fern); palmate: from the end of "
            "the stalk (horse chestnut, bramble)."},
    {KEY_OF(LeavesParams, leaflets, "leaflets", KEY_INT), .high = 1000,
     .doc = "Number of leaflets, or of a bipinnate leaf's parts; if odd, one is at the end. 0 = 9, "
            "12 or 5."},
    {KEY_OF(LeavesParams, leaflets_of_part, "leaflets_of_part", KEY_INT), .high = 200,
     .doc = "Number of leaflets of each part of a bipinnate leaf; 0 = 20."},
    {KEY_OF(LeavesParams, leaflet_width, "leaflet_width", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Width of a leaflet, or of a bipinnate leaf's part; 0 = a fraction of its length. Its "
            "length follows from the leaf's width; of a palmate leaf it is the leaf's."},
    {KEY_OF(LeavesParams, taper, "taper", KEY_FLOAT), .high = 1,
     .doc = "How much shorter leaflets are toward the tip of a pinnate leaf: 0 = equal."},
    {KEY_OF(LeavesParams, needles, "needles", KEY_FLOAT), .high = 1000,
     .doc = "Shape needles: number per centimetre of twig; tuft: of a rosette; scales: twiglets of "
            "a spray. 0 = 16, 30, 16."},
    {KEY_OF(LeavesParams, bundle, "bundle", KEY_INT), .high = 10,
     .doc = "Needles that stand together: 2 of Scots pine, 3 or 5 of other pines; 0 = single."},
    {KEY_OF(LeavesParams, side_shoots, "side_shoots", KEY_INT), .high = 200,
     .doc = "Shape needles: side shoots of a branchlet, which is one instance with all its needles "
            "and stands on the twig as a leaf does; 0 = needles on the twig itself."},
    {KEY_OF(LeavesParams, shoot, "shoot", KEY_FLOAT), .high = 100, .unit = "m",
     .doc =
         "Shape needles: length of the piece with needles, or of a branchlet; tuft: of the short "
         "shoot; scales: of the spray. 0 = the spacing or 0.3, 0.005, 3 twiglets' lengths."},
    {KEY_OF(LeavesParams, needle_angle, "needle_angle", KEY_FLOAT), .high = 150, .unit = "degrees",
     .doc = "Angle between needles or twiglets and their shoot; 0 = the shape's own."},
    {KEY_OF(LeavesParams, comb, "comb", KEY_FLOAT), .high = 1,
     .doc = "How far needles or twiglets are parted to two sides, as a fir's: 0 = all round."},
    {KEY_OF(LeavesParams, flush, "flush", KEY_FLOAT), .high = 1,
     .doc =
         "Share of every shoot, at its tip, that grew this year: its needles or leaves are paler "
         "and let more light through; leaves are smaller toward the tip, and some shoots have "
         "grown more than others. 0 = all are of one age. Not of shapes tuft and scales."},
    {KEY_OF(LeavesParams, emergence, "emergence", KEY_FLOAT), .high = 1,
     .doc = "Spring: 0 = closed buds, without leaves; between, small, folded and pale leaves; 1 = "
            "full-grown."},
    {KEY_OF(LeavesParams, autumn, "autumn", KEY_FLOAT), .high = 1,
     .doc = "Share of the leaves that have turned to their material's autumn_color, one by one "
            "from the crown's top and outside inward."},
    {KEY_OF(LeavesParams, fall, "fall", KEY_FLOAT), .high = 1,
     .doc = "Share of the leaves that are shed, in the same order."},
    {KEY_OF(LeavesParams, litter, "litter", KEY_FLOAT), .high = 1,
     .doc = "Share of the shed leaves that lie on the ground around the tree."},
    {KEY_OF(LeavesParams, detail, "detail", KEY_INT), .low = 1, .high = 3,
     .doc = "Detail of a leaf's mesh: 1 for whole trees, 2 with teeth for close-ups, 3 with smooth "
            "margins of undivided blades from a few centimetres."},
    {KEY_OF(LeavesParams, variants, "variants", KEY_INT), .low = 1, .high = 1000,
     .doc = "Number of different blades."},
    {0},
};

static bool check_leaves(const Mapping *mapping, void *params)
{
    const LeavesParams *leaves = params;
    if (leaves->shape == LEAF_PALMATE && leaves->lobes > 15) {
        return mapping_fail(mapping, "lobes", " is %d; a palmate leaf has at most 15 lobes",
                            leaves->lobes);
    }
    return true;
}

const Table leaves_table = {
    .name = "leaves",
    .doc = "Leaves: copies of a few blades, compound leaves or pieces of twig with needles along "
           "the thin twigs.",
    .example = "objects:\n"
               "  - name: willow\n"
               "    tree: {leaves: {shape: lanceolate, length: 0.09, width: 0.014, hang: 0.8}}\n"
               "  - name: ash\n"
               "    tree:\n"
               "      position: [20, 0, 0]\n"
               "      leaves: {shape: ovate, compound: pinnate, leaflets: 11, length: 0.28, "
               "width: 0.17, arrangement: opposite, spacing: 0.05}\n",
    .size = sizeof(LeavesParams),
    .keys = LEAVES_KEYS,
    .check = check_leaves};
