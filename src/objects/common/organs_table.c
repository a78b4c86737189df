// The table of organs.
#include "config/table.h"
#include "objects/common/organs.h"

static const EnumName KINDS[] = {{"blossom", ORGAN_BLOSSOM},
                                 {"catkin", ORGAN_CATKIN},
                                 {"fruit", ORGAN_FRUIT},
                                 {"cone", ORGAN_CONE},
                                 {"acorn", ORGAN_ACORN},
                                 {"husk", ORGAN_HUSK},
                                 {"bud", ORGAN_BUD},
                                 {"samara", ORGAN_SAMARA},
                                 {"thorn", ORGAN_THORN},
                                 {"daisy", ORGAN_DAISY},
                                 {"bell", ORGAN_BELL},
                                 {"water_lily", ORGAN_WATER_LILY},
                                 {0}};
static const EnumName SITES[] = {
    {"ends", SITES_ENDS}, {"along", SITES_ALONG}, {"stem", SITES_STEM}, {0}};
static const EnumName CLUSTERS[] = {{"umbel", CLUSTER_UMBEL}, {"raceme", CLUSTER_RACEME}, {0}};

static const Key ORGAN_KEYS[] = {
    {KEY_OF(OrganGroup, kind, "kind", KEY_ENUM), .names = KINDS, .flags = KEY_REQUIRED,
     .doc =
         "blossom: flowers of separate petals; catkin: a cylinder of small scales (birch, "
         "hazel); fruit: round or long (apple, cherry, olive, date); cone: woody scales; acorn; "
         "husk: a ball with spikes (horse chestnut); bud: of winter twigs; samara: paired "
         "winged nuts (maple); thorn: straight spines; daisy: rays about a disc, which is of the "
         "fruit's material; bell: petals that form a tube and curl back at their tips (bluebell, "
         "lily of the valley); water_lily: sepals, green below, and many pointed petals about "
         "stamens, which are of the material of anthers."},
    {KEY_OF(OrganGroup, where, "where", KEY_ENUM), .names = SITES,
     .doc = "ends: at the ends of twigs; along: along twigs, in a spiral; stem: in lines along "
            "stems and branches, as a cactus' spines."},
    {KEY_OF(OrganGroup, season, "season", KEY_VECTOR), .count = 2, .high = 13, .unit = "months",
     .doc = "When they are there, if the tree gives a season: first and last month with fractions, "
            "at 50 degrees north; [11, 3] goes over the new year. 0 = always."},
    {KEY_OF(OrganGroup, max_count, "max_count", KEY_INT64), .high = 1e9,
     .doc = "Maximum number of clusters; if there would be more, fewer places bear one. 0 = none."},
    {KEY_OF(OrganGroup, share, "share", KEY_FLOAT), .high = 1,
     .doc = "Share of the places that bear a cluster, chosen at random."},
    {KEY_OF(OrganGroup, spacing, "spacing", KEY_FLOAT), .low = 1e-4, .high = 100, .unit = "m",
     .doc = "Distance between places along a branch."},
    {KEY_OF(OrganGroup, twig_radius, "twig_radius", KEY_FLOAT), .flags = KEY_ABOVE, .high = 100,
     .unit = "m", .doc = "Maximum radius of branches that bear them."},
    {KEY_OF(OrganGroup, above, "above", KEY_FLOAT), .high = 1,
     .doc = "Lowest place, as a fraction of the crown's height: 0 = all of the crown, 0.7 = its "
            "upper part, as spruce cones."},
    {KEY_OF(OrganGroup, rows, "rows", KEY_INT), .low = 1, .high = 100,
     .doc = "Number of lines around a stem, with where: stem."},
    {KEY_OF(OrganGroup, angle, "angle", KEY_FLOAT), .high = 180, .unit = "degrees",
     .doc = "Angle to the branch; at ends a small part of it."},
    {KEY_OF(OrganGroup, hang, "hang", KEY_FLOAT), .high = 1,
     .doc = "How far clusters hang straight down."},
    {KEY_OF(OrganGroup, cluster, "cluster", KEY_ENUM), .names = CLUSTERS,
     .doc = "Of several in one place. umbel: stalks from one point (cherry); raceme: along an axis "
            "(wisteria, horse chestnut, dates)."},
    {KEY_OF(OrganGroup, per_cluster, "per_cluster", KEY_INT), .low = 1, .high = 1000,
     .doc = "Number of them in each cluster."},
    {KEY_OF(OrganGroup, axis, "axis", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Length of a raceme's axis."},
    {KEY_OF(OrganGroup, taper, "taper", KEY_FLOAT), .high = 1,
     .doc = "How much smaller a raceme's organs and their stalks are toward its end, where they "
            "are younger; 0 = all are equal."},
    {KEY_OF(OrganGroup, arch, "arch", KEY_FLOAT), .high = 180, .unit = "degrees",
     .doc = "Angle by which a raceme's axis bends over to its end, as a bluebell's; it bends down "
            "from where it starts."},
    {KEY_OF(OrganGroup, one_sided, "one_sided", KEY_FLOAT), .high = 1,
     .doc = "How far a cluster's stalks turn to one side, that to which its axis bends: 0 = they "
            "stand all round."},
    {KEY_OF(OrganGroup, nod, "nod", KEY_FLOAT), .high = 1,
     .doc = "How far each one hangs down from the end of its own stalk, which bends; those near a "
            "raceme's end less."},
    {KEY_OF(OrganGroup, bracts, "bracts", KEY_INT), .high = 12,
     .doc = "Number of narrow bracts at the foot of each stalk, of the stalks' material."},
    {KEY_OF(OrganGroup, bract_length, "bract_length", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Length of the longest of them."},
    {KEY_OF(OrganGroup, spread, "spread", KEY_FLOAT), .high = 180, .unit = "degrees",
     .doc = "Angle between the outermost stalks of a cluster and its axis."},
    {KEY_OF(OrganGroup, length, "length", KEY_FLOAT), .flags = KEY_ABOVE, .high = 100, .unit = "m",
     .doc =
         "Length of one; of blossom that of a petal, of a bell that of a petal along its curl, of "
         "a samara that of a wing."},
    {KEY_OF(OrganGroup, width, "width", KEY_FLOAT), .flags = KEY_ABOVE, .high = 100, .unit = "m",
     .doc = "Width of one, of a bell its tube's; of blossom that of a petal, of a samara that of a "
            "wing."},
    {KEY_OF(OrganGroup, stalk, "stalk", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Length of each one's stalk."},
    {KEY_OF(OrganGroup, open, "open", KEY_FLOAT), .high = 1,
     .doc = "From closed (0) to wide open (1): petals, the scales of cones and catkins, the wings "
            "of a samara; of bells how far their tips curl back, 0 = a plain tube."},
    {KEY_OF(OrganGroup, petals, "petals", KEY_INT), .low = 3, .high = 60,
     .doc = "Petals of a blossom, where more than 5 stand in several whorls, of a water lily or of "
            "a bell; rays of a daisy."},
    {KEY_OF(OrganGroup, buds, "buds", KEY_FLOAT), .high = 1,
     .doc = "Share of the blossoms of a cluster that are still closed, on shorter stalks; of bells "
            "the last ones of the cluster."},
    {KEY_OF(OrganGroup, spur, "spur", KEY_FLOAT), .high = 1, .unit = "m",
     .doc = "Length of the ringed short shoot that each cluster stands on, with the open scales of "
            "its bud at detail 2, as a cherry's, of the cones' material. 0 = none."},
    {KEY_OF(OrganGroup, dimple, "dimple", KEY_FLOAT), .high = 1,
     .doc = "How far the ends of a fruit are drawn in: 0 = an olive, 1 = an apple; of a daisy the "
            "disc's radius, relative to a ray's length."},
    {KEY_OF(OrganGroup, size_variation, "size_variation", KEY_FLOAT), .high = 1,
     .doc = "Variation of size between clusters: 0 = all equal."},
    {KEY_OF(OrganGroup, variants, "variants", KEY_INT), .low = 1, .high = 1000,
     .doc = "Number of different clusters."},
    {KEY_OF(OrganGroup, detail, "detail", KEY_INT), .low = 1, .high = 2,
     .doc = "Detail of the meshes: 1 for whole trees, 2 for close-ups; blossoms of 2 are hollow "
            "cups, which "
            "suit few petals."},
    {0},
};

// What differs from kind to kind.
static const OrganGroup OWN_DEFAULTS[] = {
    [ORGAN_BLOSSOM] = {.where = SITES_ALONG,
                       .share = 0.7f,
                       .spacing = 0.05f,
                       .angle = 70.0f,
                       .hang = 0.2f,
                       .per_cluster = 3,
                       .spread = 50.0f,
                       .length = 0.014f,
                       .width = 0.013f,
                       .stalk = 0.025f,
                       .open = 0.85f},
    [ORGAN_CATKIN] = {.where = SITES_ENDS,
                      .share = 0.5f,
                      .spacing = 0.08f,
                      .angle = 60.0f,
                      .hang = 1.0f,
                      .per_cluster = 2,
                      .spread = 14.0f,
                      .length = 0.05f,
                      .width = 0.008f,
                      .stalk = 0.005f,
                      .open = 0.6f},
    [ORGAN_FRUIT] = {.where = SITES_ALONG,
                     .share = 0.15f,
                     .spacing = 0.08f,
                     .angle = 60.0f,
                     .hang = 0.85f,
                     .per_cluster = 1,
                     .spread = 35.0f,
                     .length = 0.065f,
                     .width = 0.072f,
                     .stalk = 0.02f,
                     .dimple = 1.0f},
    [ORGAN_CONE] = {.where = SITES_ENDS,
                    .share = 0.1f,
                    .spacing = 0.1f,
                    .angle = 70.0f,
                    .hang = 0.5f,
                    .per_cluster = 1,
                    .spread = 40.0f,
                    .length = 0.05f,
                    .width = 0.03f,
                    .stalk = 0.004f,
                    .open = 0.5f},
    [ORGAN_ACORN] = {.where = SITES_ENDS,
                     .share = 0.15f,
                     .spacing = 0.1f,
                     .angle = 50.0f,
                     .hang = 0.5f,
                     .per_cluster = 2,
                     .spread = 40.0f,
                     .length = 0.027f,
                     .width = 0.015f,
                     .stalk = 0.035f},
    [ORGAN_HUSK] = {.where = SITES_ENDS,
                    .share = 0.15f,
                    .spacing = 0.1f,
                    .angle = 50.0f,
                    .hang = 0.7f,
                    .per_cluster = 2,
                    .spread = 45.0f,
                    .length = 0.05f,
                    .width = 0.055f,
                    .stalk = 0.05f},
    [ORGAN_BUD] = {.where = SITES_ALONG,
                   .share = 1.0f,
                   .spacing = 0.025f,
                   .angle = 28.0f,
                   .per_cluster = 1,
                   .length = 0.007f,
                   .width = 0.004f},
    [ORGAN_SAMARA] = {.where = SITES_ENDS,
                      .share = 0.3f,
                      .spacing = 0.1f,
                      .angle = 60.0f,
                      .hang = 1.0f,
                      .per_cluster = 5,
                      .spread = 45.0f,
                      .length = 0.032f,
                      .width = 0.011f,
                      .stalk = 0.035f,
                      .open = 0.5f},
    [ORGAN_THORN] = {.where = SITES_ALONG,
                     .share = 0.8f,
                     .spacing = 0.02f,
                     .angle = 75.0f,
                     .per_cluster = 1,
                     .spread = 70.0f,
                     .length = 0.007f,
                     .width = 0.002f},
    [ORGAN_DAISY] = {.where = SITES_ENDS,
                     .share = 0.8f,
                     .spacing = 0.1f,
                     .angle = 60.0f,
                     .per_cluster = 1,
                     .length = 0.016f,
                     .width = 0.0055f,
                     .open = 0.95f,
                     .dimple = 0.5f},
    [ORGAN_BELL] = {.where = SITES_ENDS,
                    .share = 0.8f,
                    .spacing = 0.1f,
                    .angle = 60.0f,
                    .cluster = CLUSTER_RACEME,
                    .per_cluster = 8,
                    .spread = 50.0f,
                    .nod = 0.8f,
                    .petals = 6,
                    .length = 0.019f,
                    .width = 0.008f,
                    .stalk = 0.012f,
                    .open = 0.8f},
    [ORGAN_WATER_LILY] = {.where = SITES_ENDS,
                          .share = 0.8f,
                          .spacing = 0.1f,
                          .per_cluster = 1,
                          .petals = 22,
                          .length = 0.055f,
                          .width = 0.022f,
                          .stalk = 0.02f,
                          .open = 0.8f},
};

static void organ_defaults(const Node *given, int kind, void *out)
{
    (void)given;
    OrganGroup *group = out;
    *group = OWN_DEFAULTS[kind < 0 ? ORGAN_BLOSSOM : kind];
    group->kind = kind < 0 ? ORGAN_BLOSSOM : (OrganKind)kind;
    group->max_count = 20000;
    group->twig_radius = 0.008f;
    group->rows = 12;
    group->axis = 0.15f;
    group->petals = group->petals > 0 ? group->petals : 5;
    group->bract_length = 0.015f;
    group->size_variation = 0.25f;
    group->variants = 3;
    group->detail = 1;
}

const Table organ_table = {
    .name = "organ",
    .doc = "Blossom, fruit, cones and other organs on the branches. Materials: blossom, fruit, "
           "cone (scales, cups, buds, spines, short shoots), stalk (also sepals and stamens), "
           "tree/anther; wings are of the leaves' material.",
    .example = "objects:\n"
               "  - name: cherry\n"
               "    tree:\n"
               "      leaves: {emergence: 0.15}\n"
               "      organs:\n"
               "        - {kind: blossom, per_cluster: 4, stalk: 0.03, open: 0.9}\n",
    .size = sizeof(OrganGroup),
    .keys = ORGAN_KEYS,
    .kind_key = "kind",
    .kind_defaults = organ_defaults};
