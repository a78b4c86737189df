// What fills the space of a scene.
#include "render/medium/medium.h"
#include "scene/spec.h"

#define BIT(kind) (1u << (kind))

static const EnumName KINDS[] = {
    {"everywhere", MEDIUM_EVERYWHERE}, {"water", MEDIUM_WATER}, {"layer", MEDIUM_LAYER}, {0}};

static const Key MEDIUM_KEYS[] = {
    {KEY_OF(Medium, kind, "kind", KEY_ENUM), .names = KINDS,
     .doc = "everywhere: a ball of haze around the scene; water: all under `height`; "
            "layer: even under `height` and thinning out above, as fog."},
    {KEY_OF(Medium, scattering, "scattering", KEY_COLOR), .high = 1e6, .unit = "1/m",
     .doc = "Share of light turned aside on a metre; 3 / scattering is about as far as one sees."},
    {KEY_OF(Medium, absorption, "absorption", KEY_COLOR), .high = 1e6, .unit = "1/m",
     .doc = "Share of light lost on a metre."},
    {KEY_OF(Medium, anisotropy, "anisotropy", KEY_FLOAT), .low = -0.98, .high = 0.98,
     .doc = "Mean cosine of scattering: 0 = to all sides, near 1 = forward, as fog and water do."},
    {KEY_OF(Medium, height, "height", KEY_FLOAT), .kinds = BIT(MEDIUM_WATER) | BIT(MEDIUM_LAYER),
     .low = -1e6, .high = 1e6, .unit = "m", .doc = "Height of its surface."},
    {KEY_OF(Medium, falloff, "falloff", KEY_FLOAT), .kinds = BIT(MEDIUM_LAYER), .flags = KEY_ABOVE,
     .high = 1e6, .unit = "m", .doc = "Climb over which it thins out to 1/e."},
    {KEY_OF(Medium, caustics, "caustics", KEY_FLOAT), .kinds = BIT(MEDIUM_WATER), .high = 1,
     .doc = "Strength of the network of light that waves focus the sun into; 0 = calm water."},
    {KEY_OF(Medium, wavelength, "wavelength", KEY_FLOAT), .kinds = BIT(MEDIUM_WATER), .high = 1e4,
     .unit = "m", .doc = "From wave to wave; 0 = a third of the depth of the camera's target."},
    {KEY_OF(Medium, extent, "extent", KEY_FLOAT), .kinds = BIT(MEDIUM_EVERYWHERE), .high = 1e9,
     .unit = "m",
     .doc = "Radius of the ball; 0 = three times the scene's. Light from the sky loses itself in "
            "a large one."},
    {0},
};

static void medium_defaults(const Node *given, int kind, void *out)
{
    (void)given;
    *(Medium *)out = medium_default(kind < 0 ? MEDIUM_EVERYWHERE : (MediumKind)kind);
}

const Table medium_table = {.name = "medium",
                            .doc = "Fog, haze or water that fills the scene.",
                            .example =
                                "medium: {kind: layer, scattering: 0.01, height: 5, falloff: 8}\n",
                            .size = sizeof(Medium),
                            .keys = MEDIUM_KEYS,
                            .kind_key = "kind",
                            .kind_defaults = medium_defaults};
