// The shores of lakes and rivers, for patterns of land: stones that waves have washed, wet at the
// water's edge, and the bed under it.
#ifndef RAMIFY_RENDER_MATERIAL_PATTERN_SHORE_H
#define RAMIFY_RENDER_MATERIAL_PATTERN_SHORE_H

#include "render/material/pattern_mix.h"
#include "render/surface.h"

// Rounded stones of 5 cm to 0.9 m on gravel, the larger the fewer, in tones of the rock's
// reflectance.
Ground pattern_stones(const SurfacePoint *point, Vec3 rock);

// The ground with its shore, where water is near (SurfacePoint.shore). rock: reflectance of dry
// stones; depth: the factor by which the caller scales slopes later.
Ground pattern_shore(const SurfacePoint *point, Vec3 rock, float depth, Ground ground);

#endif
