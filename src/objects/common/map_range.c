// The keys of a condition on a map of land.
#include "land/where.h"
#include "objects/common/tables.h"

#define MAP(ID, NAME) {NAME, HEIGHT_MAP_##ID},
static const EnumName MAPS[] = {HEIGHT_MAPS(MAP){0}};
#undef MAP

static const Key KEYS[] = {
    {KEY_OF(MapRange, map, "map", KEY_ENUM), .flags = KEY_REQUIRED, .names = MAPS,
     .doc =
         "slope: degrees from level; aspect: degrees toward which the land falls, 0 = north (-z), "
         "90 = east (+x); curvature: 1/m, positive in hollows, negative on ridges; flow: m^2 of "
         "catchment; wetness: the topographic index ln(catchment per m of contour / slope), about "
         "5 on ridges and 15 in valleys; river-distance: m to the nearest river, of forms "
         "braided and meander to its edge; sun-hours: mean "
         "hours of direct sun a day, with the shade of the land itself; altitude: m, the height. "
         "Only of terrains: deposit "
         "and wear: m that erosion has laid down and taken away; bedrock: 1 where rock is bare, 0 "
         "under 0.5 m of loose ground; snow: share of the ground that snow covers (forms alps and "
         "volcano); "
         "lava: 0 to 1, how fresh the lava on the ground is; scoria: 0 to 1, how red it is "
         "(form volcano); age: of the ground of a river's valley, 0 = what water has just "
         "moved, up to 0.6 (braided) or 0.74 (meander) where it has long lain, 0.8 = terraces and "
         "hills, 1 = slopes (forms braided and meander); water-depth: m of water over the ground, "
         "negative by how far the ground is above the lake's level, or above that of a river next "
         "to it: [-0.4, 0] is a wet rim, [0.05, 0.8] where reeds stand."},
    {KEY_OF(MapRange, range, "range", KEY_VECTOR), .flags = KEY_REQUIRED, .count = 2, .low = -1e9,
     .high = 1e9,
     .doc =
         "Least and greatest value, in the map's unit. Of aspect, [300, 60] leads through north."},
    {KEY_OF(MapRange, fade, "fade", KEY_FLOAT), .high = 1e9,
     .doc = "Distance from the range, in the map's unit, over which copies become fewer, or a "
            "layer thinner; 0 = none outside."},
    {KEY_OF(MapRange, latitude, "latitude", KEY_FLOAT), .low = -90, .high = 90, .unit = "degrees",
     .doc = "Of sun-hours: latitude of the land, north positive."},
    {KEY_OF(MapRange, day, "day", KEY_INT), .high = 366,
     .doc = "Of sun-hours: day of the year, 1 = 1 January; 0 = the year's mean."},
    {0},
};

static void defaults(void *out)
{
    *(MapRange *)out = (MapRange){.latitude = HEIGHT_MAP_LATITUDE};
}

static bool check(const Mapping *mapping, void *params)
{
    const MapRange *range = params;
    return range->map == HEIGHT_MAP_ASPECT || check_range(mapping, "range", range->range);
}

const Table map_range_table = {
    .name = "where",
    .doc = "A condition on a map of a surface seen from above: of a terrain's own samples, of 1024 "
           "x 1024 samples over the bounds of another object, or of the land under a scattering's "
           "disc. `ramify grow SCENE --map NAME -o map.png` shows the maps of a terrain.",
    .example = "materials:\n"
               "  - {name: wet, kind: principled, color: [0.07, 0.06, 0.05], roughness: 0.3}\n"
               "  - name: mountain\n"
               "    layers: [{material: wet, fray: 0.3, where: [{map: water-depth, range: [-0.4, "
               "9], fade: 0.3}]}]\n"
               "objects:\n"
               "  - name: land\n"
               "    terrain: {size: 400, resolution: 256, water_level: 0.1}\n"
               "  - name: stones\n"
               "    scatter:\n"
               "      on: land\n"
               "      radius: 0\n"
               "      count: 500\n"
               "      where:\n"
               "        - {map: slope, range: [25, 60], fade: 5}\n"
               "        - {map: aspect, range: [90, 270]}\n"
               "      things: [{stone: {size: 2}}]\n"
               "  - name: reeds\n"
               "    scatter:\n"
               "      on: land\n"
               "      radius: 0\n"
               "      count: 300\n"
               "      clumping: 0.6\n"
               "      where: [{map: water-depth, range: [0.05, 0.7], fade: 0.2}]\n"
               "      things: [{tree: {species: common_reed}}]\n",
    .size = sizeof(MapRange),
    .keys = KEYS,
    .defaults = defaults,
    .check = check};
