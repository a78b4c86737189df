// The keys of cracks in ice.
#include "objects/common/tables.h"
#include "objects/ice_cracks/ice_cracks.h"

IceCracksParams ice_cracks_params_default(void)
{
    return (IceCracksParams){.size = 6.0f,
                             .depth = 0.2f,
                             .spacing = 0.5f,
                             .stars = 0.25f,
                             .loose = 0.2f,
                             .wander = 25.0f,
                             .tilt = 9.0f,
                             .healed = 0.35f};
}

static const Key CRACK_KEYS[] = {
    {KEY_OF(IceCracksParams, position, "position", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Middle of the ice's surface."},
    {KEY_OF(IceCracksParams, rotation, "rotation", KEY_VECTOR), .count = 3, .low = -36000,
     .high = 36000, .unit = "degrees", .doc = "Rotation about x, then y, then z."},
    {KEY_OF(IceCracksParams, size, "size", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e5, .unit = "m",
     .doc = "Side of the square over which they run."},
    {KEY_OF(IceCracksParams, depth, "depth", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e3,
     .unit = "m", .doc = "Depth of the first cracks; later ones reach down less."},
    {KEY_OF(IceCracksParams, spacing, "spacing", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e5,
     .unit = "m",
     .doc = "Mean distance from crack to crack along a line over the ice; at least a thousandth of "
            "size."},
    {KEY_OF(IceCracksParams, stars, "stars", KEY_FLOAT), .high = 1,
     .doc = "Share of the cracks that open as three, 120 degrees apart; the others run two ways."},
    {KEY_OF(IceCracksParams, loose, "loose", KEY_FLOAT), .high = 1,
     .doc = "Share of the ends that stop in the ice, unless they meet an older crack before."},
    {KEY_OF(IceCracksParams, wander, "wander", KEY_FLOAT), .high = 90, .unit = "degrees",
     .doc = "Angle by which a crack turns over a spacing, root mean square."},
    {KEY_OF(IceCracksParams, tilt, "tilt", KEY_FLOAT), .high = 45, .unit = "degrees",
     .doc = "Angle of the faces from vertical, root mean square; it varies along a crack."},
    {KEY_OF(IceCracksParams, healed, "healed", KEY_FLOAT), .high = 1,
     .doc = "Share of the faces that have frozen together again, in patches: there the ice is "
            "clear."},
    {KEY_OF(IceCracksParams, grain, "grain", KEY_FLOAT), .high = 1e3, .unit = "m",
     .doc = "Size of the finest structure of the faces; 0 = a hundredth of the spacing. At least "
            "0.0001 of the depth and the spacing is used."},
    {0},
};

static void crack_defaults(void *out)
{
    *(IceCracksParams *)out = ice_cracks_params_default();
}

const Table ice_cracks_table = {
    .name = "ice_cracks",
    .doc =
        "Cracks in a sheet of clear ice: white faces that go down into it, each from where the "
        "ice was farthest from older cracks to those that it met. The ice itself is a shape of a "
        "dielectric or of water. Material: ice_cracks/air.",
    .example =
        "objects:\n"
        "  - name: ice\n"
        "    material: black_ice\n"
        "    shape: {envelope: [{shape: box, size: [20, 0.1, 20], position: [0, -0.1, 0]}]}\n"
        "  - name: cracks\n"
        "    ice_cracks: {size: 6, depth: 0.2, spacing: 0.4}\n"
        "materials:\n"
        "  - {name: black_ice, kind: water, ior: 1.31, absorption: [1.2, 0.5, 0.35]}\n",
    .size = sizeof(IceCracksParams),
    .keys = CRACK_KEYS,
    .defaults = crack_defaults};
