// Climbing plants.
#include "objects/climber/climber.h"
#include "objects/common/tables.h"

static const Key START_KEYS[] = {
    {KEY_OF(ClimberStart, position, "position", KEY_VECTOR), .flags = KEY_REQUIRED, .count = 3,
     .unit = "m", .doc = "Position; it moves to the nearest point of the surface."},
    {0},
};

static const Table START_TABLE = {.name = "climber_start",
                                  .doc = "Where a stem of a climber starts.",
                                  .size = sizeof(ClimberStart),
                                  .keys = START_KEYS};

static const Key HANGING_KEYS[] = {
    {KEY_OF(HangingParams, count, "count", KEY_INT64), .high = 10000000,
     .doc = "About how many shoots leave the surface; 0 = none."},
    {KEY_OF(HangingParams, length, "length", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1000,
     .unit = "m", .doc = "Length of the longest."},
    {KEY_OF(HangingParams, droop, "droop", KEY_FLOAT), .high = 1,
     .doc = "From stiff shoots (0) to shoots that hang like strings (1)."},
    {KEY_OF(HangingParams, clumping, "clumping", KEY_FLOAT), .high = 1,
     .doc = "Distribution: 0 = uniform, 1 = in masses that bulge, of many long shoots, between "
            "places with none."},
    {KEY_OF(HangingParams, clump_size, "clump_size", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1000,
     .unit = "m", .doc = "Distance from mass to mass."},
    {0},
};

static const Table HANGING_TABLE = {.name = "climber_hanging",
                                    .doc = "Shoots that find nothing to hold and hang free.",
                                    .size = sizeof(HangingParams),
                                    .keys = HANGING_KEYS};

static const Key ROOTLET_KEYS[] = {
    {KEY_OF(RootletParams, spacing, "spacing", KEY_FLOAT), .high = 10, .unit = "m",
     .doc = "Distance between them along a stem of 3 mm radius where they stand in a bunch; on "
            "thicker stems up to 6 times as many. 0 = none."},
    {KEY_OF(RootletParams, length, "length", KEY_FLOAT), .flags = KEY_ABOVE, .high = 10,
     .unit = "m", .doc = "Length of the longest."},
    {KEY_OF(RootletParams, radius, "radius", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1, .unit = "m",
     .doc = "Radius where they leave the stem."},
    {0},
};

static const Table ROOTLET_TABLE = {.name = "climber_rootlets",
                                    .doc = "Short roots by which stems hold to the surface, of the "
                                           "bark's material.",
                                    .size = sizeof(RootletParams),
                                    .keys = ROOTLET_KEYS};

static const Key CLIMBER_KEYS[] = {
    {KEY_OF(ClimberParams, species, "species", KEY_TEXT),
     .doc = "Name of a species of the library, or path of a species file relative to this file: "
            "see the tree's key."},
    {KEY_OF(ClimberParams, climbs, "climbs", KEY_TEXT), .flags = KEY_REQUIRED,
     .doc = "Name of the object that it climbs: a mesh, a shape, a terrain or anything else with a "
            "skin."},
    {KEY_OF(ClimberParams, starts, "starts", KEY_LIST), .flags = KEY_REQUIRED,
     .count_offset = offsetof(ClimberParams, start_count), .count = 10000, .table = &START_TABLE,
     .doc = "Where its stems start, at the foot of what it climbs."},
    {KEY_OF(ClimberParams, height, "height", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1000,
     .unit = "m", .doc = "How far above a start it climbs."},
    {KEY_OF(ClimberParams, spread, "spread", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1000,
     .unit = "m", .doc = "How far to each side of a start it spreads."},
    {KEY_OF(ClimberParams, spacing, "spacing", KEY_FLOAT), .flags = KEY_ABOVE, .high = 100,
     .unit = "m", .doc = "Distance between the finest stems."},
    {KEY_OF(ClimberParams, patchiness, "patchiness", KEY_FLOAT), .high = 1,
     .doc = "How much of the surface within its reach it leaves bare, in patches."},
    {KEY_OF(ClimberParams, climb, "climb", KEY_FLOAT), .high = 100,
     .doc = "Tendency to grow upward."},
    {KEY_OF(ClimberParams, wander, "wander", KEY_FLOAT), .high = 10,
     .doc = "Random deviation of its directions."},
    {KEY_OF(ClimberParams, offset, "offset", KEY_FLOAT), .high = 10, .unit = "m",
     .doc = "Gap between the stems and the surface."},
    {KEY_OF(ClimberParams, hanging, "hanging", KEY_GROUP), .table = &HANGING_TABLE,
     .doc = "Shoots that find nothing to hold and hang free."},
    {KEY_OF(ClimberParams, rootlets, "rootlets", KEY_GROUP), .table = &ROOTLET_TABLE,
     .doc = "Short roots by which stems hold to the surface, as ivy's."},
    {KEY_OF(ClimberParams, root_radius, "root_radius", KEY_FLOAT), .flags = KEY_ABOVE, .high = 10,
     .unit = "m", .doc = "Radius of the stems where they start."},
    {KEY_OF(ClimberParams, radii, "radii", KEY_GROUP), .table = &radii_table,
     .doc = "Thickness of the stems: tip and exponent."},
    {KEY_OF(ClimberParams, leaves, "leaves", KEY_GROUP), .table = &leaves_table,
     .doc = "Leaves; they face away from the surface."},
    {KEY_OF(ClimberParams, organs, "organs", KEY_LIST),
     .count_offset = offsetof(ClimberParams, organ_count), .count = 20, .table = &organ_table,
     .doc = "Blossom, berries and other organs on the stems, on the side away from the surface."},
    PHENOLOGY_ROWS(ClimberParams),
    {KEY_OF(ClimberParams, skin, "skin", KEY_GROUP), .table = &skin_table,
     .doc = "Surface of the stems: a mesh where they are thick, round curves where they are thin."},
    {0},
};

static void climber_defaults(void *out)
{
    *(ClimberParams *)out = climber_params_default();
}

static bool check_climber(const Mapping *mapping, void *params)
{
    ClimberParams *given = params;
    return phenology_check(mapping, &given->phenology, given->season, given->latitude,
                           &given->leaves);
}

const Table climber_table = {
    .name = "climber",
    .doc = "A climbing plant on another object, such as ivy on a wall: stems spread over its "
           "surface, shoots hang where they find nothing to hold, leaves face outward. The "
           "defaults make ivy. Materials: bark, twig, leaf, and of organs as a tree's.",
    .example =
        "objects:\n"
        "  - name: wall\n"
        "    shape: {envelope: [{shape: box, size: [3, 2, 0.2], position: [0, 2, 0]}]}\n"
        "  - name: ivy\n"
        "    climber: {climbs: wall, starts: [{position: [-1, 0, 0.2]}], height: 3, spread: 2}\n",
    .size = sizeof(ClimberParams),
    .keys = CLIMBER_KEYS,
    .defaults = climber_defaults,
    .check = check_climber};
