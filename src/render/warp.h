// Maps from the unit square to discs and spheres.
#ifndef RAMIFY_RENDER_WARP_H
#define RAMIFY_RENDER_WARP_H

#include "base/vec.h"

// Uniform on the unit disc, keeping neighbours together (Shirley and Chiu 1997).
Vec2 warp_disc(float u, float v);

// Unit vector at cosine `c` from the unit axis, turned about it by `turn` (0..1 of a circle).
Vec3 warp_cone(Vec3 axis, float c, float sine, float turn);

// Sine and cosine of 2 pi u for u in [0, 1]; error below 1e-6.
static inline void sincos_turn(float u, float *sine, float *cosine)
{
    float quadrant = floorf(4.0f * u + 0.5f);
    float x = (u - 0.25f * quadrant) * (2.0f * PI_F);
    float x2 = x * x;
    float s = x * (1.0f + x2 * (-1.0f / 6 + x2 * (1.0f / 120 + x2 * (-1.0f / 5040))));
    float c = 1.0f + x2 * (-0.5f + x2 * (1.0f / 24 + x2 * (-1.0f / 720 + x2 * (1.0f / 40320))));
    int q = (int)quadrant & 3;
    float swapped_s = q & 1 ? c : s, swapped_c = q & 1 ? s : c;
    *sine = q & 2 ? -swapped_s : swapped_s;
    *cosine = (q == 1) || (q == 2) ? -swapped_c : swapped_c;
}

// Cosine-distributed about n: a uniform point on the unit sphere resting on n.
static inline Vec3 warp_cosine(Vec3 n, float u, float v)
{
    float s, c;
    sincos_turn(u, &s, &c);
    float z = 1.0f - 2.0f * v;
    float r = sqrtf(fmaxf(0.0f, 1.0f - z * z));
    Vec3 d = vec3(n.x + r * c, n.y + r * s, n.z + z);
    float square = vec3_dot(d, d);
    return square > 1e-12f ? vec3_scale(d, 1.0f / sqrtf(square)) : n;
}

#endif
