// The keys of a cascade.
#include "config/load.h"
#include "objects/cascade/cascade.h"

CascadeParams cascade_params_default(void)
{
    return (CascadeParams){.from = {-0.5f, 1.0f, 0.0f},
                           .to = {0.5f, 1.0f, 0.0f},
                           .discharge = 0.02f,
                           .speed = 0.7f,
                           .strands = 3000,
                           .width = 0.008f,
                           .gather = 0.5f,
                           .wander = 0.3f,
                           .drift = 1.5f};
}

static const Key CASCADE_KEYS[] = {
    {KEY_OF(CascadeParams, over, "over", KEY_TEXT), .flags = KEY_REQUIRED,
     .doc =
         "Name of the object that it runs over: a shape, a mesh, a terrain or anything else with "
         "a skin."},
    {KEY_OF(CascadeParams, from, "from", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Left end, seen upstream, of the line across the stream from which its water comes; "
            "its places move to the nearest point of the surface."},
    {KEY_OF(CascadeParams, to, "to", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Right end of that line. The water leaves it at a right angle, toward the viewer."},
    {KEY_OF(CascadeParams, discharge, "discharge", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e4,
     .unit = "m^3/s",
     .doc = "Water that it brings: 0.01 = a brook, thin veils; 0.05 a metre of "
            "width = closed sheets."},
    {KEY_OF(CascadeParams, speed, "speed", KEY_FLOAT), .flags = KEY_ABOVE, .high = 100,
     .unit = "m/s", .doc = "Its speed at the line."},
    {KEY_OF(CascadeParams, level, "level", KEY_FLOAT), .low = -1e6, .high = 1e6, .unit = "m",
     .doc = "Height of the pool in which it ends."},
    {KEY_OF(CascadeParams, strands, "strands", KEY_INT), .low = 1, .high = 1000000,
     .doc = "Number of ways of its water that are followed: some for each width of a strand across "
            "it make smooth silk."},
    {KEY_OF(CascadeParams, width, "width", KEY_FLOAT), .flags = KEY_ABOVE, .high = 100, .unit = "m",
     .doc = "Width of a strand."},
    {KEY_OF(CascadeParams, gather, "gather", KEY_FLOAT), .high = 1,
     .doc = "How unevenly water leaves the line: 0 = as a sheet, 1 = in tongues and threads."},
    {KEY_OF(CascadeParams, wander, "wander", KEY_FLOAT), .high = 1,
     .doc = "How far turbulence moves strands aside: 0 = fine threads that never mix, 1 = soft "
            "veils."},
    {KEY_OF(CascadeParams, drift, "drift", KEY_FLOAT), .high = 60, .unit = "s",
     .doc = "Time in which its foam fades to 1/e on the pool; 0 = there is none."},
    {0},
};

static void cascade_defaults(void *out)
{
    *(CascadeParams *)out = cascade_params_default();
}

static bool check_cascade(const Mapping *mapping, void *params)
{
    const CascadeParams *cascade = params;
    Vec3 line = vec3_sub(cascade->to, cascade->from);
    return line.x != 0.0f || line.z != 0.0f ||
           mapping_fail(mapping, "to",
                        " is where 'from' is, seen from above; they must lie apart, for the water "
                        "leaves their line at a right angle");
}

const Table cascade_table = {
    .name = "cascade",
    .doc = "A small fall of water over the rock of another object, as an exposure of half a second "
           "or more shows it: strands part at bulges, thin veils slide over ledges, foam drifts on "
           "the pool at its foot. The kind makes the clear film on the rock; its white water is a "
           "cloud (clouds: kind: spray, of: water), its mist another (of: mist). The pool is an "
           "object of its own.",
    .example = "clouds:\n"
               "  - {kind: spray, of: water, over: fall, extinction: 1}\n"
               "objects:\n"
               "  - name: rock\n"
               "    shape: {envelope: [{shape: box, size: [1, 0.5, 0.5]}]}\n"
               "  - name: fall\n"
               "    cascade: {over: rock, from: [-0.4, 0.5, 0.2], to: [0.4, 0.5, 0.2]}\n",
    .size = sizeof(CascadeParams),
    .keys = CASCADE_KEYS,
    .defaults = cascade_defaults,
    .check = check_cascade};
