#include "render/material/material.h"

Material material_default(MaterialKind kind)
{
    Material m = {.kind = kind,
                  .color = vec3_splat(0.5f),
                  .color2 = vec3_splat(0.1f),
                  .roughness = 0.5f,
                  .specular = 0.5f,
                  .ior = 1.5f};
    if (kind == MATERIAL_DIFFUSE) {
        m.roughness = 0.0f;
    } else if (kind == MATERIAL_DIELECTRIC) {
        m.color = vec3_splat(1.0f);
        m.roughness = 0.0f;
    } else if (kind == MATERIAL_CONDUCTOR) {
        m.color = vec3_splat(0.9f);
        m.roughness = 0.3f;
    } else if (kind == MATERIAL_LEAF) {
        // A green oak leaf near 610, 550 and 450 nm (PROSPECT-5, chlorophyll 40).
        m.color = vec3(0.087f, 0.149f, 0.046f);
        m.transmittance = vec3(0.060f, 0.110f, 0.012f);
    } else if (kind == MATERIAL_EMISSION) {
        m.radiance = vec3_splat(1.0f);
    } else if (kind == MATERIAL_THIN_FILM) { // soapy water
        m.color = vec3_splat(1.0f);
        m.ior = 1.33f;
        m.film_thickness = 480.0f;
        m.film_drainage = 0.6f;
        m.film_swirl = 0.35f;
    }
    return m;
}
