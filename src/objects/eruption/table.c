// The keys of an eruption.
#include "config/load.h"
#include "objects/eruption/eruption.h"

EruptionParams eruption_params_default(void)
{
    return (EruptionParams){.vent_width = 60.0f,
                            .bombs = 600,
                            .speed = 110.0f,
                            .spread = 17.0f,
                            .shutter = 12.0f,
                            .size = 1.6f,
                            .temperature = 1120.0f,
                            .radiance = 1.0f};
}

static const Key STREAM_KEYS[] = {
    {KEY_OF(LavaStream, at, "at", KEY_VECTOR), .flags = KEY_REQUIRED, .count = 2, .low = -1e6,
     .high = 1e6, .unit = "m", .doc = "Position x, z of its source, on the outer side of the rim."},
    {KEY_OF(LavaStream, width, "width", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1000, .unit = "m",
     .doc = "Mean width of a branch at the source; it swells, and ends narrower."},
    {KEY_OF(LavaStream, length, "length", KEY_FLOAT), .flags = KEY_ABOVE, .high = 12000,
     .unit = "m", .doc = "Way of the longest branch."},
    {KEY_OF(LavaStream, branches, "branches", KEY_INT), .low = 1, .high = 100,
     .doc = "Branches that set out together and part where the land parts them."},
    {0},
};

static void stream_defaults(void *out)
{
    *(LavaStream *)out = (LavaStream){.width = 14.0f, .length = 2000.0f, .branches = 4};
}

static const Table STREAM_TABLE = {
    .name = "eruption_stream",
    .doc = "A stream of lava that runs down the steepest way, cools and grows a crust.",
    .example = "objects:\n"
               "  - name: cone\n"
               "    terrain: {form: volcano, size: 16000, relief: 2000}\n"
               "  - name: fire\n"
               "    eruption: {on: cone, streams: [{at: [300, 0], width: 20, length: 2500}]}\n",
    .size = sizeof(LavaStream),
    .keys = STREAM_KEYS,
    .defaults = stream_defaults};

static const Key ERUPTION_KEYS[] = {
    {KEY_OF(EruptionParams, on, "on", KEY_TEXT), .flags = KEY_REQUIRED,
     .doc = "Name of the terrain that erupts."},
    {KEY_OF(EruptionParams, vent, "vent", KEY_VECTOR), .count = 2, .low = -1e6, .high = 1e6,
     .unit = "m", .doc = "Position x, z of the vent's middle."},
    {KEY_OF(EruptionParams, vent_width, "vent_width", KEY_FLOAT), .flags = KEY_ABOVE, .high = 10000,
     .unit = "m", .doc = "Width of the vent, from which bombs fly."},
    {KEY_OF(EruptionParams, bombs, "bombs", KEY_INT), .high = 1000000,
     .doc = "Number of glowing bombs that fly while the picture is exposed."},
    {KEY_OF(EruptionParams, speed, "speed", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1000,
     .unit = "m/s",
     .doc = "Speed at which the fastest leave the vent; most are slower. 110 throws them "
            "500 m high."},
    {KEY_OF(EruptionParams, spread, "spread", KEY_FLOAT), .high = 60, .unit = "degrees",
     .doc = "Standard deviation of their directions from the vertical."},
    {KEY_OF(EruptionParams, shutter, "shutter", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1000,
     .unit = "s",
     .doc = "Exposure of the picture: bombs draw streaks as long as they fly in this time."},
    {KEY_OF(EruptionParams, size, "size", KEY_FLOAT), .flags = KEY_ABOVE, .high = 100, .unit = "m",
     .doc = "Width of the largest streaks."},
    {KEY_OF(EruptionParams, temperature, "temperature", KEY_FLOAT), .low = 800, .high = 1300,
     .unit = "degrees C",
     .doc = "Temperature of lava where it comes out: 1150 = basalt, 950 = andesite. Cooler lava "
            "glows less, by Wien's law, and redder."},
    {KEY_OF(EruptionParams, radiance, "radiance", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e9,
     .unit = "W/(m^2 sr)", .doc = "Luminous radiance of lava of that temperature."},
    {KEY_OF(EruptionParams, stream, "streams", KEY_LIST),
     .count_offset = offsetof(EruptionParams, stream_count), .count = 1000, .table = &STREAM_TABLE,
     .doc = "Streams of lava."},
    {0},
};

static void eruption_defaults(void *out)
{
    *(EruptionParams *)out = eruption_params_default();
}

const Table eruption_table = {
    .name = "eruption",
    .doc = "What glows on an erupting volcano, as a long exposure at night shows it: streaks of "
           "bombs, and streams of lava with strands of glow in a dark crust. The ash above it is a "
           "cloud (clouds: kind: plume), the light in that a lamp at the vent.",
    .example = "objects:\n"
               "  - name: cone\n"
               "    terrain: {form: volcano, size: 16000, relief: 2000}\n"
               "  - name: fire\n"
               "    eruption: {on: cone, bombs: 800, speed: 120}\n",
    .size = sizeof(EruptionParams),
    .keys = ERUPTION_KEYS,
    .defaults = eruption_defaults};
