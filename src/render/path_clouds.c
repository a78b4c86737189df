// A path among clouds: droplets scatter nearly straight on, dozens of times before light leaves.
//
// The first scattering events are nature's. With each, the phase function widens and the extinction
// shrinks, so that extinction x (1 - mean cosine) stays (similarity: Zhao, Ramamoorthi and Bala,
// "High-Order Similarity Relations in Radiative Transfer", SIGGRAPH 2014): what forward scattering
// no longer changes is not traced. Droplets absorb nothing of visible light; ash does
// (clouds_albedo).
#include "render/path.h"

#include "base/random.h"

#include <stddef.h>

enum {
    ORDERS = 6,        // after so many scatterings the phase function is even
    MOST_ORDERS = 256, // scatterings of a path that the camera sees; what is lost is below 1 %
    MOST_ORDERS_DIFFUSE = 96
};

static DropletPhase phase_at(const Tracer *tracer, int order)
{
    int left = order < ORDERS ? ORDERS - order : 0;
    return droplet_phase_widened(&tracer->droplets, (float)left / ORDERS);
}

static float extinction_scale(const Tracer *tracer, int order)
{
    DropletPhase phase = phase_at(tracer, order);
    return (1.0f - droplet_phase_mean_cosine(&tracer->droplets)) /
           (1.0f - droplet_phase_mean_cosine(&phase));
}

float cloud_even_extinction(const DropletPhase *droplets)
{
    return 1.0f - droplet_phase_mean_cosine(droplets);
}

void path_leave_diffusely(Path *path)
{
    path->cloud_order = path->cloud_order > ORDERS ? path->cloud_order : ORDERS;
}

float path_pass_clouds(Path *path, const Ray *ray)
{
    const CloudSet *clouds = path->tracer->clouds;
    if (!clouds) {
        return 1.0f;
    }
    CloudRay part = {ray->origin, ray->direction, ray->far, path->cloud_order >= ORDERS};
    return clouds_pass(clouds, &part, extinction_scale(path->tracer, path->cloud_order),
                       &path->cloud_key);
}

float path_clouds_clear(Path *path, float far)
{
    const CloudSet *clouds = path->tracer->clouds;
    if (!clouds || path->media.count > 0) {
        return 1.0f;
    }
    CloudRay part = {path->ray.origin, path->ray.direction, far, path->cloud_order >= ORDERS};
    return clouds_clear(clouds, &part, extinction_scale(path->tracer, path->cloud_order),
                        &path->cloud_key);
}

// The share of the light in a cloud that comes from lamps. lamps: what the field tells of it.
static float share_of_lamps(const Tracer *tracer, float lamps)
{
    return lamps / fmaxf(lamps + lights_mean_above(tracer->lights), 1e-30f);
}

// The most of it on a camera ray's way into a cloud from p, as far as what is seen comes from:
// light that has forgotten its direction dims over transport mean free paths, 1 / (0.14
// extinction).
static float lit_from_within(const Tracer *tracer, Vec3 p, Vec3 direction)
{
    enum { STEPS = 8 };
    float densest = clouds_densest(tracer->clouds), most = 0.0f;
    float depth = 4.0f / (cloud_even_extinction(&tracer->droplets) * fmaxf(densest, 1e-9f));
    for (int i = 0; i <= STEPS && tracer->lamp_field; i++) {
        Vec3 at = vec3_madd(p, depth * (float)i / STEPS, direction);
        most = fmaxf(most, lamp_field_around(tracer->lamp_field, at));
    }
    return share_of_lamps(tracer, most);
}

// The share of a camera ray that clouds hide. *normal: the side from which they get thinner,
// weighted by how much they hide, by what rain before them lets through, and by the light from
// outside, which comes from a side: what glows from within has no form, and a denoiser would draw
// that of the normals. It depends on the ray alone, not on where a droplet scatters the path, so
// that it can guide a denoiser.
static float hidden(const Tracer *tracer, const CloudRay *ray, Vec3 *normal)
{
    float distance, opacity = clouds_seen(tracer->clouds, ray, &distance);
    *normal = vec3_splat(0.0f);
    if (opacity > 0.0f) {
        Vec3 p = vec3_madd(ray->origin, distance, ray->direction);
        Vec3 slope = clouds_slope(tracer->clouds, p);
        Ray view = {.origin = ray->origin, .direction = ray->direction, .far = distance};
        float clear = path_rain_clear(tracer, &view, distance);
        float weight = opacity * clear * (1.0f - lit_from_within(tracer, p, ray->direction));
        *normal = vec3_scale(slope, -weight / (1.0f + vec3_length(slope)));
    }
    return opacity;
}

float path_see_past_clouds(const Path *path, float far, Vec3 *normal)
{
    CloudRay part = {.origin = path->ray.origin, .direction = path->ray.direction, .far = far};
    float opacity = hidden(path->tracer, &part, normal);
    *normal = vec3_scale(*normal, opacity);
    return 1.0f - opacity;
}

// Notes the clouds before the sky. Like haze they have no place, and white albedo. All paths of a
// pixel share the normal along the ray through its middle.
static void note_cloud(Path *path)
{
    const Tracer *tracer = path->tracer;
    if (path->crossings > 0) {
        CloudRay part = {
            .origin = path->ray.origin, .direction = path->ray.direction, .far = INFINITY};
        hidden(tracer, &part, &path->result->normal);
        return;
    }
    CloudGuide *guide = path->guide;
    if (!guide->known) {
        CloudRay all = {.origin = guide->origin, .direction = guide->direction, .far = INFINITY};
        hidden(tracer, &all, &guide->normal);
        guide->known = true;
    }
    path->result->normal = guide->normal;
}

float path_meet_cloud(Path *path, float far)
{
    const CloudSet *clouds = path->tracer->clouds;
    if (!clouds || path->media.count > 0) {
        return INFINITY;
    }
    CloudRay part = {path->ray.origin, path->ray.direction, far, path->cloud_order >= ORDERS};
    float t = clouds_collide_with(clouds, &part, extinction_scale(path->tracer, path->cloud_order),
                                  &path->cloud_key, &path->cloud);
    if (path->straight && far == INFINITY) { // else path_note_behind has
        note_cloud(path);
    }
    return t;
}

static void sample_light(Path *path, Vec3 point, const float u[4])
{
    const Tracer *tracer = path->tracer;
    LightSample light;
    if (!lights_can_sample(tracer->lights) ||
        !lights_sample_mixed(tracer->lights, &path->from, path->near, u, &light) ||
        (path->lamps_known && isfinite(light.distance))) {
        return;
    }
    float cosine = vec3_dot(path->ray.direction, light.direction);
    DropletPhase droplets = phase_at(tracer, path->cloud_order);
    float phase = droplet_phase_density(&droplets, cosine);
    Ray shadow = {
        .origin = point, .direction = light.direction, .far = INFINITY, .key = path->key++};
    path_aim(&shadow, &light);
    path->cloud_order++;
    float weight = phase * power_heuristic(light.pdf, phase) / light.pdf;
    path_cast_shadow_through(path, &shadow, &light, &path->media,
                             vec3_scale(light.radiance, weight));
    path->cloud_order--;
}

// Where droplets scatter evenly, the field holds all that lamps bring from there up to the next
// surface. Before, it tells how often to look for them.
static void add_lamps(Path *path, Vec3 point)
{
    const float least = 0.1f;
    Vec3 mean;
    path->near = path->lamps_known ? 0.0f : NEAR_BY_POWER;
    if (path->lamps_known || !lamp_field_at(path->tracer->lamp_field, point, &mean)) {
        return;
    }
    if (path->cloud_order < ORDERS) {
        path->near = clampf(share_of_lamps(path->tracer, luminance(mean)), least, 1.0f - least);
        return;
    }
    path_add_light(path, mean);
    path->lamps_known = true;
    path->near = 0.0f;
}

// Takes what the particle absorbs; false if that is all.
static bool survives(Path *path)
{
    const Tracer *tracer = path->tracer;
    if (!clouds_absorb(tracer->clouds, path->cloud)) {
        return true;
    }
    path->cloud_key += 0x9e3779b97f4a7c15ull;
    float scale = extinction_scale(tracer, path->cloud_order);
    return clouds_scatter(tracer->clouds, path->cloud, scale, random_unit(path->cloud_key),
                          &path->throughput);
}

// Roulette would not do: without absorption light lasts for hundreds of scatterings, over which the
// weight of what survives grows without bound.
static bool goes_on(const Path *path)
{
    return path->cloud_order < (path->depth > 1 ? MOST_ORDERS_DIFFUSE : MOST_ORDERS);
}

Travel path_scatter_in_cloud(Path *path, float t)
{
    const Tracer *tracer = path->tracer;
    Vec3 point = vec3_madd(path->ray.origin, t, path->ray.direction);
    path_see_through_rain(path, t);
    path_see_through_air(path, t, tracer->cloud_haze);
    if (!path->in_cloud && path->depth++ >= tracer->world->render.max_depth) {
        return TRAVEL_ENDED;
    }
    if (!survives(path)) {
        return TRAVEL_ENDED;
    }
    path->in_cloud = true;
    path->mirrored = path->sharp = path->straight = false;
    path->from = (LightReceiver){.position = point};
    path->weighed = true;
    float u[4], v[4];
    uint32_t set = (uint32_t)(SET_MEDIUM + SETS_PER_STRETCH * path->stretches++);
    sampler_draw(&path->sampler, set, u);
    sampler_draw(&path->sampler, set + 1, v);
    add_lamps(path, point);
    sample_light(path, point, u);
    DropletPhase droplets = phase_at(tracer, path->cloud_order);
    Vec3 direction = droplet_phase_draw(&droplets, path->ray.direction, v[0], v[1]);
    float phase = droplet_phase_density(&droplets, vec3_dot(path->ray.direction, direction));
    path->bsdf_pdf = lights_can_sample(tracer->lights) ? phase : 0.0f;
    path->start = point;
    path->travelled = 0.0f;
    path->footprint += path->spread * t;
    path->spread = larger(path->spread, 0.25f / (1.0f + phase));
    path->ray = (Ray){.origin = point, .direction = direction, .far = INFINITY, .key = path->key++};
    path->cloud_order++;
    path->roulette = v[2];
    return goes_on(path) ? TRAVEL_SCATTERED : TRAVEL_ENDED;
}
