// The table of hoar frost.
#include "config/table.h"
#include "objects/common/hoar.h"

static const EnumName HABITS[] = {{"needles", HOAR_NEEDLES}, {"feathers", HOAR_FEATHERS}, {0}};

static const Key HOAR_KEYS[] = {
    {KEY_OF(HoarParams, length, "length", KEY_FLOAT), .high = 1, .unit = "m",
     .doc = "Length of the needles on thin twigs and edges: 0.005 after a clear night, 0.03 after "
            "days of freezing fog; 0 = no frost."},
    {KEY_OF(HoarParams, density, "density", KEY_FLOAT), .flags = KEY_ABOVE, .high = 10,
     .doc = "Number of tufts, relative to a closed cover of needles."},
    {KEY_OF(HoarParams, wind, "wind", KEY_FLOAT), .low = -360, .high = 360, .unit = "degrees",
     .doc = "Azimuth the wind blows toward, from +Z toward +X."},
    {KEY_OF(HoarParams, bias, "bias", KEY_FLOAT), .high = 1,
     .doc = "Growth against the wind: 0 = hoar frost of still air, all around; 1 = rime, on the "
            "windward side alone."},
    {KEY_OF(HoarParams, sky, "sky", KEY_FLOAT), .high = 1,
     .doc =
         "Growth by radiation: 0 = all sides are equally cold, as in fog; 1 = of a clear night: as "
         "much as a side sees of the sky, none underneath. A mesh or shape shades itself."},
    {KEY_OF(HoarParams, thickest, "thickest", KEY_FLOAT), .flags = KEY_ABOVE, .high = 10,
     .unit = "m", .doc = "Radius of branches and thin parts on which needles are half as long."},
    {KEY_OF(HoarParams, habit, "habit", KEY_ENUM), .names = HABITS,
     .doc = "needles: with a few barbs, as in the cold; feathers: flat fronds with rows of blades "
            "at 60 degrees, as of moist air at -10 to -20 degrees Celsius."},
    {KEY_OF(HoarParams, variety, "variety", KEY_FLOAT), .high = 1,
     .doc =
         "How unlike each other the tufts are: 0 = much the same everywhere; 1 = most are small, "
         "few are large, and these stand in patches."},
    {KEY_OF(HoarParams, max_count, "max_count", KEY_INT64), .low = 1, .high = 1e9,
     .doc = "Maximum number of tufts; with a warning, fewer stand farther apart."},
    {0},
};

HoarParams hoar_params_default(void)
{
    return (HoarParams){.density = 1.0f, .bias = 0.3f, .thickest = 0.01f, .max_count = 3000000};
}

static void hoar_defaults(void *out)
{
    *(HoarParams *)out = hoar_params_default();
}

const Table hoar_table = {
    .name = "hoar",
    .doc = "Hoar frost: tufts of feathered ice needles, on all branches of a tree "
           "or on a mesh or shape, denser and longer on edges and thin parts.",
    .example = "objects:\n"
               "  - name: birch\n"
               "    tree: {species: silver_birch, height: 12, season: 1, "
               "hoar: {length: 0.02, bias: 0.5}}\n"
               "  - name: post\n"
               "    shape: {envelope: [{shape: box, size: [0.05, 1, 0.05]}], "
               "hoar: {length: 0.01, sky: 1}}\n",
    .size = sizeof(HoarParams),
    .keys = HOAR_KEYS,
    .defaults = hoar_defaults};
