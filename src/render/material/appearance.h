// What a material looks like, in the terms that other programs' files share. Exporters read this
// and never ask for the kind. Names, textures and what is inside a body stand in the Material.
#ifndef RAMIFY_RENDER_MATERIAL_APPEARANCE_H
#define RAMIFY_RENDER_MATERIAL_APPEARANCE_H

#include "render/material/material.h"

typedef struct Appearance {
    unsigned traits;
    Vec3 color;         // diffuse reflectance; of metal and clear things their tint; linear
    Vec3 transmittance; // diffuse: of sheets that are neither opaque nor clear
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

// Light passes undiffused: glass, water, soap films.
static inline bool appearance_is_clear(const Appearance *a)
{
    return a->traits & (TRAIT_BODY | TRAIT_THIN);
}

// Diffuse reflection or emission alone: nothing mirrors.
static inline bool appearance_is_matt(const Appearance *a)
{
    return !a->coated && a->metalness <= 0.0f && !appearance_is_clear(a);
}

// What is seen of it where nothing is lit.
static inline Vec3 appearance_display_color(const Appearance *a)
{
    return a->traits & TRAIT_EMISSIVE ? a->emission : a->color;
}

// For a kind's describe: a coat of this strength, with the index that reflects as much head-on.
void appearance_add_coat(Appearance *appearance, float specular);

#endif
