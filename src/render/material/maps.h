// Pictures that change a material over its surface: colour, transmittance, roughness, normals. By
// the surface's UVs, or projected along the three axes of its own space.
#ifndef RAMIFY_RENDER_MATERIAL_MAPS_H
#define RAMIFY_RENDER_MATERIAL_MAPS_H

#include "render/material/material_set.h"

// Does the material have pictures, other than of its opacity?
bool maps_are_given(const Material *material);

// The height that displacement_texture gives to the point, m about its middle; 0 without one.
float maps_height(const MaterialEntry *entry, const SurfacePoint *point);

// Sets the roughness, and alpha and table to those of it if the entry has tables of roughness.
void maps_set_roughness(const MaterialEntry *entry, float roughness, Bsdf *bsdf);

// Multiplies colour, transmittance and roughness of the Bsdf by the entry's pictures at the point,
// tilts its normal, and sets alpha and table to those of the roughness.
void maps_apply(const MaterialEntry *entry, const SurfacePoint *point, Bsdf *bsdf);

#endif
