// Light along a ray through the atmosphere: sunlight scattered once toward the eye, and light that
// was scattered before (air_glow.h). Lengths and names as in air_model.h.
#ifndef RAMIFY_RENDER_SKY_AIR_MARCH_H
#define RAMIFY_RENDER_SKY_AIR_MARCH_H

#include "render/sky/air_glow.h"

// A ray from radius r; mu and mu_sun are the cosines of its and the sun's angle to the vertical
// there, cosine that of the angle between them.
typedef struct AirRay {
    double r, mu, mu_sun, cosine;
    float turn; // radians: its azimuth from the sun's, 0 .. pi
} AirRay;

AirRay air_ray(double r, double mu, double mu_sun, double cosine);

// What a march has found so far, for a sun of irradiance 1 in every band.
typedef struct AirMarch {
    Spectrum sunlit; // scattered once toward the eye
    Spectrum glow;   // scattered more than once
    Spectrum clear;  // transmittance to the eye
} AirMarch;

AirMarch air_march_begin(void);

// One step, from `before` to `after` km. sunlit: adds that light, too. glow: NULL = adds none.
void air_march_on(const AirModel *model, const AirGlow *glow, bool sunlit, const AirRay *ray,
                  AirMarch *march, double before, double after);

// What a ray meets in a step, wherever the sun is.
typedef struct AirStep {
    double t, radius; // km along the ray to the step's middle, and its distance from Earth's
    Column density;
    Spectrum seen; // km: length of the step, as far as it is seen
} AirStep;

// The steps of all rays from radius r at an angle of cosine mu to the vertical.
enum { AIR_PATH_STEPS = 32 };
typedef struct AirPath {
    int count;
    AirStep step[AIR_PATH_STEPS];
    Spectrum clear; // transmittance of all
} AirPath;

// All of `length` km in so many steps (at most AIR_PATH_STEPS), by far the shortest at its start:
// through the whole atmosphere 16 are as good as 5 %.
void air_path_find(const AirModel *model, double r, double mu, double length, int steps,
                   AirPath *path);

// Light along a ray on that path.
AirMarch air_march(const AirModel *model, const AirGlow *glow, bool sunlit, const AirRay *ray,
                   const AirPath *path);

#endif
