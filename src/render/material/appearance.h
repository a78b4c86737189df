// The appearance of a material in terms that file formats share. Exporters read this and never ask
// for the kind; names, textures and the inside of a body are read from the Material.
#ifndef RAMIFY_RENDER_MATERIAL_APPEARANCE_H
#define RAMIFY_RENDER_MATERIAL_APPEARANCE_H

#include "render/material/material.h"

typedef struct Appearance {
    unsigned traits;
    Vec3 color;         // diffuse reflectance; the tint of metal and of clear things
    Vec3 transmittance; // diffuse; of things that are neither opaque nor clear
    Vec3 emission;      // radiance; 0 unless TRAIT_EMISSIVE
    float metalness;    // 0..1; without a coat: a conductor
    float roughness;
    bool coated;          // a dielectric coat ...
    float specular;       // ... of this strength: 0.08 of it is reflected head-on
    float ior;            // of a clear thing or the coat; 1 = neither
    float film_thickness; // nm; TRAIT_THIN
    float film_variation; // 0..1: how much the film's thickness changes over the surface
} Appearance;

Appearance material_appearance(const Material *material);

// Specular transmission: glass, water, soap films.
static inline bool appearance_is_clear(const Appearance *a)
{
    return a->traits & (TRAIT_BODY | TRAIT_THIN);
}

// Only diffuse reflection or emission, no glossy lobe.
static inline bool appearance_is_matt(const Appearance *a)
{
    return !a->coated && a->metalness <= 0.0f && !appearance_is_clear(a);
}

// The colour to show in a view without lighting.
static inline Vec3 appearance_display_color(const Appearance *a)
{
    return a->traits & TRAIT_EMISSIVE ? a->emission : a->color;
}

// Adds a coat of this strength, and the index of refraction with the same reflectance at normal
// incidence. For MaterialOps.describe.
void appearance_add_coat(Appearance *appearance, float specular);

#endif
