#include "scene/builtin.h"

#include <stddef.h>
#include <string.h>

// Oak bark and twig after reflectances of dry bark (0.1 to 0.2, reddish); leaves from PROSPECT-5 as
// material_default has them, the grass yellower, fallen leaves without chlorophyll.
static const Material MATERIALS[] = {
    {.name = "bark",
     .kind = MATERIAL_PRINCIPLED,
     .color = {0.175f, 0.135f, 0.098f},
     .color2 = {0.045f, 0.032f, 0.024f},
     .roughness = 0.85f,
     .specular = 0.25f,
     .ior = 1.5f,
     .pattern = PATTERN_BARK,
     .pattern_depth = 0.012f},
    {.name = "twig",
     .kind = MATERIAL_PRINCIPLED,
     .color = {0.130f, 0.098f, 0.068f},
     .color2 = {0.070f, 0.052f, 0.038f},
     .roughness = 0.7f,
     .specular = 0.3f,
     .ior = 1.5f},
    {.name = "leaf",
     .kind = MATERIAL_LEAF,
     .color = {0.087f, 0.149f, 0.046f},
     .color2 = {0.110f, 0.175f, 0.060f},
     .transmittance = {0.060f, 0.110f, 0.012f},
     .roughness = 0.58f,
     .specular = 0.28f,
     .ior = 1.5f,
     .pattern = PATTERN_LEAF,
     .variation = 0.35f},
    {.name = "ground",
     .kind = MATERIAL_DIFFUSE,
     .color = {0.085f, 0.105f, 0.040f},
     .color2 = {0.110f, 0.082f, 0.052f},
     .roughness = 0.8f,
     .ior = 1.5f,
     .pattern = PATTERN_GROUND,
     .pattern_depth = 0.03f},
    {.name = "grass",
     .kind = MATERIAL_LEAF,
     .color = {0.115f, 0.165f, 0.048f},
     .color2 = {0.165f, 0.155f, 0.070f},
     .transmittance = {0.080f, 0.120f, 0.018f},
     .roughness = 0.65f,
     .specular = 0.15f,
     .ior = 1.5f,
     .variation = 0.5f},
    {.name = "fallen",
     .kind = MATERIAL_LEAF,
     .color = {0.230f, 0.130f, 0.055f},
     .color2 = {0.130f, 0.075f, 0.038f},
     .transmittance = {0.090f, 0.040f, 0.010f},
     .roughness = 0.6f,
     .specular = 0.35f,
     .ior = 1.5f,
     .pattern = PATTERN_LEAF,
     .variation = 0.7f},
    // Ice: absorption after Picard et al. 2016, bumps of the finest crystals.
    {.name = "ice",
     .kind = MATERIAL_DIELECTRIC,
     .color = {1.0f, 1.0f, 1.0f},
     .absorption = {0.25f, 0.05f, 0.02f},
     .roughness = 0.22f,
     .ior = 1.31f},
    {.name = "soap_film",
     .kind = MATERIAL_THIN_FILM,
     .color = {1.0f, 1.0f, 1.0f},
     .ior = 1.33f,
     .film_thickness = 480.0f,
     .film_drainage = 0.6f,
     .film_swirl = 0.35f},
    // reflectance of copper at normal incidence, linear Rec. 709
    {.name = "copper",
     .kind = MATERIAL_CONDUCTOR,
     .color = {0.955f, 0.638f, 0.538f},
     .color2 = {0.1f, 0.1f, 0.1f},
     .roughness = 0.35f,
     .ior = 1.5f},
    // The hue of nitrogen at 30,000 K; brightness is lightning.power.
    {.name = "lightning", .kind = MATERIAL_EMISSION, .radiance = {0.75f, 0.85f, 1.25f}},
    {.name = "coral",
     .kind = MATERIAL_PRINCIPLED,
     .color = {0.36f, 0.22f, 0.10f},
     .color2 = {0.80f, 0.72f, 0.60f}, // of growing tips and margins
     .roughness = 0.7f,
     .specular = 0.2f,
     .ior = 1.5f,
     .pattern = PATTERN_CORALLITE,
     .pattern_scale = 0.0024f,
     .pattern_depth = 0.0007f},
    {.name = "coral_polyp",
     .kind = MATERIAL_PRINCIPLED,
     .color = {0.40f, 0.25f, 0.12f},
     .color2 = {0.86f, 0.79f, 0.68f},
     .roughness = 0.65f,
     .specular = 0.25f,
     .ior = 1.5f,
     .pattern = PATTERN_YOUTH},
    {.name = "reef_rock",
     .kind = MATERIAL_PRINCIPLED,
     .color = {0.24f, 0.20f, 0.16f},
     .color2 = {0.16f, 0.09f, 0.10f}, // coralline algae
     .roughness = 0.9f,
     .specular = 0.15f,
     .ior = 1.5f,
     .pattern = PATTERN_NOISE,
     .pattern_scale = 0.05f,
     .pattern_depth = 0.01f},
    {.name = "clay",
     .kind = MATERIAL_DIFFUSE,
     .color = {0.45f, 0.42f, 0.39f},
     .color2 = {0.1f, 0.1f, 0.1f},
     .roughness = 0.5f,
     .ior = 1.5f},
};

const Material *builtin_materials(int *count)
{
    *count = (int)(sizeof MATERIALS / sizeof MATERIALS[0]);
    return MATERIALS;
}

const Material *builtin_material(const char *name)
{
    int count;
    const Material *materials = builtin_materials(&count);
    for (int i = 0; i < count; i++) {
        if (strcmp(materials[i].name, name) == 0) {
            return &materials[i];
        }
    }
    return NULL;
}
