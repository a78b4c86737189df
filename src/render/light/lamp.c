#include "render/light/lamp.h"

#include "render/light/lights_internal.h"
#include "render/warp.h"

float lamp_power(const Light *light, float scene_radius)
{
    float area = light->kind == LIGHT_QUAD ? vec3_length(vec3_cross(light->edge_u, light->edge_v))
                                           : 4.0f * PI_F * light->radius * light->radius;
    return luminance(light->radiance) * area / (scene_radius * scene_radius);
}

LightBounds lamp_bounds(const Light *light)
{
    Vec3 far = vec3_add(light->edge_u, light->edge_v), wide = vec3_splat(light->radius);
    Aabb ball = {vec3_sub(light->center, wide), vec3_add(light->center, wide)}, quad = aabb_empty();
    const Vec3 corner[4] = {vec3(0.0f, 0.0f, 0.0f), light->edge_u, light->edge_v, far};
    for (int i = 0; i < 4; i++) {
        quad = aabb_add(quad, vec3_add(light->corner, corner[i]));
    }
    return (LightBounds){.box = light->kind == LIGHT_QUAD ? quad : ball,
                         .axis = {0.0f, 1.0f, 0.0f},
                         .cos_normal = -1.0f,
                         .power = PI_F * lamp_power(light, 1.0f)};
}

// Density per steradian of a uniform point of the quad that lies in this direction.
static float quad_density(const Light *light, Vec3 direction, float distance)
{
    Vec3 normal = vec3_cross(light->edge_u, light->edge_v); // length: the area
    float facing = -vec3_dot(normal, direction);
    return facing > 0.0f ? distance * distance / facing : 0.0f;
}

static bool quad_sample(const Light *light, Vec3 point, const float u[2], LightSample *sample)
{
    Vec3 on = vec3_madd(vec3_madd(light->corner, u[0], light->edge_u), u[1], light->edge_v);
    Vec3 to = vec3_sub(on, point);
    sample->distance = vec3_length(to);
    if (!(sample->distance > 0.0f)) {
        return false;
    }
    sample->direction = vec3_scale(to, 1.0f / sample->distance);
    sample->pdf = quad_density(light, sample->direction, sample->distance);
    Vec3 normal = vec3_normalize(vec3_cross(light->edge_u, light->edge_v));
    sample->end =
        lights_end(on, normal, vec3_length(vec3_add(light->edge_u, light->edge_v)), point);
    return sample->pdf > 0.0f;
}

// 1 - cosine of the half angle under which the sphere is seen; 2 from inside: all directions.
static float sphere_one_minus_cos(const Light *light, Vec3 point)
{
    Vec3 to = vec3_sub(light->center, point);
    float s2 = light->radius * light->radius / vec3_dot(to, to);
    return s2 < 1.0f ? s2 / (1.0f + sqrtf(1.0f - s2)) : 2.0f;
}

static bool sphere_sample(const Light *light, Vec3 point, const float u[2], LightSample *sample)
{
    Vec3 to = vec3_sub(light->center, point);
    float cap = sphere_one_minus_cos(light, point), off = u[0] * cap;
    Vec3 axis = vec3_normalize(to);
    axis = vec3_dot(axis, axis) > 0.0f ? axis : vec3(0.0f, 1.0f, 0.0f);
    sample->direction = warp_cone(axis, 1.0f - off, sqrtf(fmaxf(0.0f, off * (2.0f - off))), u[1]);
    float along = vec3_dot(to, sample->direction);
    Vec3 aside = vec3_madd(to, -along, sample->direction);
    float half = sqrtf(fmaxf(0.0f, light->radius * light->radius - vec3_dot(aside, aside)));
    bool outside = cap < 2.0f;
    half = outside ? half : -half;
    sample->distance = along - half;
    sample->pdf = 1.0f / (2.0f * PI_F * cap);
    Vec3 out = vec3_normalize(vec3_neg(vec3_madd(aside, half, sample->direction)));
    sample->end = lights_end(vec3_madd(light->center, light->radius, out),
                             outside ? out : vec3_neg(out), light->radius, point);
    return sample->distance > 0.0f;
}

bool lamp_sample(const Light *light, Vec3 point, const float u[2], LightSample *sample)
{
    sample->radiance = light->radiance;
    sample->slack = 0.0f;
    sample->part = -1;
    return light->kind == LIGHT_QUAD ? quad_sample(light, point, u, sample)
                                     : sphere_sample(light, point, u, sample);
}

float lamp_density(const Light *light, Vec3 origin, Vec3 direction, float distance)
{
    return light->kind == LIGHT_QUAD ? quad_density(light, direction, distance)
                                     : 1.0f / (2.0f * PI_F * sphere_one_minus_cos(light, origin));
}

Vec3 lamp_pivot(const Light *light, const float u[2])
{
    return light->kind == LIGHT_QUAD
               ? vec3_madd(vec3_madd(light->corner, u[0], light->edge_u), u[1], light->edge_v)
               : light->center;
}
