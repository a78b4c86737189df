// A path in a medium: where it scatters, and the light that is scattered into its ray.
//
// In-scattered light is sampled at one point of each stretch; before the camera at several where
// there are lamps. A point is drawn in one of two ways: by equal angles about a pivot on a near
// light (Kulla and Fajardo, "Importance Sampling Techniques for Path Tracing in Participating
// Media", EGSR 2012), or by transmittance; the balance heuristic combines both. The path itself
// scatters or passes by a distance drawn for one of three channels, weighted over all (Wilkie et
// al., "Hero Wavelength Spectral Sampling", EGSR 2014).
#include "render/path.h"

#include <stddef.h>

enum { MOST_STRETCHES = 512 };

// The throughput of the channels that scatter, normalised to sum 1.
static Vec3 channel_weights(Vec3 throughput, Vec3 carrying)
{
    Vec3 w = vec3(carrying.x > 0.0f ? throughput.x : 0.0f, carrying.y > 0.0f ? throughput.y : 0.0f,
                  carrying.z > 0.0f ? throughput.z : 0.0f);
    float sum = w.x + w.y + w.z;
    return sum > 0.0f ? vec3_scale(w, 1.0f / sum) : vec3_splat(1.0f / 3.0f);
}

// ---- light gathered on the way

// The part of a ray in a medium.
typedef struct Stretch {
    const MediumLine *line;
    LightSegment segment;
    Vec3 weight; // of the channels
} Stretch;

// The angles under which a pivot sees a stretch.
typedef struct Fan {
    float foot, distance, angle0, angle1;
} Fan;

static bool fan_from(const LightSegment *s, Vec3 pivot, Fan *fan)
{
    Vec3 to = vec3_sub(pivot, s->origin);
    fan->foot = vec3_dot(to, s->direction);
    float square = vec3_dot(to, to);
    float aside = square - fan->foot * fan->foot;
    fan->distance = sqrtf(fmaxf(aside, 1e-8f * square + 1e-12f));
    fan->angle0 = atanf((s->near - fan->foot) / fan->distance);
    fan->angle1 = atanf((s->far - fan->foot) / fan->distance);
    return fan->angle1 - fan->angle0 > 1e-5f;
}

static float fan_density(const Fan *fan, float t)
{
    float off = t - fan->foot;
    return fan->distance /
           ((fan->angle1 - fan->angle0) * (fan->distance * fan->distance + off * off));
}

// Draws a point of the stretch and a light sample from there, with the density that light sampling
// from the point would have; false if there is none. *pdf: of both, per metre and steradian.
static bool draw_gathering(const Path *path, const Stretch *s, const float u[4], const float v[4],
                           float *t, SegmentLight *light, float *pdf)
{
    const Lights *lights = path->tracer->lights;
    const Filling *filling = &path->media.now;
    LightChoice choice = lights_choose_along(lights, &s->segment, u[0]);
    bool pivoted = choice.near && v[2] < 0.5f;
    LightPivot pivot;
    Fan fan;
    if (pivoted) {
        if (!lights_draw_pivot(lights, &choice, &s->segment, v, &pivot) ||
            !fan_from(&s->segment, pivot.position, &fan)) {
            return false;
        }
        *t = fan.foot + fan.distance * tanf(lerpf(fan.angle0, fan.angle1, u[1]));
        *t = clampf(*t, s->segment.near, s->segment.far);
    } else {
        float length =
            medium_draw_within(filling->extinction, s->weight, s->line->length, u[2], u[1]);
        *t = medium_line_at(s->line, length);
    }
    Vec3 point = vec3_madd(path->ray.origin, *t, path->ray.direction);
    if (!lights_sample_chosen(lights, &choice, &s->segment, pivoted ? &pivot : NULL, point, v,
                              light)) {
        return false;
    }
    float length = medium_line_length(s->line, *t), density = medium_line_density(s->line, *t);
    *pdf = light->light.pdf * density *
           medium_density_within(filling->extinction, s->weight, s->line->length, length);
    if (choice.near) {
        bool seen = fan_from(&s->segment, light->pivot.position, &fan);
        *pdf = 0.5f * (*pdf + (seen ? light->pivot_pdf * fan_density(&fan, *t) : 0.0f));
    }
    *pdf *= choice.ratio;
    LightReceiver receiver = {.position = point};
    light->light.pdf *= choice.near ? lights_ratio(lights, &receiver, choice.index) : 1.0f;
    return *pdf > 0.0f;
}

// Gathers in-scattered light at one point of the stretch; share: of the points there.
static void gather_at(Path *path, const Stretch *stretch, const float u[4], const float v[4],
                      float share)
{
    const Filling *filling = &path->media.now;
    const MediumLine *line = stretch->line;
    SegmentLight on = {.pivot_pdf = 0.0f};
    float pdf, t;
    if (!draw_gathering(path, stretch, u, v, &t, &on, &pdf)) {
        return;
    }
    const LightSample *light = &on.light;
    if (path->lamps_known && isfinite(light->distance)) {
        return; // what lamps bring by way of this point is in their field
    }
    Ray shadow = {.origin = vec3_madd(path->ray.origin, t, path->ray.direction),
                  .direction = light->direction,
                  .far = INFINITY,
                  .key = path->key++};
    path_aim(&shadow, light);
    float phase =
        phase_density(filling->anisotropy, vec3_dot(path->ray.direction, light->direction));
    Vec3 f = medium_transmittance(filling->extinction, medium_line_length(line, t));
    f = vec3_mul(vec3_mul(f, filling->scattering), light->radiance);
    float density = medium_line_density(line, t);
    float weight = share * phase * density * power_heuristic(light->pdf, phase) / pdf;
    path_cast_shadow_through(path, &shadow, light, &path->media, vec3_scale(f, weight));
}

// A coordinate of point k of `count`: a lattice, shifted at random (Cranley and Patterson, 1976).
static float shifted(float u, float generator, int k)
{
    float at = u + generator * (float)k;
    return fminf(at - floorf(at), 0x1.fffffep-1f);
}

// Gathers in-scattered light on the stretch. Lamps light it unevenly: where the camera sees it, at
// several points, evenly spread along it, and by a Kronecker sequence in what chooses the light.
// (Sun and sky light it so evenly that further points cost more than they gain.)
static void gather_light(Path *path, const MediumLine *line)
{
    float u[4], v[4];
    uint32_t set = (uint32_t)(SET_MEDIUM + SETS_PER_STRETCH * path->stretches);
    sampler_draw(&path->sampler, set, u);
    sampler_draw(&path->sampler, set + 1, v);
    Stretch stretch = {
        line,
        {path->ray.origin, path->ray.direction, medium_line_near(line), medium_line_far(line)},
        channel_weights(path->throughput, path->media.now.scattering)};
    bool first = path->straight && path->stretches == 0;
    int count = first && path->tracer->has_glow ? CAMERA_GATHERS : 1;
    for (int k = 0; k < count; k++) {
        const float at[4] = {shifted(u[0], 0.8566749f, k), shifted(u[1], 1.0f / (float)count, k),
                             shifted(u[2], 0.7338919f, k), u[3]};
        const float of[4] = {shifted(v[0], 0.6287067f, k), shifted(v[1], 0.5385973f, k),
                             shifted(v[2], 0.4614029f, k), v[3]};
        gather_at(path, &stretch, at, of, 1.0f / (float)count);
    }
}

// ---- where the path itself goes

static Travel scatter(Path *path, const MediumLine *line, float length, float pdf, const float u[4])
{
    const Filling *filling = &path->media.now;
    bool outside = path->media.count == 0;
    if (outside && path->depth >= path->tracer->world->render.max_depth) {
        return TRAVEL_ENDED;
    }
    Vec3 f = vec3_mul(medium_transmittance(filling->extinction, length), filling->scattering);
    path->throughput = vec3_scale(vec3_mul(path->throughput, f), 1.0f / pdf);
    float t = medium_line_at(line, length);
    Vec3 point = vec3_madd(path->ray.origin, t, path->ray.direction);
    Vec3 direction = phase_draw(filling->anisotropy, path->ray.direction, u[2], u[3]);
    bool sampled = lights_can_sample(path->tracer->lights) && !path->media.sheltered;
    float phase = phase_density(filling->anisotropy, vec3_dot(path->ray.direction, direction));
    path->bsdf_pdf = sampled ? phase : 0.0f;
    path->near = NEAR_BY_POWER;
    path->weighed = true;
    path->from = (LightReceiver){.position = point};
    path->start = point;
    path->travelled = 0.0f;
    path->footprint += path->spread * t;
    path->spread = larger(path->spread, 0.25f / (1.0f + phase));
    path->mirrored = path->sharp = path->straight = false;
    path->gathers = true;
    path->depth += outside ? 1 : 0;
    path->ray = (Ray){.origin = point, .direction = direction, .far = INFINITY, .key = path->key++};
    float w[4];
    uint32_t set = (uint32_t)(SET_MEDIUM + SETS_PER_STRETCH * (path->stretches - 1));
    sampler_draw(&path->sampler, set, w);
    path->roulette = w[3];
    return path_survives(path) ? TRAVEL_SCATTERED : TRAVEL_ENDED;
}

Travel path_travel(Path *path, float far)
{
    const Tracer *tracer = path->tracer;
    const Filling *filling = &path->media.now;
    MediumLine line;
    if (!media_line(&path->media, tracer, &path->ray, far, &line)) {
        return TRAVEL_ARRIVED;
    }
    if (!filling->scatters) {
        Vec3 share = medium_transmittance(filling->extinction, line.length);
        path->throughput = vec3_mul(path->throughput, share);
        return TRAVEL_ARRIVED;
    }
    if (path->stretches >= MOST_STRETCHES) {
        return TRAVEL_ENDED;
    }
    bool gathers = path->depth < tracer->world->render.max_depth && !path->media.sheltered;
    if (gathers && lights_can_sample(tracer->lights)) {
        gather_light(path, &line);
    }
    float u[4], pdf;
    uint32_t set = (uint32_t)(SET_MEDIUM + SETS_PER_STRETCH * path->stretches++);
    sampler_draw(&path->sampler, set + 2, u);
    Vec3 weight = channel_weights(path->throughput, vec3_splat(1.0f));
    float length = medium_draw_length(filling->extinction, weight, line.length, u[0], u[1], &pdf);
    if (length < line.length) {
        return scatter(path, &line, length, pdf, u);
    }
    Vec3 share = medium_transmittance(filling->extinction, line.length);
    path->throughput = vec3_scale(vec3_mul(path->throughput, share), 1.0f / pdf);
    return TRAVEL_ARRIVED;
}
