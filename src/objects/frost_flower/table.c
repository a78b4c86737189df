// The keys of a frost flower.
#include "objects/common/tables.h"
#include "objects/frost_flower/frost_flower.h"

FrostFlowerParams frost_flower_params_default(void)
{
    return (FrostFlowerParams){.size = 0.04f,
                               .feathers = 34,
                               .spread = 78.0f,
                               .bend = 38.0f,
                               .feather_width = 0.42f,
                               .barbs = 24,
                               .orders = 2,
                               .angle = 60.0f,
                               .curl = 18.0f,
                               .skip = 0.04f,
                               .width_share = 0.22f,
                               .relief = 0.5f,
                               .rime = 0.8f};
}

static const Key FLOWER_KEYS[] = {
    {KEY_OF(FrostFlowerParams, position, "position", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Place on the ice."},
    {KEY_OF(FrostFlowerParams, rotation, "rotation", KEY_VECTOR), .count = 3, .low = -36000,
     .high = 36000, .unit = "degrees", .doc = "Rotation about x, then y, then z."},
    {KEY_OF(FrostFlowerParams, size, "size", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e3,
     .unit = "m", .doc = "About its width; 0.02 to 0.06 on young ice."},
    {KEY_OF(FrostFlowerParams, feathers, "feathers", KEY_INT), .low = 1, .high = 1000,
     .doc = "Number of feathers, each one crystal."},
    {KEY_OF(FrostFlowerParams, spread, "spread", KEY_FLOAT), .high = 88, .unit = "degrees",
     .doc = "Angle of the outermost feathers from upright where they leave the ice; the innermost "
            "stand upright."},
    {KEY_OF(FrostFlowerParams, uneven, "uneven", KEY_FLOAT), .high = 1,
     .doc =
         "0 = an even rosette; 1 = feathers stand in tufts with gaps between them, are long to one "
         "side and stunted to another, and twist."},
    {KEY_OF(FrostFlowerParams, bend, "bend", KEY_FLOAT), .low = -60, .high = 100, .unit = "degrees",
     .doc = "Angle by which the outer feathers bend outward to their tips, inward if negative; it "
            "varies from feather to feather."},
    {KEY_OF(FrostFlowerParams, feather_width, "feather_width", KEY_FLOAT), .flags = KEY_ABOVE,
     .high = 1, .doc = "Width of a feather, relative to its length."},
    {KEY_OF(FrostFlowerParams, barbs, "barbs", KEY_INT), .low = 3, .high = 200,
     .doc = "Barbs on each side of a feather of half the size."},
    {KEY_OF(FrostFlowerParams, orders, "orders", KEY_INT), .low = 1, .high = FLOWER_MOST_ORDERS,
     .doc = "Orders of branching: 1 = barbs alone, 2 = barbules on them, 3 = finer ones on those."},
    {KEY_OF(FrostFlowerParams, angle, "angle", KEY_FLOAT), .low = 20, .high = 90, .unit = "degrees",
     .doc = "Angle between a side and what bears it: 60 for ice."},
    {KEY_OF(FrostFlowerParams, curl, "curl", KEY_FLOAT), .high = 90, .unit = "degrees",
     .doc = "Angle by which sides bend toward the tip of what bears them."},
    {KEY_OF(FrostFlowerParams, skip, "skip", KEY_FLOAT), .high = 1,
     .doc = "Probability that a side does not grow."},
    {KEY_OF(FrostFlowerParams, width_share, "width_share", KEY_FLOAT), .flags = KEY_ABOVE,
     .high = 10, .doc = "Half-width of the finest blades, in distances between the finest sides."},
    {KEY_OF(FrostFlowerParams, relief, "relief", KEY_FLOAT), .flags = KEY_ABOVE, .high = 10,
     .doc = "Height of a blade's rib, relative to its half-width."},
    {KEY_OF(FrostFlowerParams, rime, "rime", KEY_FLOAT), .high = 1,
     .doc = "Share of the blades that are white with enclosed air instead of clear."},
    {0},
};

static void flower_defaults(void *out)
{
    *(FrostFlowerParams *)out = frost_flower_params_default();
}

const Table frost_flower_table = {
    .name = "frost_flower",
    .doc = "A frost flower: a rosette of feathers of ice, as they stand on thin new ice of lakes "
           "and seas in calm, cold air. Many of them: scatter. Materials: frost_flower/ice, "
           "frost_flower/rime.",
    .example = "objects:\n"
               "  - name: flowers\n"
               "    scatter: {count: 60, radius: 0.5, clump_size: 0.2, spacing: 0.02, things: "
               "[{frost_flower: {size: 0.04}}]}\n",
    .size = sizeof(FrostFlowerParams),
    .keys = FLOWER_KEYS,
    .defaults = flower_defaults};
