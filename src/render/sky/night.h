// The night: airglow, the Milky Way, city light along the horizon, stars, and the moon.
//
// Exposed for the night, as a photograph is: a million times nature's radiance.
#ifndef RAMIFY_RENDER_SKY_NIGHT_H
#define RAMIFY_RENDER_SKY_NIGHT_H

#include "render/sky/sun_sky.h"

// sky->kind must be SKY_NIGHT. The dome holds all but stars and moon; *moon: its disc, with
// radiance 0 if there is none.
Dome *night_dome(const Sky *sky, Sun *moon, Error *e);

// Factor of the lunar maria and the phase on the moon's radiance in a direction within its disc;
// the mean is about 1.
float night_moon_face(const Sky *sky, const Sun *moon, Vec3 direction);

#endif
