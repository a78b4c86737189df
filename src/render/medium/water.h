// The surface of water that the scene lies under, seen from below: sky and sun refracted into the
// water, and the bright network that the waves focus the sun into.
//
// The waves are a sum of sines, periodic over a tile. Rays of the sun are refracted through a fine
// grid of points on them and counted where they arrive in layers of depth: the inverse Jacobian of
// the refraction, summed over all its branches. So each layer has the mean 1.
#ifndef RAMIFY_RENDER_MEDIUM_WATER_H
#define RAMIFY_RENDER_MEDIUM_WATER_H

#include "base/error.h"
#include "base/run.h"
#include "render/medium/medium.h"

#define WATER_INDEX 1.34f // of refraction

typedef struct Water Water;

// medium: MEDIUM_WATER. sun: unit, toward it, zero without one; sun_radius: radians. depth (m, >
// 0): where the network shall be sharp, which decides how high the waves are.
Water *water_new(const Medium *medium, Vec3 sun, float sun_radius, float depth, uint64_t seed,
                 const Run *run, Error *e);
void water_free(Water *water); // NULL is fine

bool water_covers(const Water *water, Vec3 point);

// A direction toward a light on the other side of the surface, the share of the light that comes
// through, and what a solid angle shrinks by: angle in air = shrink * angle in water.
typedef struct WaterPassage {
    Vec3 direction; // unit
    float share, shrink;
} WaterPassage;

// From above into the calm surface; false where the light is below the horizon.
bool water_enter(Vec3 air, WaterPassage *passage);

// From below through a surface of this normal, which points up; false at total reflection.
bool water_leave(Vec3 below, Vec3 normal, WaterPassage *passage);

// Unit normal of the waves above or below a point.
Vec3 water_normal(const Water *water, Vec3 point);

// Sunlight at a point under the surface relative to what comes through a calm one.
float water_caustic(const Water *water, Vec3 point);

#endif
