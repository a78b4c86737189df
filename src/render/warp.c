#include "render/warp.h"

Vec2 warp_disc(float u, float v)
{
    float x = 2.0f * u - 1.0f, y = 2.0f * v - 1.0f, r, angle;
    if (x == 0.0f && y == 0.0f) {
        return (Vec2){0.0f, 0.0f};
    }
    if (fabsf(x) > fabsf(y)) {
        r = x;
        angle = 0.25f * PI_F * (y / x);
    } else {
        r = y;
        angle = 0.5f * PI_F - 0.25f * PI_F * (x / y);
    }
    float c = cosf(angle), s = sinf(angle);
    return (Vec2){r * c, r * s};
}

Vec3 warp_cone(Vec3 axis, float c, float sine, float turn)
{
    Vec3 a = vec3_perpendicular(axis), b = vec3_cross(axis, a);
    float angle = 2.0f * PI_F * turn;
    Vec3 side = vec3_madd(vec3_scale(a, cosf(angle)), sinf(angle), b);
    return vec3_madd(vec3_scale(axis, c), sine, side);
}
