// Covers of open slopes as the land's patterns mix them: talus, turf and heath, with what runs down
// the fall line, and bushes and blocks as single things as far as the pixel shows them.
#ifndef RAMIFY_RENDER_MATERIAL_PATTERN_SLOPES_H
#define RAMIFY_RENDER_MATERIAL_PATTERN_SLOPES_H

#include "render/material/pattern.h"
#include "render/material/pattern_mix.h"

// Streaks down the fall line, `width` m wide (octaves of it, each half as wide and `gain` times as
// high) and six times as long, about -1..1 with mean 0; round spots where the ground is level.
// Sparse convolution (Lewis 1989) with kernels that the slope turns and stretches.
PatternOctaves pattern_fall_lines(const SurfacePoint *point, float width, int octaves, float gain,
                                  uint32_t seed);

// Things on the ground: rounded mounds about `size` m wide, seen from above, at most one in each
// square of a grid.
typedef struct Mounds {
    float share; // 0..1: of the pixel that they cover
    Vec3 slope;  // of their relief, dimensionless
    float tone;  // 0..1 at random, one value each; 0.5 where they are too small for the pixel
} Mounds;

// density: 0..1: the share of the squares that have one.
Mounds pattern_mounds(const SurfacePoint *point, float density, float size, uint32_t seed);

// The same, each within its square of a grid, at less than half of the cost (0.08 us, not 0.18).
Mounds pattern_tussocks(const SurfacePoint *point, float density, float size, uint32_t seed);

// Talus: blocks of many sizes between pale tracks of fresh debris and dark, old ground. scale: m;
// fresh, old: reflectances.
Ground slopes_talus(const SurfacePoint *point, Vec3 fresh, Vec3 old, float scale);

// Turf, from lush to dry (0..1), with bushes, stones, and worn tracks of soil on steep ground.
typedef struct Turf {
    Vec3 lush, straw, bush, soil; // reflectances
    float scale;                  // m: the widest patches
    float dry;
} Turf;

Ground slopes_turf(const SurfacePoint *point, const Turf *turf);

#endif
