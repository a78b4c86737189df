// Keys of clouds.
#include "render/cloud/cloud.h"
#include "scene/spec.h"

#define BIT(kind) (1u << (kind))

// All that are grown.
#define GROWN \
    (BIT(CLOUD_CUMULUS) | BIT(CLOUD_STRATUS) | BIT(CLOUD_STORM) | BIT(CLOUD_FOG) | BIT(CLOUD_PLUME))

static const EnumName KINDS[] = {{"cumulus", CLOUD_CUMULUS}, {"stratus", CLOUD_STRATUS},
                                 {"storm", CLOUD_STORM},     {"fog", CLOUD_FOG},
                                 {"plume", CLOUD_PLUME},     {"grid", CLOUD_GRID},
                                 {"spray", CLOUD_SPRAY},     {0}};

static const EnumName SPRAY_OF[] = {{"mist", SPRAY_MIST}, {"water", SPRAY_WATER}, {0}};

static const Key CLOUD_KEYS[] = {
    {KEY_OF(Cloud, kind, "kind", KEY_ENUM), .names = KINDS,
     .doc = "cumulus: heaps of all sizes and ages on one flat base, all over the land; stratus: a "
            "sheet, closed or torn; "
            "storm: one cumulonimbus, whose anvil the wind draws out; fog: fills the air from its "
            "base, densest there, up to a wavy top with wisps, out of which higher land stands; "
            "plume: ash that an eruption throws up, a column that widens as it rises, bends with "
            "the wind and is thinned out; "
            "grid: the "
            "voxels of an OpenVDB file; spray: what waterfalls and surf at cliffs and reefs throw "
            "up."},
    {KEY_OF(Cloud, file, "file", KEY_FILE), .flags = KEY_REQUIRED, .kinds = BIT(CLOUD_GRID),
     .doc = "VDB file with a grid of floats: a fog volume's values, or the inside of a level set."},
    {KEY_OF(Cloud, grid, "grid", KEY_TEXT), .kinds = BIT(CLOUD_GRID),
     .doc = "Name of the grid in the file; default: the first of floats."},
    {KEY_OF(Cloud, position, "position", KEY_VECTOR), .count = 3, .kinds = BIT(CLOUD_GRID),
     .unit = "m", .doc = "Position of the file's origin."},
    {KEY_OF(Cloud, rotation, "rotation", KEY_VECTOR), .count = 3, .kinds = BIT(CLOUD_GRID),
     .unit = "degrees", .doc = "Rotation about x, then y, then z: [-90, 0, 0] where z is up."},
    {KEY_OF(Cloud, scale, "scale", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e6,
     .kinds = BIT(CLOUD_GRID), .doc = "Metres a unit of the file's world."},
    {KEY_OF(Cloud, base, "base", KEY_FLOAT), .kinds = GROWN, .low = -1000, .high = 20000,
     .unit = "m",
     .doc = "Altitude of the underside above y = 0. That of fog may lie anywhere below the lowest "
            "land."},
    {KEY_OF(Cloud, thickness, "thickness", KEY_FLOAT), .kinds = GROWN, .flags = KEY_ABOVE,
     .high = 20000, .unit = "m",
     .doc = "Height of the tallest heaps, of the sheet, of the storm, or of the fog's highest "
            "swells, above the base."},
    {KEY_OF(Cloud, cover, "cover", KEY_FLOAT),
     .kinds = BIT(CLOUD_CUMULUS) | BIT(CLOUD_STRATUS) | BIT(CLOUD_FOG), .high = 1,
     .doc = "Share of the sky that they cover, seen from below; of the fog, what holes leave."},
    {KEY_OF(Cloud, size, "size", KEY_FLOAT), .kinds = GROWN, .flags = KEY_ABOVE, .low = 50,
     .high = 20000, .unit = "m",
     .doc = "Width of the large heaps, which many smaller ones surround; of the rolls of a sheet "
            "or fog; of the storm below its anvil, which is about 4.3 times as long and 3 times as "
            "wide; of a plume where it leaves the vent."},
    {KEY_OF(Cloud, extinction, "extinction", KEY_FLOAT), .high = 1, .unit = "1/m",
     .doc = "Extinction where droplets are dense, from a quarter of the thickness up, or at the "
            "base of fog, where a grid is 1, or where spray leaves the foot of a fall: 0.05 = one "
            "sees 60 m far in it; 0.003 for veils of ice. A storm's anvil has 0.03 to 0.25 of it."},
    {KEY_OF(Cloud, albedo, "albedo", KEY_COLOR), .low = 0, .high = 1,
     .doc = "Share of the light that meets a particle which it scatters; it absorbs the rest. 1 = "
            "drops of water or ice; 0.9 = grey ash, 0.8 = black smoke."},
    {KEY_OF(Cloud, softness, "softness", KEY_FLOAT),
     .kinds = BIT(CLOUD_CUMULUS) | BIT(CLOUD_STORM) | BIT(CLOUD_PLUME), .high = 1,
     .doc = "How far dry air has worn the borders: more with age, down the flanks, and of small "
            "heaps. 0 = firm as a cauliflower wherever air rises; 0.5 = firm at young tops, torn "
            "below; 1 = wisps all over but at the youngest tops."},
    {KEY_OF(Cloud, wind, "wind", KEY_FLOAT), .kinds = GROWN, .low = -360, .high = 360,
     .unit = "degrees",
     .doc = "Azimuth the wind blows toward, from +Z toward +X: heaps and anvils are longer along "
            "it."},
    {KEY_OF(Cloud, center_x, "center", KEY_VECTOR), .count = 2,
     .kinds = BIT(CLOUD_STORM) | BIT(CLOUD_PLUME), .low = -1e6, .high = 1e6, .unit = "m",
     .doc = "Position x, z of the storm's main tower, or of the vent."},
    {KEY_OF(Cloud, shelf, "shelf", KEY_FLOAT), .kinds = BIT(CLOUD_STORM), .high = 2,
     .doc = "Shelf cloud: how far tiers of low cloud overhang the land ahead of the storm, where "
            "the wind blows to, in shares of its size; 0 = none."},
    {KEY_OF(Cloud, over, "over", KEY_TEXT), .kinds = BIT(CLOUD_FOG) | BIT(CLOUD_SPRAY),
     .doc = "Of spray, which needs it: name of a terrain whose waterfalls, of a cascade, or of a "
            "sea whose surf "
            "throws it up at steep land or at the edges of platforms of its bed. Of fog: name of a "
            "terrain in whose "
            "hollows and valleys the fog lies, in high ones as in low "
            "ones: its thickness counts from a level that follows the low ground, and base does "
            "not count. Beyond the terrain's rim it goes on as over the terrain's copies. Default: "
            "fog of one level."},
    {KEY_OF(Cloud, of, "of", KEY_ENUM), .names = SPRAY_OF, .kinds = BIT(CLOUD_SPRAY),
     .doc = "mist: drops that air carries off from the foot of a fall, from its strands or from "
            "surf; water: the falling water itself, clots of drops and air with tails that "
            "lengthen as they fall, in place of the strands of a terrain's waterfalls below their "
            "lips, or the silk of a cascade. It is as much water as the river brings, in drops of "
            "6 mm; extinction is that "
            "of mist as dense as at a foot, and falling water is many times as dense."},
    {KEY_OF(Cloud, pool, "pool", KEY_FLOAT), .kinds = BIT(CLOUD_FOG), .flags = KEY_ABOVE,
     .high = 20000, .unit = "m",
     .doc = "With over: distance within which the lowest land is the ground of the fog. About "
            "that from the floor of a valley to its crests: less lets the fog climb up the slopes, "
            "more lets valleys of different altitude share one level."},
    {KEY_OF(Cloud, drift, "drift", KEY_FLOAT), .kinds = BIT(CLOUD_FOG) | BIT(CLOUD_PLUME),
     .high = 1,
     .doc =
         "How far the wind moves the fog: 0 = calm air; 1 = swells and holes are drawn out along "
         "wind to four times their width, and with over the fog banks up before slopes by half "
         "its thickness and thins behind them. Of a plume how far it bends: 0 = upright, 1 = it "
         "drifts as far as it rises well below its top."},
    {KEY_OF(Cloud, seed, "seed", KEY_INT), .kinds = GROWN, .high = 1e9,
     .doc = "Changes the form of these clouds alone."},
    {KEY_OF(Cloud, resolution, "resolution", KEY_INT), .kinds = GROWN, .low = 64, .high = 1024,
     .doc = "Voxels across their grid, rounded up to a power of two: 128 for drafts; twice as many "
            "take about eight times the memory and the time to grow."},
    {0},
};

static void cloud_defaults(const Node *given, int kind, void *out)
{
    (void)given;
    *(Cloud *)out = cloud_default(kind < 0 ? CLOUD_CUMULUS : (CloudKind)kind);
}

const Table cloud_table = {
    .name = "cloud",
    .doc =
        "Clouds of droplets: light is scattered through them by path tracing, and they shade the "
        "land.",
    .example = "clouds:\n"
               "  - {kind: cumulus, cover: 0.3, base: 1200, thickness: 1500}\n",
    .size = sizeof(Cloud),
    .keys = CLOUD_KEYS,
    .kind_key = "kind",
    .kind_defaults = cloud_defaults};
