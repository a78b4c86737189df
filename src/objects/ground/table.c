// Ground: the land, its grass, the woods in the distance.
#include "objects/common/tables.h"
#include "objects/ground/ground.h"

static const Key GROVE_KEYS[] = {
    {KEY_OF(GroveParams, count, "count", KEY_INT), .high = 1e6,
     .doc = "Number of trees; 0 = none."},
    {KEY_OF(GroveParams, inner, "inner", KEY_FLOAT), .high = 1e6, .unit = "m",
     .doc = "Minimum distance from the origin."},
    {KEY_OF(GroveParams, outer, "outer", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e6, .unit = "m",
     .doc = "Maximum distance from the origin."},
    {KEY_OF(GroveParams, height, "height", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1000,
     .unit = "m", .doc = "Height of the tallest trees."},
    {KEY_OF(GroveParams, clumping, "clumping", KEY_FLOAT), .high = 1,
     .doc = "Distribution: 0 = uniform, 1 = woods with open land between."},
    {KEY_OF(GroveParams, variants, "variants", KEY_INT), .low = 1, .high = 1000,
     .doc = "Number of different trees that are grown, at least one of each species; all others "
            "are copies."},
    {KEY_OF(GroveParams, bare, "bare", KEY_BOOL),
     .doc = "Grow trees without leaves, as in winter."},
    {KEY_OF(GroveParams, season, "season", KEY_FLOAT), .high = 13, .unit = "months",
     .doc = "Time of the year of all these trees, as tree.season; 0 = as each has it."},
    {KEY_OF(GroveParams, species, "species", KEY_LIST),
     .count_offset = offsetof(GroveParams, species_count), .count = 100, .table = &tree_share_table,
     .doc = "The trees and their shares. A tree without a height of its own has that of these "
            "woods. Default: oaks, limes and birches of the library."},
    {0},
};

static bool check_grove(const Mapping *mapping, void *params)
{
    GroveParams *grove = params;
    tree_mix_set_season(grove->species, grove->species_count, grove->season);
    return grove->inner < grove->outer ||
           mapping_fail(mapping, "inner", " is %g m; it must be less than outer, %g m",
                        (double)grove->inner, (double)grove->outer);
}

static const Table GROVE_TABLE = {.name = "grove",
                                  .doc = "Distant woods: copies of a few trees.",
                                  .size = sizeof(GroveParams),
                                  .keys = GROVE_KEYS,
                                  .check = check_grove};

static const Key GROUND_KEYS[] = {
    {KEY_OF(GroundParams, radius, "radius", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e6,
     .unit = "m", .doc = "Radius of the land, out to the horizon."},
    {KEY_OF(GroundParams, relief, "relief", KEY_FLOAT), .high = 1e4, .unit = "m",
     .doc = "Height of the hills."},
    {KEY_OF(GroundParams, wavelength, "wavelength", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e6,
     .unit = "m", .doc = "Distance between hills."},
    {KEY_OF(GroundParams, flat_radius, "flat_radius", KEY_FLOAT), .high = 1e6, .unit = "m",
     .doc = "Radius about the origin in which the land is flat, at height 0, for the subject to "
            "stand on."},
    {KEY_OF(GroundParams, grass_tufts, "grass_tufts", KEY_INT64), .high = 1e9,
     .doc = "Number of tufts of grass; 0 = none."},
    {KEY_OF(GroundParams, grass_radius, "grass_radius", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e5,
     .unit = "m", .doc = "Radius of the grass about grass_center; it thins out toward the rim."},
    {KEY_OF(GroundParams, grass_center, "grass_center", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Centre of the grass."},
    {KEY_OF(GroundParams, grass_height, "grass_height", KEY_FLOAT), .flags = KEY_ABOVE, .high = 100,
     .unit = "m", .doc = "Height of the tallest blades."},
    {KEY_OF(GroundParams, grass_clumping, "grass_clumping", KEY_FLOAT), .high = 1,
     .doc = "Distribution: 0 = uniform, 1 = in patches."},
    {KEY_OF(GroundParams, grass_variants, "grass_variants", KEY_INT), .low = 1, .high = 1000,
     .doc = "Number of different tufts."},
    {KEY_OF(GroundParams, fallen_leaves, "fallen_leaves", KEY_INT64), .high = 1e9,
     .doc = "Number of fallen leaves about fallen_center; 0 = none."},
    {KEY_OF(GroundParams, fallen_radius, "fallen_radius", KEY_FLOAT), .flags = KEY_ABOVE,
     .high = 1e5, .unit = "m", .doc = "Radius of the fallen leaves about fallen_center."},
    {KEY_OF(GroundParams, fallen_center, "fallen_center", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Centre of the fallen leaves."},
    {KEY_OF(GroundParams, fallen_gathering, "fallen_gathering", KEY_FLOAT), .high = 1,
     .doc = "Distribution: 0 = uniform over the disc, 1 = as densely as 1 / distance from the "
            "centre, to cover the ground near the camera."},
    {KEY_OF(GroundParams, fallen_of, "fallen_of", KEY_LIST),
     .count_offset = offsetof(GroundParams, fallen_of_count), .count = 100,
     .table = &tree_share_table,
     .doc =
         "Trees whose leaves these are, by their shares: of a conifer pieces of twigs. Only the "
         "form of their leaves is used; the material is the ground's `leaf_material`. Empty = an "
         "oak's."},
    {KEY_OF(GroundParams, snow, "snow", KEY_FLOAT), .high = 100, .unit = "m",
     .doc =
         "Mean depth of the snow on the land: in drifts, and bare in places where it is shallow; "
         "grass that is taller stands out. 0 = none. Snow on trees: their key snow."},
    {KEY_OF(GroundParams, ponds, "ponds", KEY_LIST),
     .count_offset = offsetof(GroundParams, pond_count), .count = 100, .table = &pond_table,
     .doc = "Ponds: basins with water. They do not touch one another."},
    {KEY_OF(GroundParams, trees, "trees", KEY_GROUP), .table = &GROVE_TABLE,
     .doc = "Distant woods: copies of a few trees."},
    {0},
};

// Distance (m) from a pond's middle within which the land is drawn by its own meshes.
static float pond_extent(const Pond *pond)
{
    return pond_reach(pond) + ground_pond_margin(pond).outer;
}

static bool check_pond(const Mapping *mapping, const GroundParams *ground, int index)
{
    const Pond *pond = &ground->ponds[index];
    float x = pond->position[0], z = pond->position[1], extent = pond_extent(pond);
    if (!(sqrtf(x * x + z * z) + extent < ground->radius)) {
        return mapping_fail(mapping, "ponds",
                            ": pond %d needs %g m about its middle, which reach beyond the land's "
                            "radius, %g m",
                            index, (double)extent, (double)ground->radius);
    }
    for (int i = 0; i < index; i++) {
        float dx = x - ground->ponds[i].position[0], dz = z - ground->ponds[i].position[1];
        float apart = sqrtf(dx * dx + dz * dz), least = extent + pond_extent(&ground->ponds[i]);
        if (apart < least) {
            return mapping_fail(mapping, "ponds",
                                ": ponds %d and %d are %g m apart; with their banks they need at "
                                "least %g m",
                                i, index, (double)apart, (double)least);
        }
    }
    return true;
}

static bool check_ground(const Mapping *mapping, void *params)
{
    const GroundParams *ground = params;
    if (ground->flat_radius >= ground->radius) {
        return mapping_fail(mapping, "flat_radius",
                            " is %g m; it must be less than the radius, %g m",
                            (double)ground->flat_radius, (double)ground->radius);
    }
    for (int i = 0; i < ground->pond_count; i++) {
        if (!check_pond(mapping, ground, i)) {
            return false;
        }
    }
    return true;
}

static void ground_defaults(void *out)
{
    *(GroundParams *)out = ground_params_default();
}

const Table ground_table = {
    .name = "ground",
    .doc = "Gently rolling land with grass, out to the horizon. Grass and trees do not grow in "
           "water: its ponds, a `medium` of water, or a shape or mesh whose material has the "
           "pattern `water` "
           "or is a dielectric with the index of water. Materials: ground, grass, fallen.",
    .example =
        "objects:\n"
        "  - name: meadow\n"
        "    ground: {grass_tufts: 80000, grass_radius: 30, relief: 8, trees: {count: 300}}\n",
    .size = sizeof(GroundParams),
    .keys = GROUND_KEYS,
    .defaults = ground_defaults,
    .check = check_ground};
