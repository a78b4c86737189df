// What lies and stands on the finished land of a terrain: lakes and conifers.
#include "objects/common/tables.h"
#include "objects/terrain/terrain.h"

static const Key FOREST_KEYS[] = {
    {KEY_OF(TerrainForestParams, count, "count", KEY_INT), .high = 1e7,
     .doc = "Maximum number of conifers; 0 = none. Distant ones are omitted first."},
    {KEY_OF(TerrainForestParams, height, "height", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1000,
     .unit = "m", .doc = "Height of the tallest conifers."},
    {KEY_OF(TerrainForestParams, low, "low", KEY_FLOAT), .high = 1,
     .doc = "Altitude of the lowest trees, as a fraction of the relief."},
    {KEY_OF(TerrainForestParams, high, "high", KEY_FLOAT), .high = 1,
     .doc = "Altitude of the tree line, as a fraction of the relief."},
    {KEY_OF(TerrainForestParams, slope, "slope", KEY_FLOAT), .high = 89, .unit = "degrees",
     .doc = "Steepest slope on which trees grow."},
    {KEY_OF(TerrainForestParams, clumping, "clumping", KEY_FLOAT), .high = 1,
     .doc = "Distribution: 0 = uniform, 1 = woods with clearings."},
    {KEY_OF(TerrainForestParams, beyond, "beyond", KEY_INT), .high = TERRAIN_MOST_BEYOND,
     .doc = "Rings of the copies around the square (the terrain's key beyond) on which conifers "
            "stand, too, ever fewer as in the square: up to `count` more on each copy. Where the "
            "land is drawn of tiles they stand on its triangles, else up to the meshing error of "
            "copies off."},
    {0},
};

const Table terrain_forest_table = {.name = "forest",
                                    .doc = "Conifers on the slopes.",
                                    .size = sizeof(TerrainForestParams),
                                    .keys = FOREST_KEYS};

static const Key LAKE_KEYS[] = {
    {KEY_OF(TerrainLakeParams, count, "count", KEY_INT), .high = 100000,
     .doc = "Maximum number of lakes, the largest first; 0 = none, and hollows are filled with "
            "ground."},
    {KEY_OF(TerrainLakeParams, area, "area", KEY_FLOAT), .high = 1e12, .unit = "m2",
     .doc = "Minimum area; 0 = a square of 0.005 of the size. Smaller hollows stay dry."},
    {KEY_OF(TerrainLakeParams, depth, "depth", KEY_FLOAT), .high = 1e4, .unit = "m",
     .doc = "Minimum depth of the deepest place; 0 = 0.0001 of the size."},
    {KEY_OF(TerrainLakeParams, beach, "beach", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "Width of the beach that waves have made, on each side of the shoreline; 0 = by the "
            "lake's size, a few cells. At most 8 cells."},
    {KEY_OF(TerrainLakeParams, silt, "silt", KEY_FLOAT), .high = 1,
     .doc = "Of form: alps, how far streams have filled the basins that the ice dug: 0 = not at "
            "all, 1 = valleys have flat floors without lakes."},
    {KEY_OF(TerrainLakeParams, basins, "basins", KEY_INT), .high = 1000,
     .doc = "Number of basins dug into the flattest ground, as by glaciers behind bars of rock, "
            "where the land has too few of its own; their areas are 1, 1/2, 1/3, ... of the "
            "largest."},
    {KEY_OF(TerrainLakeParams, basin_area, "basin_area", KEY_FLOAT), .high = 1e12, .unit = "m2",
     .doc = "Area of the largest of them; 0 = a square of 0.04 of the size."},
    {KEY_OF(TerrainLakeParams, deepness, "deepness", KEY_FLOAT), .flags = KEY_ABOVE, .high = 10,
     .doc = "Factor on their depth; 1 = a mean of 0.104 m (area / m2)^0.42, as of mountain lakes."},
    {KEY_OF(TerrainLakeParams, altitude, "altitude", KEY_VECTOR), .count = 2, .high = 1,
     .doc = "Lowest and highest altitude of their outlets, as fractions of the relief: [0.4, 0.7] "
            "makes tarns in cirques."},
    {0},
};

static bool check_lakes(const Mapping *mapping, void *params)
{
    const TerrainLakeParams *lakes = params;
    return check_range(mapping, "altitude", lakes->altitude);
}

const Table terrain_lake_table = {
    .name = "terrain_lakes",
    .doc = "Lakes in the hollows of the land, each full to the lowest way out, with beaches. Their "
           "water is clear: its material is terrain/lake. Rivers, if there are any, run through "
           "them. Not of forms braided, meander, delta, dunes and coast, nor with water_level.",
    .example = "objects:\n"
               "  - name: range\n"
               "    terrain:\n"
               "      form: alps\n"
               "      size: 6000\n"
               "      lakes: {count: 8, silt: 0.3, basins: 3, altitude: [0.3, 0.7]}\n"
               "  - name: reeds\n"
               "    scatter:\n"
               "      on: range\n"
               "      count: 2000\n"
               "      radius: 0\n"
               "      clumping: 0.7\n"
               "      where: [{map: water-depth, range: [0.05, 0.7], fade: 0.2}]\n"
               "      things: [{tree: {species: common_reed}}]\n",
    .size = sizeof(TerrainLakeParams),
    .keys = LAKE_KEYS,
    .check = check_lakes};
