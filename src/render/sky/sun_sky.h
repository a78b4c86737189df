// Sun and sky by day: the atmosphere baked into a dome, and the sun apart from it.
//
// Scale: radiance 1 is a luminance of 1e5 / pi = 31,831 cd/m^2: a white diffuse surface under
// 100,000 lux, a clear noon in summer. So white in sunlight comes out near 1 and needs no exposure.
// Colours are relative to a white of 6500 K.
#ifndef RAMIFY_RENDER_SKY_SUN_SKY_H
#define RAMIFY_RENDER_SKY_SUN_SKY_H

#include "base/run.h"
#include "render/sky/atmosphere.h"
#include "render/sky/dome.h"
#include "render/sky/sky.h"

#define SKY_CANDELA_PER_UNIT (1e5f / PI_F)

// The sun as a disc at infinity.
typedef struct Sun {
    Vec3 direction;      // unit, to its centre
    float one_minus_cos; // of its angular radius
    Vec3 radiance;       // mean over the disc; 0 below the horizon
    float solid_angle;
    bool even; // without limb darkening: the moon
} Sun;

// Of a sky with kind SKY_SUN_SKY.
Atmosphere *sky_atmosphere(const Sky *sky, const Run *run, Error *e);

// The lower half of the dome is the ground: below the horizon, haze blends within a few degrees
// into ground_albedo under this sky.
Dome *sky_dome(const Sky *sky, const Atmosphere *atmosphere, Sun *sun, const Run *run, Error *e);

// Radiance of the disc in direction, with limb darkening; 0 outside.
Vec3 sun_radiance(const Sun *sun, Vec3 direction);

// Uniform over the disc: density 1 / solid_angle.
Vec3 sun_sample(const Sun *sun, float u, float v);
bool sun_covers(const Sun *sun, Vec3 direction);

#endif
