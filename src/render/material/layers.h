// Layers of one material on another, by masks: their colours, bumps, roughness and coats are mixed.
#ifndef RAMIFY_RENDER_MATERIAL_LAYERS_H
#define RAMIFY_RENDER_MATERIAL_LAYERS_H

#include "render/material/material_set.h"

// What layers do to the surface besides its colour and normal.
typedef struct LayerMix {
    float coated; // share of MATERIAL_PRINCIPLED; of that share, the means of
    float specular, metallic, roughness;
    float dull_roughness; // of the rest
} LayerMix;

// Mixes the layers of the entry at the point into the Bsdf, whose colour, roughness and normal are
// those of the material below, and chooses its lobes: those of diffuse or of principled, at random
// by the place in proportion to their shares. False, and nothing changes, where no layer lies.
bool layers_mix(const MaterialSet *set, const MaterialEntry *entry, const SurfacePoint *point,
                Bsdf *bsdf, LayerMix *mix);

// In place of MaterialOps.prepare.
void layers_prepare(const LayerMix *mix, Bsdf *bsdf, float cos_o);

#endif
