// Keys of the medium that fills a scene.
#include "render/medium/medium.h"
#include "scene/spec.h"

#define BIT(kind) (1u << (kind))

static const EnumName KINDS[] = {
    {"everywhere", MEDIUM_EVERYWHERE}, {"water", MEDIUM_WATER}, {"layer", MEDIUM_LAYER}, {0}};

static const Key MEDIUM_KEYS[] = {
    {KEY_OF(Medium, kind, "kind", KEY_ENUM), .names = KINDS,
     .doc = "everywhere: a sphere of uniform haze around the scene; water: everything below "
            "`height`; layer: uniform below `height` and thinning out above, like fog."},
    {KEY_OF(Medium, scattering, "scattering", KEY_COLOR), .high = 1e6, .unit = "1/m",
     .doc = "Scattering coefficient; the visibility is about 3 / scattering."},
    {KEY_OF(Medium, absorption, "absorption", KEY_COLOR), .high = 1e6, .unit = "1/m",
     .doc = "Absorption coefficient."},
    {KEY_OF(Medium, anisotropy, "anisotropy", KEY_FLOAT), .low = -0.98, .high = 0.98,
     .doc = "Mean cosine of the scattering angle: 0 = isotropic, near 1 = forward, as in fog and "
            "water."},
    {KEY_OF(Medium, height, "height", KEY_FLOAT), .kinds = BIT(MEDIUM_WATER) | BIT(MEDIUM_LAYER),
     .low = -1e6, .high = 1e6, .unit = "m",
     .doc = "Height of the water's surface, or of the layer's top."},
    {KEY_OF(Medium, falloff, "falloff", KEY_FLOAT), .kinds = BIT(MEDIUM_LAYER), .flags = KEY_ABOVE,
     .high = 1e6, .unit = "m",
     .doc = "Height above the layer over which the density falls to 1/e."},
    {KEY_OF(Medium, caustics, "caustics", KEY_FLOAT), .kinds = BIT(MEDIUM_WATER), .high = 1,
     .doc = "Strength of the caustics that waves cast in sunlight; 0 = calm water."},
    {KEY_OF(Medium, wavelength, "wavelength", KEY_FLOAT), .kinds = BIT(MEDIUM_WATER), .high = 1e4,
     .unit = "m",
     .doc = "Distance between waves; 0 = a third of the depth of the camera's target."},
    {KEY_OF(Medium, swell, "swell", KEY_FLOAT), .kinds = BIT(MEDIUM_WATER), .high = 1e4,
     .unit = "m",
     .doc =
         "Length of the longest waves, which run with the wind and make the surface uneven as "
         "seen from below, but cast no caustics; 0 = none longer than those about `wavelength`."},
    {KEY_OF(Medium, extent, "extent", KEY_FLOAT), .kinds = BIT(MEDIUM_EVERYWHERE), .high = 1e9,
     .unit = "m",
     .doc = "Radius of the sphere; 0 = three times the scene's radius. A large sphere attenuates "
            "the light from the sky."},
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
