#include "base/triangle.h"

static Vec3 on_edge(Vec3 a, Vec3 b, Vec3 p)
{
    Vec3 edge = vec3_sub(b, a);
    float length2 = vec3_dot(edge, edge);
    float t = length2 > 0.0f ? vec3_dot(vec3_sub(p, a), edge) / length2 : 0.0f;
    return vec3_madd(a, clampf(t, 0.0f, 1.0f), edge);
}

static Vec3 nearer(Vec3 p, Vec3 a, Vec3 b)
{
    return vec3_distance(p, a) <= vec3_distance(p, b) ? a : b;
}

// The projection onto the plane if that is inside the triangle, else the nearest point of the
// edges.
Vec3 triangle_nearest(Vec3 a, Vec3 b, Vec3 c, Vec3 p)
{
    Vec3 u = vec3_sub(b, a), v = vec3_sub(c, a), from = vec3_sub(p, a);
    float uu = vec3_dot(u, u), uv = vec3_dot(u, v), vv = vec3_dot(v, v);
    float fu = vec3_dot(from, u), fv = vec3_dot(from, v), area = uu * vv - uv * uv;
    if (area > 0.0f) {
        float s = (vv * fu - uv * fv) / area, t = (uu * fv - uv * fu) / area;
        if (s >= 0.0f && t >= 0.0f && s + t <= 1.0f) {
            return vec3_madd(vec3_madd(a, s, u), t, v);
        }
    }
    return nearer(p, nearer(p, on_edge(a, b, p), on_edge(b, c, p)), on_edge(c, a, p));
}
