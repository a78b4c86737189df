// A layer of fair-weather clouds: thin sheets and streaks of fractal noise, lit by the sun and the
// sky.
#ifndef RAMIFY_RENDER_SKY_PAINTED_CLOUDS_H
#define RAMIFY_RENDER_SKY_PAINTED_CLOUDS_H

#include "base/vec.h"

#include <stdint.h>

typedef struct PaintedClouds {
    float cover;        // share of the sky, 0..1; 0 = none
    Vec3 sun_direction; // unit, to the sun
    Vec3 sunlight;      // irradiance of the sun on a surface that faces it
    Vec3 skylight;      // mean radiance of the sky
    uint32_t seed;
} PaintedClouds;

// Radiance seen from the ground in direction (unit), over a clear sky of radiance `behind`.
Vec3 painted_clouds_before(const PaintedClouds *clouds, Vec3 direction, Vec3 behind);

#endif
