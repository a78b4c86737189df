// Rotation of a vector by an angle in degrees, with the same bits on every machine.
#ifndef RAMIFY_BASE_TURN_H
#define RAMIFY_BASE_TURN_H

#include "base/exact_math.h"
#include "base/vec.h"

// v about the unit axis, counterclockwise seen against it.
static inline Vec3 vec3_turn(Vec3 v, Vec3 axis, float degrees)
{
    float sine, cosine;
    exact_sincos(degrees * RADIANS_PER_DEGREE, &sine, &cosine);
    return vec3_rotate(v, axis, cosine, sine);
}

#endif
