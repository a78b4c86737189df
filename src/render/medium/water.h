// The surface of water above the scene, seen from below: sky and sun refracted into the water, and
// the caustics of the waves.
//
// The waves are a sum of sines, periodic over a tile, and of longer ones that are only seen. Rays
// of the sun are refracted at a fine grid of points and counted where they arrive in layers of
// depth. This is the inverse Jacobian of the refraction summed over its branches, so each layer has
// the mean 1.
#ifndef RAMIFY_RENDER_MEDIUM_WATER_H
#define RAMIFY_RENDER_MEDIUM_WATER_H

#include "base/error.h"
#include "base/run.h"
#include "render/medium/medium.h"

#define WATER_INDEX 1.34f // of refraction

typedef struct Water Water;

// medium: MEDIUM_WATER. sun: unit, toward it; zero without one. sun_radius: radians. depth (m, >
// 0): where caustics are in focus, which sets the height of the waves.
Water *water_new(const Medium *medium, Vec3 sun, float sun_radius, float depth, uint64_t seed,
                 const Run *run, Error *e);
void water_free(Water *water); // NULL is fine

bool water_covers(const Water *water, Vec3 point);

// A direction toward a light on the other side of the surface, the transmittance, and the ratio of
// solid angles: angle in air = shrink * angle in water.
typedef struct WaterPassage {
    Vec3 direction; // unit
    float share, shrink;
} WaterPassage;

// From above into the calm surface; false if the light is below the horizon.
bool water_enter(Vec3 air, WaterPassage *passage);

// From below through a surface of this normal, which points up; false at total reflection.
bool water_leave(Vec3 below, Vec3 normal, WaterPassage *passage);

// Unit normal of the waves above or below a point.
Vec3 water_normal(const Water *water, Vec3 point);

// Irradiance of the sun at a point under water, relative to a calm surface.
float water_caustic(const Water *water, Vec3 point);

#endif
