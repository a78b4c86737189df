#include "render/integrator.h"

#include "base/random.h"
#include "render/first_seen.h"
#include "render/path.h"
#include "render/world.h"

#include <stddef.h>

enum { MOST_CROSSINGS = 256 }; // of index-matched interfaces by one path

void path_add_light(Path *path, Vec3 radiance)
{
    Vec3 light = vec3_mul(path->throughput, radiance);
    Vec3 *sum = path->depth < 2 ? &path->direct : &path->indirect;
    *sum = vec3_add(*sum, light);
}

// Paths that carry less than half of what the camera sent survive in proportion to it. Measured:
// less noise for the time than the throughput itself or its square root.
bool path_survives(Path *path)
{
    if (path->depth < path->tracer->world->render.roulette_depth) {
        return true;
    }
    Vec3 t = path->throughput;
    float chance = 2.0f * larger(t.x, larger(t.y, t.z));
    if (chance >= 1.0f) {
        return true;
    }
    if (path->roulette >= chance) {
        return false;
    }
    path->throughput = vec3_scale(t, 1.0f / chance);
    return true;
}

static void start_path(Path *path, const Tracer *tracer, int x, int y, int sample)
{
    *path = (Path){.tracer = tracer,
                   .throughput = {1.0f, 1.0f, 1.0f},
                   .media.now = tracer->outside,
                   .spread = tracer->camera.pixel_angle,
                   .mirrored = true,
                   .straight = true,
                   .rays = 1};
    path->sampler = sampler_at(&tracer->plan, (uint32_t)x, (uint32_t)y, (uint32_t)sample);
    float u[4];
    sampler_draw(&path->sampler, SET_CAMERA, u);
    float film_x = (float)x + 0.5f + filter_sample(&tracer->filter, u[0]);
    float film_y = (float)y + 0.5f + filter_sample(&tracer->filter, u[1]);
    path->ray.far = INFINITY;
    path->key = (uint32_t)random_key(path->sampler.key, path->sampler.reversed);
    path->ray.key = path->key++;
    camera_ray(&tracer->camera, film_x, film_y, u + 2, &path->ray.origin, &path->ray.direction);
    path->start = path->from.position = path->ray.origin;
}

// A ray from the point in this direction, offset to the side of the surface that it leaves on.
static Ray ray_from(Path *path, const SurfacePoint *point, Vec3 direction)
{
    bool outside = vec3_dot(direction, point->geometric_normal) > 0.0f;
    Vec3 start = outside ? point->lifted : point->position;
    float step = outside ? point->epsilon : -point->epsilon;
    return (Ray){.origin = vec3_madd(start, step, point->facet_normal),
                 .direction = direction,
                 .far = INFINITY,
                 .key = path->key++};
}

// The ray left the scene.
static void add_background(Path *path, PathResult *result)
{
    const Sky *sky = &path->tracer->world->sky;
    if (path->depth == 0) {
        bool seen = sky->visible && sky->kind != SKY_NONE;
        result->alpha = seen ? 1.0f : 0.0f;
        if (!seen) {
            return;
        }
    }
    path_add_light(path, lights_background(path->tracer->lights, path->from.position,
                                           path->ray.direction, path->bsdf_pdf, path->spread));
}

// Total reflection at the water's surface, seen from below. False where the ray leaves the water,
// or starts outside of it.
static bool reflect_off_water(Path *path)
{
    const Tracer *tracer = path->tracer;
    const Water *water = lights_water(tracer->lights);
    float rise = path->ray.direction.y, level = tracer->world->medium.height;
    if (!water_covers(water, path->ray.origin) || !(rise > 0.0f) ||
        path->depth >= tracer->world->render.max_depth) {
        return false;
    }
    float t = (level - path->ray.origin.y) / rise;
    Vec3 point = vec3_madd(path->ray.origin, t, path->ray.direction);
    bool waves = path->bsdf_pdf <= 0.0f;
    Vec3 normal = waves ? water_normal(water, point) : vec3(0.0f, 1.0f, 0.0f);
    WaterPassage passage;
    if (water_leave(path->ray.direction, normal, &passage)) {
        return false;
    }
    Vec3 d = vec3_madd(path->ray.direction, -2.0f * vec3_dot(path->ray.direction, normal), normal);
    d.y = -fmaxf(fabsf(d.y), 1e-3f); // a steep wave must not send it out of the water
    point.y = level - 1e-5f * fmaxf(fabsf(level), t);
    path->ray =
        (Ray){.origin = point, .direction = vec3_normalize(d), .far = INFINITY, .key = path->key++};
    path->from.position = path->start = point;
    path->travelled = path->bsdf_pdf = 0.0f;
    path->straight = false;
    path->depth++;
    return true;
}

// Distance fades surfaces into the horizon's colour. Only for camera rays and mirror reflections of
// them: in diffuse light the difference does not show.
static void add_haze(Path *path, float distance)
{
    float length = path->tracer->world->sky.haze_distance;
    if (length > 0.0f && path->mirrored) {
        float clear = expf(-distance / length);
        Vec3 veil = lights_horizon(path->tracer->lights, path->ray.direction);
        path_add_light(path, vec3_scale(veil, 1.0f - clear));
        path->throughput = vec3_scale(path->throughput, clear);
    }
}

// Straight on through an index-matched interface. False after too many of them.
static bool cross_index_matched(Path *path, const SurfacePoint *point)
{
    media_cross(&path->media, path->tracer, point->material, point->backface);
    path->throughput =
        vec3_mul(path->throughput, path->tracer->world->material[point->material].color);
    path->ray = ray_from(path, point, path->ray.direction);
    path->footprint = point->footprint;
    return ++path->crossings < MOST_CROSSINGS;
}

// The AOVs of the first surface. transmittance: of the haze and films before it; what they add is a
// veil, whose albedo is white, as that of lamps and the sky.
static void note_first_hit(PathResult *result, const SurfacePoint *point, const Bsdf *bsdf,
                           float distance, float transmittance)
{
    float seen = bsdf_is_emissive(bsdf) ? 0.0f : transmittance;
    result->hit = true;
    result->albedo = vec3_add(vec3_scale(bsdf->albedo, seen), vec3_splat(1.0f - seen));
    result->normal = bsdf->normal;
    result->position = point->position;
    result->depth = distance;
    result->object = point->object;
}

// Next-event estimation: samples a light and adds what of it reaches the point.
static void add_direct_light(Path *path, const SurfacePoint *point, const Bsdf *bsdf, Vec3 wo)
{
    const Tracer *tracer = path->tracer;
    float u[4], pdf;
    sampler_draw(&path->sampler, (uint32_t)(SET_LIGHT + SETS_PER_BOUNCE * path->depth), u);
    LightSample light;
    if (!lights_sample(tracer->lights, &path->from, u, &light)) {
        return;
    }
    Vec3 f = bsdf_eval(bsdf, wo, light.direction, &pdf);
    if (!(f.x + f.y + f.z > 0.0f)) {
        return;
    }
    Ray shadow = ray_from(path, point, light.direction);
    path_aim(&shadow, &light);
    Vec3 radiance =
        vec3_scale(vec3_mul(f, light.radiance), power_heuristic(light.pdf, pdf) / light.pdf);
    if (tracer->has_index_matched || path->media.now.present || tracer->outside.present) {
        Vec3 share;
        Media media = path->media;
        if (bsdf->traits & TRAIT_BODY &&
            vec3_dot(light.direction, point->geometric_normal) < 0.0f) {
            media_cross(&media, tracer, point->material, point->backface);
        }
        if (!path_lets_through(path, &shadow, &light, &media, &share)) {
            return;
        }
        radiance = vec3_mul(radiance, share);
    } else {
        path->rays++;
        if (accel_occluded(tracer->accel, &shadow)) {
            return;
        }
    }
    path->depth++; // the light is one bounce further
    path_add_light(path, radiance);
    path->depth--;
}

// Samples the BSDF for the next ray. False when the path ends here.
static bool bounce(Path *path, const SurfacePoint *point, const Bsdf *bsdf, Vec3 wo)
{
    float u[4];
    sampler_draw(&path->sampler, (uint32_t)(SET_BSDF + SETS_PER_BOUNCE * path->depth), u);
    BsdfSample sample;
    if (!bsdf_sample(bsdf, wo, u, &sample)) {
        return false;
    }
    path->throughput = vec3_mul(path->throughput, sample.weight);
    path->ray = ray_from(path, point, sample.wi);
    path->depth++;
    path->footprint = point->footprint;
    path->roulette = u[3];
    if (sample.transmitted && bsdf->traits & TRAIT_THIN) {
        return true; // goes straight on, as shadow rays do
    }
    path->straight = false;
    path->start = path->ray.origin;
    path->travelled = 0.0f;
    path->bsdf_pdf = sample.delta ? 0.0f : sample.pdf;
    if (!sample.delta) {
        path->mirrored = false;
        path->spread = larger(path->spread, 0.25f / (1.0f + sample.pdf));
    }
    if (sample.transmitted && bsdf->traits & TRAIT_BODY) {
        media_cross(&path->media, path->tracer, point->material, point->backface);
    }
    return true;
}

// What a surface adds to the path, and the ray that leaves it. False when the path ends here.
static bool scatter_at(Path *path, const Hit *hit, const SurfacePoint *point, PathResult *result)
{
    const Tracer *tracer = path->tracer;
    Vec3 wo = vec3_neg(path->ray.direction);
    Bsdf bsdf;
    bsdf_fill(tracer->materials, point, wo, &bsdf);
    if (path->straight) {
        note_first_hit(result, point, &bsdf, path->travelled,
                       fminf(luminance(path->throughput), 1.0f));
    }
    if (bsdf_is_emissive(&bsdf)) {
        SurfacePlace place = accel_place(tracer->accel, hit);
        float glow =
            lights_glow(tracer->lights, &place, point->position, &path->from, path->bsdf_pdf);
        path_add_light(path, vec3_scale(bsdf.emission, glow));
        return false;
    }
    if (path->depth >= tracer->world->render.max_depth || !path_survives(path)) {
        return false;
    }
    if (!(bsdf.traits & TRAIT_THIN)) {
        bool opaque = bsdf.traits & TRAIT_OPAQUE;
        path->from =
            (LightReceiver){point->position, opaque ? point->geometric_normal : vec3_splat(0.0f)};
        if (lights_can_sample(tracer->lights)) {
            add_direct_light(path, point, &bsdf, wo);
        }
    }
    return bounce(path, point, &bsdf, wo);
}

// The ray met a lamp or a surface. False when the path ends there.
static bool arrive(Path *path, const Hit *hit, PathResult *result)
{
    const Tracer *tracer = path->tracer;
    add_haze(path, hit->t);
    int light = accel_light(tracer->accel, hit);
    if (light >= 0) {
        path_add_light(path, lights_emitted(tracer->lights, light, path->start, path->ray.direction,
                                            path->travelled + hit->t, path->bsdf_pdf));
        return false;
    }
    path->travelled += hit->t;
    SurfacePoint point;
    accel_surface(tracer->accel, &path->ray, hit, &point);
    point.footprint = path->footprint + path->spread * hit->t;
    if (tracer->has_index_matched &&
        material_is_index_matched(&tracer->world->material[point.material])) {
        return cross_index_matched(path, &point);
    }
    return scatter_at(path, hit, &point, result);
}

// Follows the path to its end. met, hit: what its camera ray met.
static void trace_path(Path *path, bool met, Hit *hit, PathResult *result)
{
    const Tracer *tracer = path->tracer;
    for (;; path->rays++, met = accel_intersect(tracer->accel, &path->ray, hit)) {
        if (path->media.now.present) {
            Travel travel = path_travel(path, met ? hit->t : INFINITY);
            if (travel == TRAVEL_ENDED) {
                return;
            }
            if (travel == TRAVEL_SCATTERED) {
                continue;
            }
        }
        if (!met) {
            if (tracer->world->medium.kind == MEDIUM_WATER && reflect_off_water(path)) {
                continue;
            }
            add_background(path, result);
            return;
        }
        if (!arrive(path, hit, result)) {
            return;
        }
    }
}

// Bounds the luminance of indirect light: what exceeds the limit is hardly ever light, but noise.
static Vec3 clamped(Vec3 light, float limit)
{
    float l = luminance(light);
    return limit > 0.0f && l > limit ? vec3_scale(light, limit / l) : light;
}

void integrator_paths(const Tracer *tracer, int x, int y, int sample, int count,
                      PathResult result[])
{
    Path path[PACKET_SIZE];
    const Ray *ray[PACKET_SIZE] = {NULL};
    Hit hit[PACKET_SIZE];
    bool met[PACKET_SIZE];
    for (int i = 0; i < count; i++) {
        start_path(&path[i], tracer, x, y, sample + i);
        ray[i] = &path[i].ray;
    }
    accel_intersect_packet(tracer->accel, ray, count, hit, met);
    for (int i = 0; i < count; i++) {
        result[i] = (PathResult){.albedo = vec3_splat(1.0f), .alpha = 1.0f, .depth = INFINITY};
        first_seen(tracer, ray[i], met[i], &hit[i], &result[i]);
        trace_path(&path[i], met[i], &hit[i], &result[i]);
        Vec3 color =
            vec3_add(path[i].direct, clamped(path[i].indirect, tracer->world->render.clamp));
        result[i].color = vec3_finite(color) ? color : vec3_splat(0.0f);
        result[i].rays = path[i].rays;
    }
}
