// Keys of showers.
#include "render/rain/rain.h"
#include "scene/spec.h"

static const Key SHOWER_KEYS[] = {
    {KEY_OF(Shower, center_x, "center", KEY_VECTOR), .count = 2, .low = -1e6, .high = 1e6,
     .unit = "m", .doc = "Position x, z of the shower where it leaves the cloud."},
    {KEY_OF(Shower, radius, "radius", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e5, .unit = "m",
     .doc = "Radius of the shower; it fades out from a third of it."},
    {KEY_OF(Shower, base, "base", KEY_FLOAT), .low = -1000, .high = 20000, .unit = "m",
     .doc = "Altitude of the underside of the cloud, above y = 0."},
    {KEY_OF(Shower, bottom, "bottom", KEY_FLOAT), .low = -1000, .high = 20000, .unit = "m",
     .doc = "Altitude at which the drops have evaporated (virga); -1000 = they reach the ground."},
    {KEY_OF(Shower, rate, "rate", KEY_FLOAT), .high = 300, .unit = "mm/h",
     .doc = "Rain in the middle: 2 = light, 10 = moderate, 50 = heavy, 100 = a cloudburst."},
    {KEY_OF(Shower, wind, "wind", KEY_FLOAT), .low = -360, .high = 360, .unit = "degrees",
     .doc = "Azimuth that the drops drift to, from +Z toward +X."},
    {KEY_OF(Shower, lean, "lean", KEY_FLOAT), .high = 80, .unit = "degrees",
     .doc = "Angle between the falling rain and the vertical."},
    {KEY_OF(Shower, streaks, "streaks", KEY_FLOAT), .high = 1,
     .doc = "How much the rain falls in shafts and veils: 0 = evenly, 1 = with gaps."},
    {KEY_OF(Shower, ragged, "ragged", KEY_FLOAT), .high = 1,
     .doc = "How far the shower's edge is frayed: 0 = round and even, 1 = in lobes and threads, "
            "whose thin rain dries up before it reaches the ground."},
    {KEY_OF(Shower, seed, "seed", KEY_INT), .high = 1e9,
     .doc = "Changes the streaks of this shower alone."},
    {0},
};

static void shower_defaults(void *out)
{
    *(Shower *)out = shower_default();
}

const Table shower_table = {
    .name = "shower",
    .doc =
        "A shaft of rain below a cloud. Its drops scatter sunlight and skylight; with the sun "
        "behind "
        "the camera and lower than 42 degrees they show the rainbow. Only rays from the camera and "
        "mirror reflections see rain, and light is scattered by it once.",
    .example = "showers:\n"
               "  - {center: [500, -6000], radius: 2500, rate: 20, base: 1200}\n",
    .size = sizeof(Shower),
    .keys = SHOWER_KEYS,
    .defaults = shower_defaults};
