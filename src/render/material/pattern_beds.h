// The beds of the land (base/strata.h) as its patterns show them.
#ifndef RAMIFY_RENDER_MATERIAL_PATTERN_BEDS_H
#define RAMIFY_RENDER_MATERIAL_PATTERN_BEDS_H

#include "base/strata.h"
#include "render/surface.h"

// The level of a point of land with beds (SurfacePoint.strata), m. Contacts are not ruled lines.
float beds_level(const SurfacePoint *point);

// Reflectance of the bed at a level; the mean of the beds from `low` to `high`, m; that over the
// height that a pixel covers.
Vec3 beds_color(const Strata *strata, float level);
Vec3 beds_mean_between(const Strata *strata, float low, float high);
Vec3 beds_mean_color(const Strata *strata, float level, float footprint);

// The laminae of a bed at three scales, about 0..1; 0.5 where it has none or the pixel shows none.
// The coarsest are `share` of the bed's own thick.
float beds_lamina_tone(const Strata *strata, float level, float footprint, float share);

// `color` with the share of each channel that the bed at the level reflects more or less than the
// mean of all beds.
Vec3 beds_tinted(const SurfacePoint *point, float level, Vec3 color);

#endif
