// Stars: the bright ones where they stand, the faint ones at random.
#ifndef RAMIFY_RENDER_SKY_STARS_H
#define RAMIFY_RENDER_SKY_STARS_H

#include "render/sky/sky.h"

// The direction on the celestial sphere: x toward the vernal equinox, z toward the north pole. A
// direction of the sky: y up, z south, x east.
Vec3 star_sphere(const Sky *sky, Vec3 direction);

// Radiance of stars in a direction; spread: radians of a pixel, over which each star is smoothed.
Vec3 night_stars(const Sky *sky, Vec3 direction, float spread);

#endif
