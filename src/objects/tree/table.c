// The tree: trunk, crown, roots, radii, leaves, skin.
#include "objects/common/tables.h"
#include "objects/tree/defaults.h"

static const Key TRUNK_KEYS[] = {
    {KEY_OF(TrunkParams, height, "height", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc =
         "Height of the trunk's last node above the ground; 0 = a fraction of the tree's height."},
    {KEY_OF(TrunkParams, radius, "radius", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Radius above the root flare; 0 = computed from the tree's height and slenderness, by "
            "elastic similarity."},
    {KEY_OF(TrunkParams, slenderness, "slenderness", KEY_FLOAT), .high = 1000,
     .doc = "Height of the tree / diameter of its trunk, when it is grown up (see light); younger "
            "trees are more slender. About 25 for an old oak in a field, 50 for a poplar, 80 for a "
            "birch in a wood. 0 = 25 for trees grown by light, 17 for others."},
    {KEY_OF(TrunkParams, lean, "lean", KEY_FLOAT), .high = 89, .unit = "degrees",
     .doc = "Angle between the trunk and the vertical."},
    {KEY_OF(TrunkParams, lean_azimuth, "lean_azimuth", KEY_FLOAT), .low = -360, .high = 360,
     .unit = "degrees", .doc = "Direction of the lean, from +Z toward +X."},
    {KEY_OF(TrunkParams, stems, "stems", KEY_INT), .low = 1, .high = 1000,
     .doc = "Number of stems, which start on a circle about the base; 1 = a single trunk."},
    {KEY_OF(TrunkParams, stem_circle, "stem_circle", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "Radius of the circle of stems; 0 = the trunk's radius."},
    {KEY_OF(TrunkParams, stem_scatter, "stem_scatter", KEY_FLOAT), .high = 1,
     .doc = "How far stems leave the circle for its inside: 0 = a ring, 1 = a thicket."},
    {KEY_OF(TrunkParams, splay, "splay", KEY_FLOAT), .high = 89, .unit = "degrees",
     .doc = "Angle by which several stems of a tree grown by light lean away from their middle at "
            "the foot, as of hazel; less inside the circle."},
    {KEY_OF(TrunkParams, ribs, "ribs", KEY_INT), .high = 60,
     .doc = "Number of ribs along trunk and branches, as of a columnar cactus; 0 = round."},
    {KEY_OF(TrunkParams, rib_depth, "rib_depth", KEY_FLOAT), .high = 0.5, .unit = "radii",
     .doc = "Depth of the grooves between the ribs."},
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

#define REACH_KEY(MEMBER, KEY, TYPE) KEY_OF(ReachParams, MEMBER, KEY, TYPE)

static const Key REACH_KEYS[] = {
    {REACH_KEY(count, "count", KEY_INT64), .high = 2147483647,
     .doc = "Number of attractors; 0 = none."},
    {REACH_KEY(element.shapes, "envelope", KEY_LIST),
     .count_offset = offsetof(ReachParams, element.shape_count), .count = 1000,
     .table = &shape_table,
     .doc = "Region that they lie in: shapes, combined in this order. It does not bound growth. "
            "Default: the crown's envelope, which does if it is given."},
    {REACH_KEY(element.voxel, "voxel", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Voxel size of that envelope's level set; 0 = 1/128 of its largest extent."},
    {REACH_KEY(element, "points", KEY_GROUP), .table = &points_table,
     .doc = "How they are scattered in it."},
    {REACH_KEY(weight, "weight", KEY_FLOAT), .high = 0.99,
     .doc = "Share of its light that a bud loses where growth is made of it, if no attractor draws "
            "it: 0 = light alone decides, 0.5 = the crown tends to where attractors are, 0.9 = it "
            "keeps to them. Before the first bud is drawn, light alone decides."},
    {REACH_KEY(pull, "pull", KEY_FLOAT), .high = 10,
     .doc = "Turn of each new node of a shoot toward the attractors that draw its bud."},
    {REACH_KEY(reach, "reach", KEY_FLOAT), .flags = KEY_ABOVE, .high = 100, .unit = "internodes",
     .doc = "Each attractor draws the nearest bud within this distance."},
    {REACH_KEY(occupied, "occupied", KEY_FLOAT), .high = 100, .unit = "internodes",
     .doc = "An attractor is taken when wood comes nearer to it than this."},
    {0},
};

static bool check_reach(const Mapping *mapping, void *params)
{
    const ReachParams *given = params;
    if (given->occupied > given->reach) {
        return mapping_fail(mapping, "occupied",
                            " is %g; it must be at most reach, %g internodes, or attractors are "
                            "taken before they draw a bud",
                            (double)given->occupied, (double)given->reach);
    }
    return check_element(mapping, &given->element);
}

static const Table REACH_TABLE = {
    .name = "light_attractors",
    .doc = "Attractors that buds reach for beside light: the artist gives the form, light fills "
           "it. Each draws the nearest bud, and the light of buds that none draws counts less. "
           "With grown_by: both, limbs that attractors laid "
           "are filled in the same way.",
    .example = "objects:\n"
               "  - name: windswept\n"
               "    tree:\n"
               "      light:\n"
               "        attractors:\n"
               "          count: 3000\n"
               "          envelope: [{shape: ellipsoid, size: [5, 3, 4], position: [3, 8, 0]}]\n",
    .size = sizeof(ReachParams),
    .keys = REACH_KEYS,
    .check = check_reach};

#define LIGHT_KEY(MEMBER, KEY, TYPE) KEY_OF(TreeLight, MEMBER, KEY, TYPE)

static const Key LIGHT_KEYS[] = {
    {LIGHT_KEY(mature_height, "mature_height", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1000,
     .unit = "m", .doc = "Height at which the species is grown up."},
    {LIGHT_KEY(mature_age, "mature_age", KEY_FLOAT), .flags = KEY_ABOVE, .high = 10000,
     .unit = "years", .doc = "Age at which it is."},
    {LIGHT_KEY(attractors, "attractors", KEY_GROUP), .table = &REACH_TABLE,
     .doc = "Attractors that buds reach for beside light."},
    {LIGHT_KEY(growth.seasons, "seasons", KEY_INT), .low = 1, .high = 1000,
     .doc = "Number of simulated seasons in which it grows up; more = finer twigs and more of "
            "them. A younger tree grows fewer."},
    {LIGHT_KEY(growth.apical_control, "apical_control", KEY_VECTOR), .count = 2, .high = 1,
     .doc = "How far an axis prevails over its side branches, when young and when old: above 0.55 "
            "a leader runs to the top, below 0.48 the crown spreads from a short trunk. Steps of "
            "0.01 matter."},
    {LIGHT_KEY(growth.maturing, "maturing", KEY_VECTOR), .count = 2, .high = 10,
     .doc = "When apical_control turns from young to old: begin and end, as fractions of the "
            "seasons."},
    {LIGHT_KEY(growth.vigor, "vigor", KEY_FLOAT), .high = 100,
     .doc = "How much growth light makes: nodes for the light of one node in the open."},
    {LIGHT_KEY(growth.shoot, "shoot", KEY_VECTOR), .flags = KEY_SPLAT, .count = 3, .low = 1,
     .high = 100,
     .doc = "Most nodes of a season's shoot: of the trunk, of limbs, of the branches on them. "
            "Shorter on the limbs than on the trunk makes a narrow crown, as of conifers."},
    {LIGHT_KEY(growth.shade, "shade", KEY_FLOAT), .high = 100,
     .doc = "How much shade a node's leaves cast: their area across the light, in internodes "
            "squared. 0.2 = a light crown like a birch's, 1 = a dense one like a beech's."},
    {LIGHT_KEY(growth.leaf_seasons, "leaf_seasons", KEY_INT), .low = 1, .high = 100,
     .doc = "Number of simulated seasons in which a shoot bears leaves and its side buds live."},
    {LIGHT_KEY(growth.light_need, "light_need", KEY_FLOAT), .high = 1,
     .doc = "A branch dies when its leaves get less than this fraction of the light in the open: "
            "0.1 for trees that bear shade, 0.3 for those that need light."},
    {LIGHT_KEY(growth.upkeep, "upkeep", KEY_FLOAT), .high = 10,
     .doc =
         "What a node without leaves counts in light_need beside one with leaves, as its wood "
         "must be kept alive: 0 = nothing; 0.3 to 1 = old limbs die in half shade, so that trees "
         "of a closed stand lose them high up."},
    {LIGHT_KEY(growth.branch_angle, "branch_angle", KEY_VECTOR), .flags = KEY_SPLAT, .count = 3,
     .high = 150, .unit = "degrees",
     .doc = "Angle between a branch and its axis at the base: of limbs on the trunk, of branches "
            "on limbs, of twigs."},
    {LIGHT_KEY(growth.angle_spread, "angle_spread", KEY_FLOAT), .high = 90, .unit = "degrees",
     .doc = "Standard deviation of these angles."},
    {LIGHT_KEY(growth.phyllotaxis, "phyllotaxis", KEY_FLOAT), .low = -360, .high = 360,
     .unit = "degrees",
     .doc = "Divergence angle about the axis from one node's buds to the next: 137.5 spiral, 180 "
            "two-ranked, 90 crosswise pairs (with buds: 2)."},
    {LIGHT_KEY(growth.buds, "buds", KEY_INT), .low = 1, .high = 8,
     .doc = "Side buds at a node: 1 alternate, 2 opposite, more whorled."},
    {LIGHT_KEY(growth.whorl, "whorl", KEY_INT), .high = 16,
     .doc = "Branches stand in whorls at the end of each season's shoot, as in spruce and pine, "
            "at most so many on the trunk; 0 = side buds at every node."},
    {LIGHT_KEY(growth.between, "between", KEY_FLOAT), .high = 1,
     .doc = "Chance of a single branch at a node between whorls: 0 = bare shoots between tiers, "
            "as in many pines; 0.2 to 0.4 = tiers that merge, as in spruce."},
    {LIGHT_KEY(growth.tropism, "tropism", KEY_VECTOR), .count = 3, .low = -10, .high = 10,
     .doc = "Turn of each new node along crown.growth.tropism, which points up: of the trunk, of "
            "limbs, of the branches on them. Negative: they hang."},
    {LIGHT_KEY(growth.phototropism, "phototropism", KEY_FLOAT), .low = -10, .high = 10,
     .doc = "Turn of each new node toward the brightest part of the sky."},
    {LIGHT_KEY(growth.zigzag, "zigzag", KEY_FLOAT), .high = 90, .unit = "degrees",
     .doc = "Angle by which a season's shoot turns aside from the last, as a side bud takes the "
            "lead; half of it on the trunk."},
    {LIGHT_KEY(growth.leader_loss, "leader_loss", KEY_VECTOR), .flags = KEY_SPLAT, .count = 3,
     .high = 1,
     .doc =
         "Chance that an axis loses its end bud in a season, so that a side bud leads on and the "
         "axis makes an elbow: of the trunk, of limbs, of the branches on them. 0 = straight "
         "limbs as of poplar and spruce, 0.3 = crooked ones as of oak and olive."},
    {LIGHT_KEY(growth.unevenness, "unevenness", KEY_FLOAT), .high = 1,
     .doc = "How much the vigor of branches differs, as the standard deviation of its logarithm: 0 "
            "= an even outline; 0.1 to 0.2 = some limbs outgrow others, with gaps between clumps, "
            "and every seed has a form of its own."},
    {LIGHT_KEY(growth.noise, "noise", KEY_FLOAT), .high = 10,
     .doc = "Gaussian noise added to each component of the direction of a season's shoot."},
    {LIGHT_KEY(growth.plagiotropy, "plagiotropy", KEY_FLOAT), .high = 1,
     .doc = "How far branches spread in a level plane, with two-ranked twigs: 0 = all around, 1 = "
            "flat sprays, as of spruce and beech."},
    {LIGHT_KEY(growth.bole, "bole", KEY_FLOAT), .high = 1,
     .doc = "Height below which the trunk loses its branches, as a fraction of the tree's height; "
            "crown.base, if given, replaces it."},
    {LIGHT_KEY(healing, "healing", KEY_INT), .high = 1000, .unit = "seasons",
     .doc =
         "Simulated seasons after which the stub of a shed branch has fallen and its place been "
         "overgrown: a ring of callus about dead wood, where a limb really was. 0 = stubs stay."},
    {LIGHT_KEY(growth.snags, "snags", KEY_FLOAT), .high = 1,
     .doc = "Length of the dead stub that a shed branch leaves, as a fraction of the branch's "
            "length; thick branches leave short stubs. 0 = none."},
    {0},
};

static const Table LIGHT_TABLE = {
    .name = "light",
    .doc = "How a tree grows by light (Palubicki et al. 2009). In each season the sky's light on "
           "the leaves is found on a voxel grid, with the shade of the tree, of obstacles and of "
           "rivals; branches that get too little die; the light is summed down to the base and "
           "comes back as growth, shared at every fork by apical control; buds that get enough "
           "make shoots. Lengths follow from the tree's height. The defaults make an oak.",
    .example = "objects:\n"
               "  - name: spruce\n"
               "    tree:\n"
               "      height: 20\n"
               "      light: {apical_control: [0.62, 0.6], whorl: 5, branch_angle: [85, 50, 45], "
               "plagiotropy: 0.9}\n",
    .size = sizeof(TreeLight),
    .keys = LIGHT_KEYS};

static const Key VETERAN_KEYS[] = {
    {KEY_OF(VeteranParams, dead_limbs, "dead_limbs", KEY_FLOAT), .high = 0.9,
     .doc = "Share of the limbs' wood that is dead in a tree of twice its light.mature_age, the "
            "highest limbs first: bare, grey, without bark and twigs. Less in younger trees; none "
            "up to that age."},
    {KEY_OF(VeteranParams, mistletoe, "mistletoe", KEY_INT), .high = 10000,
     .doc = "Number of balls of mistletoe in the crown of a grown-up tree; fewer in a younger one, "
            "none below 0.3 of light.mature_age."},
    {KEY_OF(VeteranParams, moss, "moss", KEY_INT), .high = 1000000,
     .doc = "Number of tufts of moss on trunk and roots at the foot, most on what faces up or away "
            "from the sun (-z)."},
    {0},
};

static const Table VETERAN_TABLE = {
    .name = "veteran",
    .doc = "What the years leave on a tree that is grown by light. Material of bark has moss, "
           "lichen, hollows and ribs.",
    .example = "objects:\n"
               "  - name: old_oak\n"
               "    tree: {species: pedunculate_oak, age: 350, veteran: {dead_limbs: 0.3, moss: "
               "3000}}\n",
    .size = sizeof(VeteranParams),
    .keys = VETERAN_KEYS};

#define HAZARD_KEY(MEMBER, KEY) KEY_OF(HazardParams, MEMBER, KEY, KEY_FLOAT)

static const Key HAZARD_KEYS[] = {
    {HAZARD_KEY(width, "width"), .high = 1,
     .doc = "How much the width of crowns differs from tree to tree: standard deviation of its "
            "natural logarithm; half as much from limb to limb. 0.2 = slender and stout ones."},
    {HAZARD_KEY(angle, "angle"), .high = 45, .unit = "degrees",
     .doc = "How much limbs hang or rise more than they grew: standard deviation, half of it from "
            "tree to tree and half from limb to limb; less near the top."},
    {HAZARD_KEY(loosening, "loosening"), .high = 1,
     .doc =
         "How far limbs leave the whorl that they grew in: 1 = anywhere down to the whorl below, "
         "so that a conifer's crown has no tiers."},
    {HAZARD_KEY(crowding, "crowding"), .high = 1,
     .doc = "How far neighbours, up to three of any height on sides of their own, hold limbs back "
            "beside them: each leaves at least 1 - crowding of their length. Low limbs that are "
            "left less than 0.3 of it are dead. One tree in five has no neighbour."},
    {HAZARD_KEY(bare_below, "bare_below"), .high = 1,
     .doc = "Greatest height, as a fraction of the tree's, below which shade has killed all limbs: "
            "each tree has its own, from 0 to this."},
    {HAZARD_KEY(lost_limbs, "lost_limbs"), .high = 0.9,
     .doc = "Mean share of the limbs that died and broke, in patches of height and side; a tree "
            "has lost from none to twice as many."},
    {HAZARD_KEY(forked_top, "forked_top"), .high = 1,
     .doc = "Chance that the leader was lost and two rose in its place."},
    {HAZARD_KEY(dead_top, "dead_top"), .high = 1,
     .doc = "Chance that the top is dead, if it is not forked."},
    {HAZARD_KEY(dead, "dead"), .high = 1,
     .doc = "Chance that the whole tree is dead: a trunk with what is left of its limbs."},
    {0},
};

static const Table HAZARD_TABLE = {
    .name = "hazards",
    .doc = "What befalls a tree that is grown by light, after its growth: by its seed, each "
           "individual has a fortune of its own, so that a wood of few variants is not made of one "
           "stamp. Chances and means are over all individuals.",
    .example = "objects:\n"
               "  - name: wood\n"
               "    scatter:\n"
               "      count: 200\n"
               "      radius: 60\n"
               "      variants: 8\n"
               "      things:\n"
               "        - tree: {species: norway_spruce, hazards: {width: 0.2, crowding: 0.7, "
               "lost_limbs: 0.15, dead_top: 0.1}}\n",
    .size = sizeof(HazardParams),
    .keys = HAZARD_KEYS};

static const EnumName GROWN_BY_NAMES[] = {{"auto", GROWN_BY_AUTO},
                                          {"light", GROWN_BY_LIGHT},
                                          {"attractors", GROWN_BY_ATTRACTORS},
                                          {"both", GROWN_BY_BOTH},
                                          {0}};

static const Key TREE_KEYS[] = {
    {KEY_OF(TreeParams, species, "species", KEY_TEXT),
     .doc =
         "Name of a species of the library, or path of a species file relative to this file: all "
         "keys, materials and targets of that file apply, as far as the scene gives no other. "
         "If it gives another height, lengths of trunk, crown, roots and light.attractors follow; "
         "envelopes of the "
         "species lie about the position of the tree. A file "
         "species/NAME.yaml beside the scene comes before the library's."},
    {KEY_OF(TreeParams, position, "position", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Position of the trunk's base."},
    {KEY_OF(TreeParams, height, "height", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "Height of the whole tree; other sizes that are omitted or 0 follow it. 0 = as its age "
            "implies, or light.mature_height."},
    {KEY_OF(TreeParams, age, "age", KEY_FLOAT), .high = 10000, .unit = "years",
     .doc = "Age of a tree that is grown by light: from a sapling through light.mature_age to a "
            "veteran, whose trunk goes on growing thicker. 0 = as its height implies: a tree below "
            "light.mature_height is young. With both, a tree of that age in that height."},
    {KEY_OF(TreeParams, grown_by, "grown_by", KEY_ENUM), .names = GROWN_BY_NAMES,
     .doc = "light: season by season, by the light that its buds get; attractors: trunk, then "
            "crown toward attractors in their envelopes; both: attractors lay trunk and limbs, "
            "which light fills within the crown's envelope; auto: attractors if "
            "crown.growth.levels are given, otherwise light."},
    {KEY_OF(TreeParams, light, "light", KEY_GROUP), .table = &LIGHT_TABLE,
     .doc = "Growth by light: what makes a species' habit."},
    {KEY_OF(TreeParams, seed, "seed", KEY_UINT64), .high = 18446744073709551615.0,
     .doc = "Seed of this tree; 0 = the object's."},
    PHENOLOGY_ROWS(TreeParams),
    {KEY_OF(TreeParams, snow, "snow", KEY_GROUP), .table = &snow_table,
     .doc = "Snow that has settled on the branches."},
    {KEY_OF(TreeParams, hoar, "hoar", KEY_GROUP), .table = &hoar_table,
     .doc = "Hoar frost on twigs and branches."},
    {KEY_OF(TreeParams, veteran, "veteran", KEY_GROUP), .table = &VETERAN_TABLE,
     .doc = "Dead limbs, mistletoe, moss."},
    {KEY_OF(TreeParams, hazards, "hazards", KEY_GROUP), .table = &HAZARD_TABLE,
     .doc = "What befalls each tree in its life, by its seed."},
    {KEY_OF(TreeParams, trunk, "trunk", KEY_GROUP), .table = &TRUNK_TABLE,
     .doc = "The trunk. It grows straight up unless lean, a tropism of its growth or a field bends "
            "it."},
    {KEY_OF(TreeParams, crown, "crown", KEY_GROUP), .table = &CROWN_TABLE,
     .doc = "The crown: main branches on the trunk, and everything that grows from them toward the "
            "attractors in the crown's envelope."},
    {KEY_OF(TreeParams, roots, "roots", KEY_GROUP), .table = &ROOTS_TABLE,
     .doc = "The roots. They grow like the crown, but down and outward."},
    {KEY_OF(TreeParams, elbows, "elbows", KEY_FLOAT), .high = 4, .unit = "trunk radii",
     .doc =
         "How far limbs are straightened between elbows, as where a side branch took the lead: "
         "those half as thick as the trunk by up to half of so many trunk radii, thinner ones by "
         "more of their own radii, the trunk by less. 0 = the bends in which they grew; 0.6 to "
         "2 = the angular limbs of oaks and old pines."},
    {KEY_OF(TreeParams, radii, "radii", KEY_GROUP), .table = &radii_table,
     .doc = "Thickness of trunk, branches and roots."},
    {KEY_OF(TreeParams, leaves, "leaves", KEY_GROUP), .table = &leaves_table,
     .doc = "Leaves, or needles (narrow leaves): copies of a few blades along the thin twigs."},
    {KEY_OF(TreeParams, organs, "organs", KEY_LIST),
     .count_offset = offsetof(TreeParams, organ_count), .count = 20, .table = &organ_table,
     .doc = "Blossom, fruit, cones, buds and other organs on the branches."},
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
    TreeParams *given = params;
    if (!phenology_check(mapping, &given->phenology, given->season, given->latitude,
                         &given->leaves)) {
        return false;
    }
    TreePlan plan;
    tree_plan_make(&plan, params, 0);
    const TreeParams *tree = &plan.params;
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
