// The beds of the land (base/strata.h) as its patterns show them.
#ifndef RAMIFY_RENDER_MATERIAL_PATTERN_BEDS_H
#define RAMIFY_RENDER_MATERIAL_PATTERN_BEDS_H

#include "base/strata.h"
#include "render/surface.h"

// The level of a point of land with beds (SurfacePoint.strata), m. Contacts are not ruled lines.
float beds_level(const SurfacePoint *point);

// Reflectance of the bed at a level; its mean over the height that a pixel covers.
Vec3 beds_color(const Strata *strata, float level);
Vec3 beds_mean_color(const Strata *strata, float level, float footprint);

// `color` with the share of each channel that the bed at the level reflects more or less than the
// mean of all beds.
Vec3 beds_tinted(const SurfacePoint *point, float level, Vec3 color);

#endif
