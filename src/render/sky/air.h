// Aerial perspective: air takes light from what is far away and adds its own.
#ifndef RAMIFY_RENDER_SKY_AIR_H
#define RAMIFY_RENDER_SKY_AIR_H

#include "render/sky/atmosphere.h"
#include "render/sky/sky.h"

typedef struct Air Air;

// Takes the atmosphere, also when it fails. sky->aerial_perspective > 0.
Air *air_new(Atmosphere *atmosphere, const Sky *sky, Error *e);
void air_free(Air *air); // NULL is fine

// What air does to the radiance of a point: times clear, plus glow, plus sunlit unless the sun is
// hidden from the place at `at`.
typedef struct AirView {
    Vec3 clear;  // transmittance
    Vec3 glow;   // light scattered more than once
    Vec3 sunlit; // an estimate of sunlight scattered once
    float at;    // m along the ray
} AirView;

// from, direction (unit): the ray in the scene, m; sun: unit, toward it; u: uniform, chooses `at`.
AirView air_view(const Air *air, Vec3 from, Vec3 direction, float distance, Vec3 sun, float u);

#endif
