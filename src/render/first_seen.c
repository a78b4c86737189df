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

static bool is_light(const Tracer *tracer, const Hit *hit)
{
    return accel_light(tracer->accel, hit) >= 0 ||
           material_has(material_at(tracer, hit), TRAIT_EMISSIVE);
}

// Does a mirror where a ray met it show a light, by geometry alone? Not if bumps or waves make it
// one: they spread a light over more than they show of it, before it is shown. *far: m, to the
// light by way of the mirror.
static bool mirrors_light(const Tracer *tracer, const Ray *ray, const Hit *hit, float *far)
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
    const float mirrored[3] = {0.0f, 0.0f, 0.0f};
    BsdfSample sample;
    if (!bsdf_sample(&bsdf, wo, mirrored, &sample) || sample.transmitted) {
        return false;
    }
    Ray on = ray_leaving(&point, sample.wi, ray->key);
    Hit met;
    if (!accel_intersect(tracer->accel, &on, &met) || !is_light(tracer, &met)) {
        return false;
    }
    *far = hit->t + met.t;
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

void first_seen(const Tracer *tracer, const Ray *ray, bool met, const Hit *hit, PathResult *result)
{
    float far = met ? hit->t : INFINITY;
    if (!met) {
        result->seen = kind_of_miss(tracer, ray->direction);
    } else {
        bool light =
            tracer->has_glow && (is_light(tracer, hit) || mirrors_light(tracer, ray, hit, &far));
        result->seen = light ? SEEN_LIGHT : SEEN_SURFACE;
    }
    float depth = far * vec3_dot(ray->direction, tracer->camera.forward);
    result->sharpness = sharpness(&tracer->camera, 1.0f / depth);
}
