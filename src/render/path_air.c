// Air and haze between the camera and what a path has met.
#include "render/path.h"

// Shade is looked for only where so much air, m, makes it visible.
static const float SHADED_AIR = 100.0f;

// Sunlight that the air at a place along the ray scatters toward its origin, unless it is hidden.
static void add_sunlit_air(Path *path, const AirView *view, const float u[2])
{
    const Sun *sun = lights_sun(path->tracer->lights);
    Ray shadow = {.origin = vec3_madd(path->ray.origin, view->at, path->ray.direction),
                  .direction = sun_sample(sun, u[0], u[1]),
                  .far = INFINITY,
                  .key = path->key++};
    LightSample light = {.direction = shadow.direction, .distance = INFINITY, .part = -1};
    path_cast_shadow_through(path, &shadow, &light, &path->media, view->sunlit);
}

static void add_air(Path *path, float distance)
{
    const Tracer *tracer = path->tracer;
    float u[4];
    sampler_draw(&path->sampler, (uint32_t)(SET_AIR + path->depth), u);
    AirView view;
    if (!lights_air(tracer->lights, path->ray.origin, path->ray.direction, distance, u[0], &view)) {
        return;
    }
    path_add_light(path, view.glow);
    bool shaded = distance * tracer->world->sky.aerial_perspective > SHADED_AIR;
    if (shaded && lights_sun(tracer->lights)) {
        add_sunlit_air(path, &view, u + 1);
    } else {
        path_add_light(path, view.sunlit);
    }
    path->throughput = vec3_mul(path->throughput, view.clear);
}

Vec3 path_air_clear(const Path *path, float distance, float haze_length)
{
    const Tracer *tracer = path->tracer;
    bool aerial = tracer->world->sky.aerial_perspective > 0.0f && path->media.count == 0;
    float clear = haze_length > 0.0f ? expf(-distance / haze_length) : 1.0f;
    AirView view;
    return aerial && lights_air(tracer->lights, path->ray.origin, path->ray.direction, distance,
                                0.5f, &view)
               ? vec3_scale(view.clear, clear)
               : vec3_splat(clear);
}

void path_see_through_air(Path *path, float distance, float haze_length)
{
    if (!path->sharp) {
        return;
    }
    if (path->tracer->world->sky.aerial_perspective > 0.0f && path->media.count == 0) {
        add_air(path, distance);
    }
    if (haze_length > 0.0f) {
        float clear = expf(-distance / haze_length);
        Vec3 veil = lights_horizon(path->tracer->lights, path->ray.direction);
        path_add_light(path, vec3_scale(veil, 1.0f - clear));
        path->throughput = vec3_scale(path->throughput, clear);
    }
}
