// A layer of fair-weather clouds before the sky: thin sheets and streaks by fractal noise, lit
// through by the sun.
#ifndef RAMIFY_RENDER_SKY_CLOUDS_H
#define RAMIFY_RENDER_SKY_CLOUDS_H

#include "base/vec.h"

#include <stdint.h>

typedef struct Clouds {
    float cover;        // share of the sky, 0..1; 0 = none
    Vec3 sun_direction; // unit, to the sun
    Vec3 sunlight;      // irradiance of the sun on a surface that faces it
    Vec3 skylight;      // mean radiance of the sky
    uint32_t seed;
} Clouds;

// Radiance that an eye on the ground sees in direction (unit), where the clear sky has `behind`.
Vec3 clouds_before(const Clouds *clouds, Vec3 direction, Vec3 behind);

#endif
