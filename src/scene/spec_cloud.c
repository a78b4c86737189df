// Keys of clouds.
#include "render/cloud/cloud.h"
#include "scene/spec.h"

#define BIT(kind) (1u << (kind))

static const EnumName KINDS[] = {{"cumulus", CLOUD_CUMULUS},
                                 {"stratus", CLOUD_STRATUS},
                                 {"storm", CLOUD_STORM},
                                 {"fog", CLOUD_FOG},
                                 {0}};

static const Key CLOUD_KEYS[] = {
    {KEY_OF(Cloud, kind, "kind", KEY_ENUM), .names = KINDS,
     .doc = "cumulus: heaps of all sizes and ages on one flat base, all over the land; stratus: a "
            "sheet, closed or torn; "
            "storm: one cumulonimbus, whose anvil the wind draws out; fog: fills the air from its "
            "base, densest there, up to a wavy top with wisps, out of which higher land stands."},
    {KEY_OF(Cloud, base, "base", KEY_FLOAT), .low = -1000, .high = 20000, .unit = "m",
     .doc = "Altitude of the underside above y = 0. That of fog may lie anywhere below the lowest "
            "land."},
    {KEY_OF(Cloud, thickness, "thickness", KEY_FLOAT), .flags = KEY_ABOVE, .high = 20000,
     .unit = "m",
     .doc = "Height of the tallest heaps, of the sheet, of the storm, or of the fog's highest "
            "swells, above the base."},
    {KEY_OF(Cloud, cover, "cover", KEY_FLOAT),
     .kinds = BIT(CLOUD_CUMULUS) | BIT(CLOUD_STRATUS) | BIT(CLOUD_FOG), .high = 1,
     .doc = "Share of the sky that they cover, seen from below; of the fog, what holes leave."},
    {KEY_OF(Cloud, size, "size", KEY_FLOAT), .flags = KEY_ABOVE, .low = 50, .high = 20000,
     .unit = "m",
     .doc = "Width of the large heaps, which many smaller ones surround; of the rolls of a sheet "
            "or fog; of the storm below its anvil."},
    {KEY_OF(Cloud, extinction, "extinction", KEY_FLOAT), .high = 1, .unit = "1/m",
     .doc = "Extinction where droplets are dense, from a quarter of the thickness up, or at the "
            "base of fog: 0.05 = one sees 60 m far in it; 0.003 for veils of ice."},
    {KEY_OF(Cloud, softness, "softness", KEY_FLOAT), .kinds = BIT(CLOUD_CUMULUS) | BIT(CLOUD_STORM),
     .high = 1,
     .doc = "How far dry air has worn the borders: more with age, down the flanks, and of small "
            "heaps. 0 = firm as a cauliflower wherever air rises; 0.5 = firm at young tops, torn "
            "below; 1 = wisps all over but at the youngest tops."},
    {KEY_OF(Cloud, wind, "wind", KEY_FLOAT), .low = -360, .high = 360, .unit = "degrees",
     .doc = "Azimuth the wind blows toward, from +Z toward +X: heaps and anvils are longer along "
            "it."},
    {KEY_OF(Cloud, center_x, "center", KEY_VECTOR), .count = 2, .kinds = BIT(CLOUD_STORM),
     .low = -1e6, .high = 1e6, .unit = "m", .doc = "Position x, z of the storm's main tower."},
    {KEY_OF(Cloud, seed, "seed", KEY_INT), .high = 1e9,
     .doc = "Changes the form of these clouds alone."},
    {0},
};

static void cloud_defaults(const Node *given, int kind, void *out)
{
    (void)given;
    *(Cloud *)out = cloud_default(kind < 0 ? CLOUD_CUMULUS : (CloudKind)kind);
}

const Table cloud_table = {
    .name = "cloud",
    .doc =
        "Clouds of droplets: light is scattered through them by path tracing, and they shade the "
        "land.",
    .example = "clouds:\n"
               "  - {kind: cumulus, cover: 0.3, base: 1200, thickness: 1500}\n",
    .size = sizeof(Cloud),
    .keys = CLOUD_KEYS,
    .kind_key = "kind",
    .kind_defaults = cloud_defaults};
