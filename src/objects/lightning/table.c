// Lightning.
#include "objects/common/tables.h"
#include "objects/lightning/lightning.h"

static const Key LIGHTNING_KEYS[] = {
    {KEY_OF(LightningParams, position, "position", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Where the first bolt strikes. Over a surface the envelope says where everything is."},
    {KEY_OF(LightningParams, height, "height", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e6,
     .unit = "m",
     .doc = "From there to where the bolt leaves the cloud; what is left out elsewhere follows it. "
            "Over a surface lengths follow the envelope instead."},
    {KEY_OF(LightningParams, lean, "lean", KEY_FLOAT), .high = 180, .flags = KEY_BELOW,
     .unit = "degrees",
     .doc = "Angle from the vertical of the way to the cloud. Over a surface the first discharge "
            "starts at the point that lies furthest this way."},
    {KEY_OF(LightningParams, lean_azimuth, "lean_azimuth", KEY_FLOAT), .low = -360, .high = 360,
     .unit = "degrees", .doc = "Where that way leads, from +Z toward +X."},
    {KEY_OF(LightningParams, bolts, "bolts", KEY_INT), .low = 1, .high = 1000,
     .doc = "Bolts side by side; over a surface, points that discharges start from."},
    {KEY_OF(LightningParams, bolt_spread, "bolt_spread", KEY_FLOAT), .high = 1e6, .unit = "m",
     .doc = "Distance between bolts; 0 = 0.45 of the height."},
    {KEY_OF(LightningParams, ground_points, "ground_points", KEY_INT), .low = 1, .high = 16,
     .doc = "Ends of a bolt's main channel on the ground; 2 = a forked flash."},
    {KEY_OF(LightningParams, streamers, "streamers", KEY_INT), .high = 100,
     .doc = "Short leaders that rise from the ground about the strike."},
    {KEY_OF(LightningParams, spread, "spread", KEY_FLOAT), .flags = KEY_ABOVE, .high = 10,
     .doc = "Half-width at the ground of the space that side branches fill, as a share of the "
            "height."},
    {KEY_OF(LightningParams, branching, "branching", KEY_FLOAT), .high = 100,
     .doc = "Factor on the number of side branches; 0 = only the main channel."},
    ELEMENT_ROWS(LightningParams),
    {KEY_OF(LightningParams, hurst, "hurst", KEY_FLOAT), .flags = KEY_ABOVE | KEY_BELOW, .high = 1,
     .doc = "Hurst exponent of the wandering: the smaller, the rougher."},
    {KEY_OF(LightningParams, jitter, "jitter", KEY_FLOAT), .high = 10,
     .doc = "How far ways wander: standard deviation that a free way as long as the height would "
            "have at its end, as a share of the height."},
    {KEY_OF(LightningParams, step, "step", KEY_FLOAT), .high = 1e5, .unit = "m",
     .doc = "Length of the leader's steps; 0 = 1/40 of the height. About 50 in nature."},
    {KEY_OF(LightningParams, segment, "segment", KEY_FLOAT), .high = 1e5, .unit = "m",
     .doc = "Length of the segments drawn; 0 = 1/400 of the height."},
    {KEY_OF(LightningParams, radius, "radius", KEY_FLOAT), .high = 1e4, .unit = "m",
     .doc = "Radius of the main channel as it is drawn; 0 = 1/1600 of the height, over a surface "
            "1/700 of its extent. Thicker than in nature, so that a pixel can see it; what it "
            "sends out is `power` all the same."},
    {KEY_OF(LightningParams, power, "power", KEY_FLOAT), .high = 1e12, .unit = "W/m",
     .doc = "Radiant power of the main channel per metre; 0 = in proportion to its radius, so that "
            "a bolt of any size looks as bright. The material gives the colour."},
    {KEY_OF(LightningParams, branch_power, "branch_power", KEY_FLOAT), .high = 1,
     .doc = "Power of a side branch where it leaves the main channel, as a share of the main's."},
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
    .doc = "Lightning in the air, or (points.place: surface) over the surface of an envelope "
           "(Tanaka et al., section 5.2). Material: lightning.",
    .example = "objects:\n"
               "  - name: bolt\n"
               "    lightning: {height: 900, branching: 1.5, ground_points: 2}\n",
    .size = sizeof(LightningParams),
    .keys = LIGHTNING_KEYS,
    .defaults = lightning_defaults,
    .check = check_lightning};
