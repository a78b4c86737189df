#include "shape/mesh_nearest.h"

#include <math.h>

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
static Vec3 on_triangle(Vec3 a, Vec3 b, Vec3 c, Vec3 p)
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

bool mesh_nearest(const Mesh *mesh, Vec3 *p, Vec3 *normal)
{
    float best = INFINITY;
    Vec3 nearest = *p;
    for (int64_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *corner = mesh->index + f * mesh->face_size;
        for (int k = 1; k + 1 < mesh->face_size; k++) {
            Vec3 a = mesh->position[corner[0]], b = mesh->position[corner[k]],
                 c = mesh->position[corner[k + 1]];
            Vec3 at = on_triangle(a, b, c, *p);
            float distance = vec3_distance(at, *p);
            Vec3 out = vec3_cross(vec3_sub(b, a), vec3_sub(c, a));
            if (distance < best && vec3_dot(out, out) > 0.0f) {
                best = distance;
                nearest = at;
                *normal = vec3_normalize(out);
            }
        }
    }
    *p = nearest;
    return best < INFINITY;
}
