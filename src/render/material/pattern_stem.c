#include "render/material/pattern_stem.h"

// Unbends the stem: a point on a cylinder of the stem's radius, found from the direction of the
// normal, so that no seam shows where u closes or is uneven. side_u: along a line of equal v,
// either way.
static StemPlace unbend(const SurfacePoint *point, Vec3 side_u)
{
    Vec3 n = point->geometric_normal;
    Vec3 axis = vec3_cross(n, side_u);
    axis = vec3_normalize(vec3_dot(axis, point->tangent_v) < 0.0f ? vec3_neg(axis) : axis);
    const Vec3 reference = {0.83f, -0.21f, 0.52f}; // few branches grow just that way
    Vec3 x = vec3_normalize(vec3_madd(reference, -vec3_dot(reference, axis), axis));
    Vec3 y = vec3_cross(axis, x);
    float c = vec3_dot(n, x), s = vec3_dot(n, y);
    return (StemPlace){vec3(point->radius * c, point->radius * s, point->uv.y),
                       vec3(-s, c, 0.0f),
                       vec3_cross(axis, n),
                       axis,
                       point->radius,
                       point->object_position.y};
}

// On meshes without branches (imported ones) bark runs along the object's y axis.
StemPlace stem_place(const SurfacePoint *point)
{
    float u = vec3_length(point->tangent_u);
    if (point->radius > 0.0f && u > 0.0f) {
        return unbend(point, vec3_scale(point->tangent_u, 1.0f / u));
    }
    const float thick = 0.3f;
    Vec3 p = point->object_position, n = point->geometric_normal;
    Vec3 side = vec3_normalize(vec3(n.z, 0.0f, -n.x + 1e-6f));
    return (StemPlace){
        vec3(p.x, p.z, p.y), vec3(side.x, side.z, 0.0f), side, vec3(0, 1, 0), thick, p.y};
}

void stem_add_slope(BarkLook *look, const StemPlace *place, float height, float around, float along,
                    Vec3 gradient)
{
    look->slope_u += height / around * vec3_dot(gradient, place->along_u);
    look->slope_v += height / along * gradient.z;
}
