// Linear Rec. 709 colours.
#ifndef RAMIFY_BASE_COLOR_H
#define RAMIFY_BASE_COLOR_H

#include "base/vec.h"

// Relative luminance (ITU-R BT.709).
static inline float luminance(Vec3 c)
{
    return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
}

// The same for a pixel: red, green, blue.
static inline float luminance_rgb(const float rgb[3])
{
    return luminance(vec3(rgb[0], rgb[1], rgb[2]));
}

#endif
