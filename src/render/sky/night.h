// The night: airglow, the Milky Way, city light along the horizon, stars, and a full moon.
//
// Not to scale with the day, but as a photograph exposed for the night shows it: nature's night is
// a million times darker than what is returned here.
#ifndef RAMIFY_RENDER_SKY_NIGHT_H
#define RAMIFY_RENDER_SKY_NIGHT_H

#include "render/sky/sun_sky.h"

// sky->kind must be SKY_NIGHT. All of it but stars and moon; *moon is set (without radiance where
// there is none).
Dome *night_dome(const Sky *sky, Sun *moon, Error *e);

// Stars in a direction; spread: radians, of a pixel, over which each is smoothed.
Vec3 night_stars(const Sky *sky, Vec3 direction, float spread);

// How the seas of the moon darken its face in a direction within it; the mean is about 1.
float night_moon_face(const Sun *moon, Vec3 direction);

#endif
