// Rain between the camera and what a path has met: light that drops scatter once.
#include "render/path.h"

#include <math.h>

enum { STEPS = 40 };

// Rain along a ray, in equal steps, each looked up at the same random part of it.
typedef struct RainLine {
    float from, step;
    float depth[STEPS + 1]; // optical, before each step
} RainLine;

static bool find_line(const Rain *rain, const Ray *ray, float far, float jitter, RainLine *line)
{
    float from = INFINITY, to = 0.0f, a, b;
    for (int i = 0; i < rain->count; i++) {
        if (rain_segment(&rain->shaft[i], ray->origin, ray->direction, far, &a, &b)) {
            from = fminf(from, a);
            to = fmaxf(to, b);
        }
    }
    if (!(to > from)) {
        return false;
    }
    line->step = (to - from) / STEPS;
    line->from = from;
    line->depth[0] = 0.0f;
    for (int k = 0; k < STEPS; k++) {
        Vec3 p =
            vec3_madd(ray->origin, line->from + ((float)k + jitter) * line->step, ray->direction);
        float extinction = 0.0f;
        for (int i = 0; i < rain->count; i++) {
            extinction += rain_extinction(&rain->shaft[i], p);
        }
        line->depth[k + 1] = line->depth[k] + extinction * line->step;
    }
    return line->depth[STEPS] > 0.0f;
}

float path_rain_clear(const Tracer *tracer, const Ray *ray, float far)
{
    RainLine line;
    bool rains = tracer->rain.count > 0 && find_line(&tracer->rain, ray, far, 0.5f, &line);
    return rains ? expf(-line.depth[STEPS]) : 1.0f;
}

// A distance, by the share of the ray's light that is scattered before it.
static float draw_distance(const RainLine *line, float u)
{
    float lost = u * (1.0f - expf(-line->depth[STEPS])), depth = -logf(1.0f - lost);
    int k = 0;
    while (k < STEPS - 1 && line->depth[k + 1] < depth) {
        k++;
    }
    float width = line->depth[k + 1] - line->depth[k];
    float share = width > 0.0f ? clampf((depth - line->depth[k]) / width, 0.0f, 1.0f) : 0.5f;
    return line->from + ((float)k + share) * line->step;
}

// What a drop at a place scatters along the path's ray, of a light in this direction.
static void add_light(Path *path, Vec3 point, const LightSample *light, Vec3 weight)
{
    Ray shadow = {
        .origin = point, .direction = light->direction, .far = INFINITY, .key = path->key++};
    path_aim(&shadow, light);
    path->depth++; // a drop close to a lamp is bounded as indirect light is
    path_cast_shadow_through(path, &shadow, light, &path->media, vec3_mul(light->radiance, weight));
    path->depth--;
}

// Adds the light that a drop at distance t scatters along the ray: that of a sampled light, and
// that of the sky where the phase function looks, which are weighted against each other.
static void scatter(Path *path, float t, const float u[4], const float v[4])
{
    const Tracer *tracer = path->tracer;
    const RainPhase *phase = tracer->rain.phase;
    Vec3 point = vec3_madd(path->ray.origin, t, path->ray.direction);
    LightReceiver from = {.position = point};
    LightSample light;
    bool samples = lights_can_sample(tracer->lights);
    if (samples && lights_sample_mixed(tracer->lights, &from, NEAR_BY_POWER, u, &light)) {
        Vec3 density = rain_phase(phase, vec3_dot(path->ray.direction, light.direction));
        float weight = isinf(light.distance) ? power_heuristic(light.pdf, rain_phase_pdf(density))
                                             : 1.0f; // lamps are only sampled
        add_light(path, point, &light, vec3_scale(density, weight / light.pdf));
    }
    float pdf;
    Vec3 direction = rain_phase_draw(phase, path->ray.direction, v[2], v[3], &pdf);
    Vec3 density = rain_phase(phase, vec3_dot(path->ray.direction, direction));
    light = (LightSample){.direction = direction, .distance = INFINITY, .part = -1};
    light.radiance =
        lights_background(tracer->lights, point, direction, samples ? pdf : 0.0f, path->spread);
    add_light(path, point, &light, vec3_scale(density, 1.0f / rain_phase_pdf(density)));
}

void path_see_through_rain(Path *path, float distance)
{
    const Rain *rain = &path->tracer->rain;
    if (rain->count == 0 || !path->mirrored || path->media.count > 0) {
        return;
    }
    float u[4], v[4];
    sampler_draw(&path->sampler, (uint32_t)(SET_RAIN + 2 * path->depth), u);
    sampler_draw(&path->sampler, (uint32_t)(SET_RAIN + 2 * path->depth + 1), v);
    RainLine line;
    if (!find_line(rain, &path->ray, distance, v[0], &line)) {
        return;
    }
    // The light that rain holds back is a path of its own, which ends at a drop.
    float clear = expf(-line.depth[STEPS]), t = draw_distance(&line, v[1]);
    Vec3 throughput = path->throughput;
    path->throughput = vec3_scale(throughput, 1.0f - clear);
    path_see_through_air(path, t, path->tracer->world->sky.haze_distance);
    scatter(path, t, u, v);
    path->throughput = vec3_scale(throughput, clear);
}
