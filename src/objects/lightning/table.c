// Lightning.
#include "objects/common/tables.h"
#include "objects/lightning/lightning.h"

static const Key LIGHTNING_KEYS[] = {
    {KEY_OF(LightningParams, position, "position", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Strike point of the first bolt. Over a surface, the envelope determines the position "
            "instead."},
    {KEY_OF(LightningParams, height, "height", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e6,
     .unit = "m",
     .doc = "Distance from the strike point to where the bolt leaves the cloud; lengths that are "
            "omitted or 0 follow it. Over a surface, lengths follow the envelope instead."},
    {KEY_OF(LightningParams, lean, "lean", KEY_FLOAT), .high = 180, .flags = KEY_BELOW,
     .unit = "degrees",
     .doc = "Angle between the vertical and the direction to the cloud. Over a surface, the first "
            "discharge starts at the farthest point in this direction."},
    {KEY_OF(LightningParams, lean_azimuth, "lean_azimuth", KEY_FLOAT), .low = -360, .high = 360,
     .unit = "degrees", .doc = "Azimuth of that direction, from +Z toward +X."},
    {KEY_OF(LightningParams, bolts, "bolts", KEY_INT), .low = 1, .high = 1000,
     .doc =
         "Number of bolts side by side; over a surface, number of points where discharges start."},
    {KEY_OF(LightningParams, bolt_spread, "bolt_spread", KEY_FLOAT), .high = 1e6, .unit = "m",
     .doc = "Distance between bolts; 0 = 0.45 of the height."},
    {KEY_OF(LightningParams, ground_points, "ground_points", KEY_INT), .low = 1, .high = 16,
     .doc = "Number of points where a bolt's main channel meets the ground; 2 = a forked flash."},
    {KEY_OF(LightningParams, streamers, "streamers", KEY_INT), .high = 100,
     .doc = "Number of short leaders that rise from the ground around the strike point."},
    {KEY_OF(LightningParams, spread, "spread", KEY_FLOAT), .flags = KEY_ABOVE, .high = 10,
     .doc = "Half-width, at the ground, of the space that side branches fill, as a fraction of the "
            "height."},
    {KEY_OF(LightningParams, branching, "branching", KEY_FLOAT), .high = 100,
     .doc = "Multiplier of the number of side branches; 0 = only the main channel."},
    ELEMENT_ROWS(LightningParams),
    {KEY_OF(LightningParams, hurst, "hurst", KEY_FLOAT), .flags = KEY_ABOVE | KEY_BELOW, .high = 1,
     .doc = "Hurst exponent of the channels' deviations; a smaller one is rougher."},
    {KEY_OF(LightningParams, jitter, "jitter", KEY_FLOAT), .high = 10,
     .doc = "Deviation of channels from a straight line: standard deviation at the end of a free "
            "channel as long as the height, as a fraction of the height."},
    {KEY_OF(LightningParams, step, "step", KEY_FLOAT), .high = 1e5, .unit = "m",
     .doc = "Length of the leader's steps; 0 = 1/40 of the height. About 50 m in nature."},
    {KEY_OF(LightningParams, segment, "segment", KEY_FLOAT), .high = 1e5, .unit = "m",
     .doc = "Length of the segments rendered; 0 = 1/400 of the height."},
    {KEY_OF(LightningParams, radius, "radius", KEY_FLOAT), .high = 1e4, .unit = "m",
     .doc = "Rendered radius of the main channel; 0 = 1/1600 of the height, or over a surface "
            "1/700 of its extent. It is larger than in nature to be visible at pixel size; the "
            "emitted power is `power` in any case."},
    {KEY_OF(LightningParams, power, "power", KEY_FLOAT), .high = 1e12, .unit = "W/m",
     .doc = "Radiant power of the main channel per metre; 0 = proportional to its radius, so that "
            "bolts of any size look equally bright. The material sets the colour."},
    {KEY_OF(LightningParams, branch_power, "branch_power", KEY_FLOAT), .high = 1,
     .doc = "Power of a side branch where it leaves the main channel, as a fraction of the main "
            "channel's power, if all channels beyond are at least `drain` long; less in proportion "
            "where they are shorter, so branches dim at forks and toward tips."},
    {KEY_OF(LightningParams, drain, "drain", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e6,
     .doc = "Length of all channels beyond a branch, in heights, that gives it this power. In a "
            "dense discharge more, so that its twigs stand back behind its limbs."},
    {KEY_OF(LightningParams, taper, "taper", KEY_FLOAT), .low = 0.01, .high = 1,
     .doc =
         "A channel's radius is in proportion to its power to this exponent, its radiance to the "
         "rest of the power: 1 = dim channels are thin and as bright as the main one, 0.01 = all "
         "are equally thick, and dim ones dark."},
    {KEY_OF(LightningParams, lift, "lift", KEY_FLOAT), .high = 1e4, .unit = "m",
     .doc = "Height above the surface; 0 = twice the radius."},
    {0},
};

static void lightning_defaults(void *out)
{
    *(LightningParams *)out = lightning_params_default();
}

static bool check_lightning(const Mapping *mapping, void *params)
{
    const ElementParams *element = &((const LightningParams *)params)->element;
    if (element->points.place == SCATTER_SURFACE && element->shape_count == 0) {
        return mapping_fail(mapping, NULL,
                            " grows over a surface but has no envelope; give it one");
    }
    return check_element(mapping, element);
}

const Table lightning_table = {
    .name = "lightning",
    .doc = "Lightning in the air or, with points.place: surface, over the surface of an envelope "
           "(Tanaka et al., section 5.2). Material: lightning.",
    .example = "objects:\n"
               "  - name: bolt\n"
               "    lightning: {height: 900, branching: 1.5, ground_points: 2}\n",
    .size = sizeof(LightningParams),
    .keys = LIGHTNING_KEYS,
    .defaults = lightning_defaults,
    .check = check_lightning};
