// The keys of a sea.
#include "config/load.h"
#include "objects/common/tables.h"
#include "objects/sea/sea.h"

SeaParams sea_params_default(void)
{
    return (SeaParams){.wind = 8.0f,
                       .fetch = 200000.0f,
                       .choppiness = 1.0f,
                       .foam = 1.0f,
                       .extent = 40000.0f,
                       .finest = 0.1f,
                       .spokes = 1200};
}

static const Key SEA_KEYS[] = {
    {KEY_OF(SeaParams, wind, "wind", KEY_FLOAT), .low = 0.5, .high = 40, .unit = "m/s",
     .doc = "Speed of the wind 10 m above the water: 3 a light breeze, 8 fresh, 12 strong, 18 a "
            "gale, 25 a storm."},
    {KEY_OF(SeaParams, wind_azimuth, "wind_azimuth", KEY_FLOAT), .low = -360, .high = 360,
     .unit = "degrees", .doc = "Where the wind comes from, clockwise from north (-z)."},
    {KEY_OF(SeaParams, fetch, "fetch", KEY_FLOAT), .low = 100, .high = 1e7, .unit = "m",
     .doc = "Length of water over which the wind has blown: the longer, the longer and higher are "
            "the waves, up to a fully developed sea."},
    {KEY_OF(SeaParams, depth, "depth", KEY_FLOAT), .high = 12000, .unit = "m",
     .doc = "Depth of the open sea; 0 = deep for all its waves."},
    {KEY_OF(SeaParams, level, "level", KEY_FLOAT), .low = -1e5, .high = 1e5, .unit = "m",
     .doc = "Height of the calm surface."},
    {KEY_OF(SeaParams, choppiness, "choppiness", KEY_FLOAT), .high = 1.5,
     .doc = "How sharp crests are: 1 = as water moves, 0 = as high as troughs are deep."},
    {KEY_OF(SeaParams, foam, "foam", KEY_FLOAT), .high = 4,
     .doc = "How easily waves turn white: 1 = as at sea, 0 = never."},
    {KEY_OF(SeaParams, swash, "swash", KEY_FLOAT), .high = 1,
     .doc = "How white the edge of the water is where it runs out on the bed's shore: a lip of "
            "froth, and lace on the sheet behind it; 0 = bare."},
    {KEY_OF(SeaParams, breakers, "breakers", KEY_FLOAT), .high = 2,
     .doc =
         "How far the steepest of the crests that break fall forward, in their heights above the "
         "calm surface: 0 = they only turn white, 0.3 = they spill, 1 = they plunge."},
    {KEY_OF(SeaParams, drops, "drops", KEY_FLOAT), .high = 10,
     .doc = "Drops in the air above crests that break, within 60 m of the center: 1 = as many as a "
            "gale tears off, 0 = none. Material: sea/drops."},
    {KEY_OF(SeaParams, time, "time", KEY_FLOAT), .low = -1e6, .high = 1e6, .unit = "s",
     .doc = "Time of the picture; a key of animations."},
    {KEY_OF(SeaParams, crest_height, "crest_height", KEY_FLOAT), .high = 60, .unit = "m",
     .doc =
         "Height above the calm surface of one great wave, whose waves come together at a place "
         "and a time; 0 = none. It has the shape that the crests of this height have on average "
         "in this sea; the other waves stay what they are. Significant wave height, from troughs "
         "to crests, is what ramify info tells."},
    {KEY_OF(SeaParams, crest, "crest", KEY_VECTOR), .count = 2, .unit = "m",
     .doc = "x and z of the place of the great wave's crest."},
    {KEY_OF(SeaParams, crest_time, "crest_time", KEY_FLOAT), .low = -1e6, .high = 1e6, .unit = "s",
     .doc = "Time at which it is highest there."},
    {KEY_OF(SeaParams, bed, "bed", KEY_TEXT),
     .doc = "Name of an object, such as a terrain, that is the sea's bed and shore: waves turn "
            "toward it, grow, break and end on it. Default: the open sea."},
    {KEY_OF(SeaParams, center, "center", KEY_VECTOR), .count = 2,
     .given_offset = offsetof(SeaParams, center_given), .unit = "m",
     .doc = "x and z of the place about which its mesh is finest; default: under the camera. The "
            "waves do not depend on it."},
    {KEY_OF(SeaParams, extent, "extent", KEY_FLOAT), .low = 1, .high = 200000, .unit = "m",
     .doc = "Radius of the mesh, which falls off with the Earth's curve: the horizon is 3.6 km "
            "away for an eye at 1 m, 11 km at 10 m, 36 km at 100 m."},
    {KEY_OF(SeaParams, finest, "finest", KEY_FLOAT), .low = 0.005, .high = 100, .unit = "m",
     .doc = "Size of the mesh's cells at the center; shorter waves are bumps and roughness."},
    {KEY_OF(SeaParams, spokes, "spokes", KEY_INT), .low = 16, .high = 8192,
     .doc = "Cells of the mesh around its center; they grow with the distance from it. Shorter "
            "waves are bumps and roughness."},
    {0},
};

static void sea_defaults(void *out)
{
    *(SeaParams *)out = sea_params_default();
}

const Table sea_table = {
    .name = "sea",
    .doc = "The sea to the horizon, with waves by the spectrum of the wind. They depend on the "
           "wind, its fetch, the time and the seed alone. Material: sea/water.",
    .example = "objects:\n"
               "  - name: atlantic\n"
               "    sea: {wind: 12, wind_azimuth: 240, fetch: 300000}\n",
    .size = sizeof(SeaParams),
    .keys = SEA_KEYS,
    .defaults = sea_defaults};
