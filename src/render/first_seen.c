#include "render/first_seen.h"

#include <stddef.h>

static SeenKind kind_of_miss(const Tracer *tracer, Vec3 direction)
{
    const Sky *sky = &tracer->world->sky;
    if (!sky->visible || sky->kind == SKY_NONE) {
        return SEEN_SURFACE;
    }
    const Sun *sun = lights_sun(tracer->lights);
    return sun && sun_covers(sun, direction) ? SEEN_LIGHT : SEEN_SKY;
}

static const Material *material_at(const Tracer *tracer, const Hit *hit)
{
    const World *world = tracer->world;
    return &world->material[world->geometry.part[accel_place(tracer->accel, hit).part].material];
}

bool hit_glows(const Tracer *tracer, const Hit *hit)
{
    return accel_light(tracer->accel, hit) >= 0 ||
           material_has(material_at(tracer, hit), TRAIT_EMISSIVE);
}

// Does a mirror where a ray met it show a light, by geometry alone? Not if bumps or waves make it
// one: they spread a light over more than they show of it, before it is shown. *mirrored: the ray
// to the light, which ends there.
static bool mirrors_light(const Tracer *tracer, const Ray *ray, const Hit *hit, Ray *mirrored)
{
    const float calm = 1.0f - 1e-6f; // cosine
    if (!material_has(material_at(tracer, hit), TRAIT_MIRROR)) {
        return false;
    }
    SurfacePoint point;
    accel_surface(tracer->accel, ray, hit, &point);
    point.footprint = tracer->camera.pixel_angle * hit->t;
    Vec3 wo = vec3_neg(ray->direction);
    Bsdf bsdf = bsdf_at(tracer->materials, &point, wo);
    if (!bsdf.delta || vec3_dot(bsdf.normal, surface_smooth_normal(&point)) < calm) {
        return false;
    }
    const float reflects[3] = {0.0f, 0.0f, 0.0f};
    BsdfSample sample;
    if (!bsdf_sample(&bsdf, wo, reflects, &sample) || sample.transmitted) {
        return false;
    }
    *mirrored = ray_leaving(&point, sample.wi, ray->key);
    Hit met;
    if (!accel_intersect(tracer->accel, mirrored, &met) || !hit_glows(tracer, &met)) {
        return false;
    }
    mirrored->far = met.t;
    return true;
}

// 1 where the lens blurs by at most a pixel, falling to 0 at two pixels. `near` is 1 / distance.
static float sharpness(const CameraFrame *camera, float near)
{
    float aperture = 2.0f * vec3_length(camera->lens_x);
    if (aperture <= 0.0f) {
        return 1.0f;
    }
    float blur = aperture * fabsf(near - 1.0f / camera->focus) / camera->pixel_angle;
    return clampf(2.0f - blur, 0.0f, 1.0f);
}

// 1 where clouds hide up to four fifths of a light, falling to 0 where they leave a fiftieth: what
// droplets have spread over more than the light covers is then no less than what they let through.
static float clearness(const Tracer *tracer, const Ray *ray, float far)
{
    if (!tracer->clouds) {
        return 1.0f;
    }
    float distance;
    CloudRay part = {.origin = ray->origin, .direction = ray->direction, .far = far};
    return 1.0f - smoothstepf(0.8f, 0.98f, clouds_seen(tracer->clouds, &part, &distance));
}

void first_seen(const Tracer *tracer, const Ray *ray, bool met, const Hit *hit, PathResult *result)
{
    Ray mirrored;
    float far = met ? hit->t : INFINITY, clear = 1.0f;
    result->seen = met ? SEEN_SURFACE : kind_of_miss(tracer, ray->direction);
    if (met && tracer->has_glow && hit_glows(tracer, hit)) {
        result->seen = SEEN_LIGHT;
        clear = clearness(tracer, ray, far);
    } else if (met && tracer->has_glow && mirrors_light(tracer, ray, hit, &mirrored)) {
        result->seen = SEEN_LIGHT;
        clear = clearness(tracer, &mirrored, mirrored.far);
        far += mirrored.far;
    }
    float depth = far * vec3_dot(ray->direction, tracer->camera.forward);
    result->sharpness = clear * sharpness(&tracer->camera, 1.0f / depth);
}
