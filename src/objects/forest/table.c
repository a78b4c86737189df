// Forests.
#include "objects/common/tables.h"
#include "objects/forest/forest.h"

static const Key FOREST_KEYS[] = {
    {KEY_OF(ForestParams, height, "height", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1000,
     .unit = "m", .doc = "Height of the tallest trees."},
    {KEY_OF(ForestParams, spacing, "spacing", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "Distance between trunks; 0 = a fraction of the height."},
    {KEY_OF(ForestParams, crown, "crown", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1,
     .doc = "Fraction of the height, from the top, that bears branches."},
    {KEY_OF(ForestParams, stand_trees, "stand_trees", KEY_INT), .low = 1, .high = 1000,
     .doc = "Number of trees per stand; they grow together and compete for its light."},
    {KEY_OF(ForestParams, stands, "stands", KEY_INT), .low = 1, .high = 1000,
     .doc = "Number of different stands that are grown; they are repeated over the land."},
    {KEY_OF(ForestParams, radius, "radius", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e5,
     .unit = "m", .doc = "Radius of the forest."},
    {KEY_OF(ForestParams, center, "center", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Centre of the forest."},
    {KEY_OF(ForestParams, glade, "glade", KEY_FLOAT), .high = 1e5, .unit = "m",
     .doc = "Radius of a glade; 0 = none."},
    {KEY_OF(ForestParams, glade_center, "glade_center", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Centre of the glade and of the ferns."},
    {KEY_OF(ForestParams, density, "density", KEY_FLOAT), .high = 1,
     .doc = "Fraction of the sites that bear a tree: 1 = a closed forest."},
    {KEY_OF(ForestParams, clumping, "clumping", KEY_FLOAT), .high = 1,
     .doc = "Distribution: 0 = uniform, 1 = woods with open land between."},
    {KEY_OF(ForestParams, max_slope, "max_slope", KEY_FLOAT), .high = 89, .unit = "degrees",
     .doc = "Steepest slope on which trees and ferns grow."},
    {KEY_OF(ForestParams, ferns, "ferns", KEY_INT64), .high = 1e9,
     .doc = "Number of ferns below the trees; 0 = none."},
    {KEY_OF(ForestParams, fern_height, "fern_height", KEY_FLOAT), .flags = KEY_ABOVE, .high = 100,
     .unit = "m", .doc = "Height of the tallest ferns."},
    {KEY_OF(ForestParams, fern_radius, "fern_radius", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e5,
     .unit = "m", .doc = "Radius of the ferns about glade_center."},
    {KEY_OF(ForestParams, season, "season", KEY_FLOAT), .high = 13, .unit = "months",
     .doc = "Time of the year of all trees, as tree.season; 0 = as each has it."},
    {KEY_OF(ForestParams, species, "species", KEY_LIST),
     .count_offset = offsetof(ForestParams, species_count), .count = 100,
     .table = &tree_share_table,
     .doc = "The trees and their shares, grown by light: `stands` stands of `stand_trees` each "
            "inside the wood, others at its edge and in the open; then set tree by tree over the "
            "land, each where it belongs. A tree without a height has that of the forest; "
            "leaves.max_count is then that of a tree. crown, radii, skin, envelope, points, growth "
            "and fields are not used. Empty = plain trees, grown together by attractors."},
    {KEY_OF(ForestParams, radii, "radii", KEY_GROUP), .table = &radii_table,
     .doc = "Thickness of trunks and branches."},
    {KEY_OF(ForestParams, leaves, "leaves", KEY_GROUP), .table = &leaves_table,
     .doc = "Leaves of one stand."},
    {KEY_OF(ForestParams, skin, "skin", KEY_GROUP), .table = &skin_table,
     .doc = "Surface of the branches."},
    ELEMENT_ROWS(ForestParams),
    {0},
};

static void forest_defaults(void *out)
{
    *(ForestParams *)out = forest_params_default();
}

static bool check_forest(const Mapping *mapping, void *params)
{
    ForestParams *forest = params;
    tree_mix_set_season(forest->species, forest->species_count, forest->season);
    return check_element(mapping, &((const ForestParams *)params)->element);
}

const Table forest_table = {
    .name = "forest",
    .doc = "A forest: stands of trees that grow together and compete for light, repeated over the "
           "ground for thousands of trees. Materials: bark, twig, leaf; grass for the ferns.",
    .example = "objects:\n"
               "  - name: floor\n"
               "    ground: {relief: 4}\n"
               "  - name: wood\n"
               "    forest: {height: 18, radius: 80, glade: 6, ferns: 2000}\n",
    .size = sizeof(ForestParams),
    .keys = FOREST_KEYS,
    .defaults = forest_defaults,
    .check = check_forest};
