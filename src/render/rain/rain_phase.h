// How raindrops scatter light: geometric optics of spheres of water, and Airy's waves at the bows.
// A ray that is reflected once inside of the drop makes the rainbow, one that is reflected twice
// the second.
#ifndef RAMIFY_RENDER_RAIN_RAIN_PHASE_H
#define RAMIFY_RENDER_RAIN_RAIN_PHASE_H

#include "base/error.h"
#include "base/vec.h"

enum { RAIN_PHASE_BINS = 1800 };

typedef struct RainPhase {
    Vec3 density[RAIN_PHASE_BINS + 1]; // 1/sr, by the angle between the directions, 0 .. pi
    float drawn[RAIN_PHASE_BINS + 1];  // share of the mean of the colours below each bin's angle
} RainPhase;

// The caller frees it.
RainPhase *rain_phase_new(Error *e);

// 1/sr, of each colour; cosine of the angle between the directions before and after.
Vec3 rain_phase(const RainPhase *phase, float cosine);

// A direction by the mean of the colours. u, v: uniform in [0, 1). *pdf: 1/sr.
Vec3 rain_phase_draw(const RainPhase *phase, Vec3 direction, float u, float v, float *pdf);

// Density of rain_phase_draw, for the densities of the colours.
static inline float rain_phase_pdf(Vec3 density)
{
    return (density.x + density.y + density.z) / 3.0f;
}

// Refractive index of water at 25 degrees C, 200 to 1100 nm (Huibers 1997).
double rain_index(double nanometres);

#endif
