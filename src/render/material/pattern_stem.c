#include "render/material/pattern_stem.h"

#include "render/material/pattern_noise.h"

#include <stddef.h>

// Unbends the stem: a point on a cylinder of the stem's radius, found from the direction of the
// normal, so that no seam shows where u closes or is uneven. along: the way in which v grows.
static StemPlace unbend(const SurfacePoint *point, Vec3 n, Vec3 along)
{
    Vec3 axis = vec3_normalize(vec3_madd(along, -vec3_dot(along, n), n));
    const Vec3 reference = {0.83f, -0.21f, 0.52f}; // few branches grow just that way
    Vec3 x = vec3_normalize(vec3_madd(reference, -vec3_dot(reference, axis), axis));
    Vec3 y = vec3_cross(axis, x);
    float c = vec3_dot(n, x), s = vec3_dot(n, y);
    return (StemPlace){.p = vec3(point->radius * c, point->radius * s, point->uv.y),
                       .along_u = vec3(-s, c, 0.0f),
                       .u = vec3_cross(axis, n),
                       .v = axis,
                       .radius = point->radius,
                       .height = point->object_position.y};
}

// The way in which v grows, from the facet's own UVs.
static Vec3 along_of(const SurfacePoint *point, Vec3 n, float length_u)
{
    Vec3 axis = vec3_cross(n, vec3_scale(point->tangent_u, 1.0f / length_u));
    return vec3_dot(axis, point->tangent_v) < 0.0f ? vec3_neg(axis) : axis;
}

static StemPlace untwisted(const SurfacePoint *point)
{
    Vec3 n = surface_smooth_normal(point);
    float u = vec3_length(point->tangent_u);
    bool diced = vec3_dot(point->along, point->along) > 0.5f;
    if (point->radius > 0.0f && (diced || u > 0.0f)) {
        return unbend(point, n, diced ? point->along : along_of(point, n, u));
    }
    // On meshes without branches (imported ones) bark runs along the object's y axis.
    const float thick = 0.3f;
    Vec3 p = point->object_position;
    Vec3 side = vec3_normalize(vec3(n.z, 0.0f, -n.x + 1e-6f));
    return (StemPlace){.p = vec3(p.x, p.z, p.y),
                       .along_u = vec3(side.x, side.z, 0.0f),
                       .u = side,
                       .v = vec3(0, 1, 0),
                       .radius = thick,
                       .height = p.y};
}

static Vec3 turned(Vec3 p, float cosine, float sine)
{
    return vec3(cosine * p.x - sine * p.y, sine * p.x + cosine * p.y, p.z);
}

StemPlace stem_place(const SurfacePoint *point, float twist)
{
    StemPlace place = untwisted(point);
    if (twist != 0.0f) {
        place.twist = twist * (PI_F / 180.0f);
        float angle = place.twist * place.p.z, c = cosf(angle), s = sinf(angle);
        place.p = turned(place.p, c, s);
        place.along_u = turned(place.along_u, c, s);
    }
    return place;
}

void stem_drift(StemPlace *place, Vec3 position)
{
    const float wavelength = 30.0f; // m
    Vec3 p = vec3(position.x / wavelength, 0.37f, position.z / wavelength);
    place->drift = vec3(2.0f * noise_solid(p, 92, NULL), 2.0f * noise_solid(p, 93, NULL),
                        6.0f * noise_solid(p, 94, NULL));
}

float stem_root(const StemPlace *place)
{
    return smoothstepf(0.55f, 0.2f, place->v.y) * smoothstepf(2.2f, 1.2f, place->p.z);
}

Vec3 stem_earth(const StemPlace *place, Vec3 color)
{
    float splash = noise_fractal(stem_lookup(place, 0.09f, 0.09f), 3, 91);
    float foot = smoothstepf(0.16f, 0.0f, place->p.z + 0.10f * splash);
    float earth = fmaxf(0.6f * foot, 0.75f * stem_root(place)) * (0.85f + 0.3f * splash);
    Vec3 soil = vec3_scale(vec3(0.080f, 0.062f, 0.044f), 1.0f + 0.4f * splash);
    return vec3_lerp(color, soil, clampf(earth, 0.0f, 1.0f));
}

void stem_add_relief(BarkLook *look, const StemPlace *place, float height, float scale,
                     float around, float along, Vec3 gradient)
{
    look->height += height;
    look->slope_u += scale / around * vec3_dot(gradient, place->along_u);
    look->slope_v += scale / along * gradient.z;
}
