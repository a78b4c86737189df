// The relief of materials as geometry: how high it is at a point of the smooth surface.
#ifndef RAMIFY_RENDER_MATERIAL_RELIEF_H
#define RAMIFY_RENDER_MATERIAL_RELIEF_H

#include "render/material/bsdf.h"

// m: about the height from the lowest to the highest of what the material displaces on a stem of
// this radius (0 = no stem); 0 = nothing is displaced.
float relief_size(const Material *material, float radius);

// Is the surface between two points of these normals left as it is, whatever the relief's size?
bool relief_spares(const Material *material, Vec3 normal_a, Vec3 normal_b);

// m along the normal, at point->object_position with point->footprint.
float relief_height(const MaterialSet *set, const SurfacePoint *point);

// Equal for materials with the same relief; 0 if nothing is displaced.
uint64_t relief_key(const Material *material);

#endif
