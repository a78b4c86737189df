#include "render/first_seen.h"

static SeenKind kind_of_miss(const Tracer *tracer, Vec3 direction)
{
    const Sky *sky = &tracer->world->sky;
    if (!sky->visible || sky->kind == SKY_NONE) {
        return SEEN_SURFACE;
    }
    const Sun *sun = lights_sun(tracer->lights);
    return sun && sun_covers(sun, direction) ? SEEN_LIGHT : SEEN_SKY;
}

static SeenKind kind_of_hit(const Tracer *tracer, const Hit *hit)
{
    if (!tracer->has_glow) {
        return SEEN_SURFACE;
    }
    if (accel_light(tracer->accel, hit) >= 0) {
        return SEEN_LIGHT;
    }
    const World *world = tracer->world;
    int part = accel_place(tracer->accel, hit).part;
    const Material *material = &world->material[world->geometry.part[part].material];
    return material_has(material, TRAIT_EMISSIVE) ? SEEN_LIGHT : SEEN_SURFACE;
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
    result->seen = met ? kind_of_hit(tracer, hit) : kind_of_miss(tracer, ray->direction);
    float depth = met ? hit->t * vec3_dot(ray->direction, tracer->camera.forward) : INFINITY;
    result->sharpness = sharpness(&tracer->camera, 1.0f / depth);
}
