// The keys of a swarm.
#include "objects/common/tables.h"
#include "objects/swarm/swarm.h"

SwarmParams swarm_params_default(void)
{
    return (SwarmParams){.count = 100,
                         .clump_size = 1.0f,
                         .scale = {0.8f, 1.2f},
                         .swirl_size = 1.0f,
                         .things.variants = 3};
}

static const Key SWARM_KEYS[] = {
    THINGS_ROWS(SwarmParams),
    {KEY_OF(SwarmParams, shapes, "envelope", KEY_LIST),
     .count_offset = offsetof(SwarmParams, shape_count), .flags = KEY_REQUIRED, .low = 1,
     .count = 1000, .table = &shape_table,
     .doc = "Region that the copies fill: shapes, combined in this order."},
    {KEY_OF(SwarmParams, voxel, "voxel", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Voxel size of the envelope's level set, unless it is a single plain shape; 0 = 1/128 "
            "of its largest extent."},
    {KEY_OF(SwarmParams, count, "count", KEY_INT64), .low = 1, .high = 1e7,
     .doc = "Number of copies; fewer, with a warning, if there is no room for all."},
    {KEY_OF(SwarmParams, spacing, "spacing", KEY_FLOAT), .high = 1e5, .unit = "m",
     .doc = "Minimum distance between two copies' origins; 0 = none."},
    {KEY_OF(SwarmParams, clumping, "clumping", KEY_FLOAT), .high = 1,
     .doc = "Distribution: 0 = uniform, 1 = in clumps with empty space between them."},
    {KEY_OF(SwarmParams, clump_size, "clump_size", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e6,
     .unit = "m", .doc = "Distance from clump to clump."},
    {KEY_OF(SwarmParams, scale, "scale", KEY_VECTOR), .flags = KEY_ABOVE, .count = 2, .high = 1000,
     .doc = "Smallest and largest size of a copy, relative to the thing's."},
    {KEY_OF(SwarmParams, azimuth, "azimuth", KEY_FLOAT), .low = -360, .high = 360,
     .unit = "degrees", .doc = "Where the copies head: clockwise from north (-z)."},
    {KEY_OF(SwarmParams, stray, "stray", KEY_FLOAT), .high = 180, .unit = "degrees",
     .doc = "Greatest random turn of a copy from the heading of those around it; 180 = any."},
    {KEY_OF(SwarmParams, swirl, "swirl", KEY_FLOAT), .high = 360, .unit = "degrees",
     .doc = "Greatest turn of the heading from place to place: neighbours turn alike."},
    {KEY_OF(SwarmParams, swirl_size, "swirl_size", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e6,
     .unit = "m", .doc = "Distance over which the heading turns."},
    {KEY_OF(SwarmParams, climb, "climb", KEY_FLOAT), .high = 90, .unit = "degrees",
     .doc = "Greatest random angle of a copy's heading above or below the horizontal."},
    {KEY_OF(SwarmParams, roll, "roll", KEY_FLOAT), .high = 180, .unit = "degrees",
     .doc = "Greatest random roll about the heading, to any side; 180 = any."},
    VARIANTS_ROW(SwarmParams),
    {0},
};

static bool check_swarm(const Mapping *mapping, void *params)
{
    const SwarmParams *swarm = params;
    return check_shapes(mapping, "envelope", swarm->shapes, swarm->shape_count) &&
           check_range(mapping, "scale", swarm->scale);
}

static void swarm_defaults(void *out)
{
    *(SwarmParams *)out = swarm_params_default();
}

const Table swarm_table = {
    .name = "swarm",
    .doc = "Copies of any objects in a region of space: a school of fish, a flock of birds, leaves "
           "or snowflakes in the air. A copy's z axis points where it heads, its y axis up.",
    .example = "objects:\n"
               "  - name: birds\n"
               "    swarm:\n"
               "      envelope: [{shape: ellipsoid, size: [20, 6, 12], position: [0, 40, -60]}]\n"
               "      count: 300\n"
               "      spacing: 0.6\n"
               "      azimuth: 80\n"
               "      swirl: 60\n"
               "      swirl_size: 15\n"
               "      roll: 30\n"
               "      things:\n"
               "        - {shape: {envelope: [{shape: ellipsoid, size: [0.25, 0.02, 0.08]}]}}\n",
    .size = sizeof(SwarmParams),
    .keys = SWARM_KEYS,
    .defaults = swarm_defaults,
    .check = check_swarm};
