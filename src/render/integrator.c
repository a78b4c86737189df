#include "render/integrator.h"

#include "base/random.h"
#include "render/path.h"

#include <stddef.h>

enum { MOST_CLEAR_CROSSINGS = 256 };

void path_add_light(Path *path, Vec3 radiance)
{
    Vec3 light = vec3_mul(path->throughput, radiance);
    Vec3 *sum = path->depth < 2 ? &path->direct : &path->indirect;
    *sum = vec3_add(*sum, light);
}

// Makes *ray start at the point, on the side that direction goes to.
static void leave(Path *path, const SurfacePoint *point, Vec3 direction, Ray *ray)
{
    bool outside = vec3_dot(direction, point->geometric_normal) > 0.0f;
    Vec3 start = outside ? point->lifted : point->position;
    float step = outside ? point->epsilon : -point->epsilon;
    *ray = (Ray){.origin = vec3_madd(start, step, point->facet_normal),
                 .direction = direction,
                 .far = INFINITY,
                 .key = path->key++};
}

// Light from behind reaches leaves and glass only.
static LightReceiver receiver_at(const SurfacePoint *point, const Bsdf *bsdf)
{
    bool opaque = bsdf->kind != MATERIAL_LEAF && bsdf->kind != MATERIAL_DIELECTRIC;
    return (LightReceiver){point->position, opaque ? point->geometric_normal : vec3_splat(0.0f)};
}

// Light that reaches the point straight from a light, by sampling the light.
static void add_direct_light(Path *path, const SurfacePoint *point, const Bsdf *bsdf, Vec3 wo)
{
    float u[4], pdf;
    sampler_draw(&path->sampler, (uint32_t)(SET_LIGHT + SETS_PER_BOUNCE * path->depth), u);
    LightSample light;
    if (!lights_sample(path->tracer->lights, &path->from, u, &light)) {
        return;
    }
    Vec3 f = bsdf_eval(bsdf, wo, light.direction, &pdf);
    if (!(f.x + f.y + f.z > 0.0f)) {
        return;
    }
    Ray shadow;
    leave(path, point, light.direction, &shadow);
    path_aim(&shadow, &light);
    Vec3 radiance =
        vec3_scale(vec3_mul(f, light.radiance), power_heuristic(light.pdf, pdf) / light.pdf);
    if (path->tracer->has_clear || path->media.now.present || path->tracer->outside.present) {
        Vec3 share;
        Media media = path->media;
        if (bsdf->kind == MATERIAL_DIELECTRIC &&
            vec3_dot(light.direction, point->geometric_normal) < 0.0f) {
            media_cross(&media, path->tracer, point->material, point->backface);
        }
        if (!path_lets_through(path, &shadow, &light, &media, &share)) {
            return;
        }
        radiance = vec3_mul(radiance, share);
    } else {
        path->rays++;
        if (accel_occluded(path->tracer->accel, &shadow)) {
            return;
        }
    }
    path->depth++; // the light is one bounce further
    path_add_light(path, radiance);
    path->depth--;
}

// Distance fades what is seen into the colour of the horizon. Only what the eye sees directly or in
// a mirror: for light that comes diffusely the difference does not show.
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

// From below, the surface of the water mirrors what does not pass it.
static bool mirrored_by_water(Path *path)
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
    d.y = -fmaxf(fabsf(d.y), 1e-3f); // not out of the water by way of a steep wave
    point.y = level - 1e-5f * fmaxf(fabsf(level), t);
    path->ray =
        (Ray){.origin = point, .direction = vec3_normalize(d), .far = INFINITY, .key = path->key++};
    path->from.position = path->start = point;
    path->travelled = path->bsdf_pdf = 0.0f;
    path->straight = false;
    path->depth++;
    return true;
}

// The ray met nothing. False when the path ends there.
static bool depart(Path *path, PathResult *result)
{
    if (path->tracer->world->medium.kind == MEDIUM_WATER && mirrored_by_water(path)) {
        return true;
    }
    add_background(path, result);
    return false;
}

// seen: share of the surface's light that comes through to the eye; the rest of what is seen there
// is a veil, which reflects nothing and counts as white, as lamps and the sky do.
static void note_first_hit(PathResult *result, const SurfacePoint *point, const Bsdf *bsdf,
                           float distance, float seen)
{
    result->hit = true;
    seen = bsdf_is_emissive(bsdf) ? 0.0f : seen;
    result->albedo = vec3_add(vec3_scale(bsdf->albedo, seen), vec3_splat(1.0f - seen));
    result->normal = bsdf->normal;
    result->position = point->position;
    result->depth = distance;
    result->object = point->object;
}

// Ends weak paths by chance; the survivors stand for them. The chance to live is the root of what
// the path still carries: half way, in noise for time, between keeping all of them and keeping them
// in proportion.
bool path_survives(Path *path, float u)
{
    if (path->depth < path->tracer->world->render.roulette_depth) {
        return true;
    }
    Vec3 t = path->throughput;
    float chance = sqrtf(larger(t.x, larger(t.y, t.z)));
    if (chance >= 1.0f) {
        return true;
    }
    if (u >= chance) {
        return false;
    }
    path->throughput = vec3_scale(t, 1.0f / chance);
    return true;
}

// Sends the ray on its next way. False when the path ends here.
static bool bounce(Path *path, const SurfacePoint *point, const Bsdf *bsdf, Vec3 wo)
{
    float u[4];
    sampler_draw(&path->sampler, (uint32_t)(SET_BSDF + SETS_PER_BOUNCE * path->depth), u);
    BsdfSample sample;
    if (!bsdf_sample(bsdf, wo, u, &sample)) {
        return false;
    }
    path->throughput = vec3_mul(path->throughput, sample.weight);
    leave(path, point, sample.wi, &path->ray);
    path->depth++;
    path->footprint = point->footprint;
    if (bsdf->kind == MATERIAL_THIN_FILM && sample.transmitted) {
        return path_survives(path, u[3]); // goes on as it came, as shadow rays do
    }
    path->straight = false;
    path->start = path->ray.origin;
    path->travelled = 0.0f;
    path->bsdf_pdf = sample.delta ? 0.0f : sample.pdf;
    if (!sample.delta) {
        path->mirrored = false;
        path->spread = larger(path->spread, 0.25f / (1.0f + sample.pdf));
    }
    if (sample.transmitted && bsdf->kind == MATERIAL_DIELECTRIC) {
        media_cross(&path->media, path->tracer, point->material, point->backface);
    }
    return path_survives(path, u[3]);
}

// Into or out of a body that has no surface: straight on.
static bool pass_clear(Path *path, const SurfacePoint *point)
{
    media_cross(&path->media, path->tracer, point->material, point->backface);
    path->throughput =
        vec3_mul(path->throughput, path->tracer->world->material[point->material].color);
    leave(path, point, path->ray.direction, &path->ray);
    path->footprint = point->footprint;
    return ++path->crossings < MOST_CLEAR_CROSSINGS;
}

// What the ray met. False when the path ends there.
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
    if (is_clear(tracer, point.material)) {
        return pass_clear(path, &point);
    }
    Vec3 wo = vec3_neg(path->ray.direction);
    Bsdf bsdf;
    bsdf_fill(tracer->materials, &point, wo, &bsdf);
    if (path->straight) {
        note_first_hit(result, &point, &bsdf, path->travelled,
                       fminf(luminance(path->throughput), 1.0f));
    }
    if (bsdf_is_emissive(&bsdf)) {
        SurfacePlace place = accel_place(tracer->accel, hit);
        float glow =
            lights_glow(tracer->lights, &place, point.position, &path->from, path->bsdf_pdf);
        path_add_light(path, vec3_scale(bsdf.emission, glow));
        return false;
    }
    if (path->depth >= tracer->world->render.max_depth) {
        return false;
    }
    if (bsdf.kind != MATERIAL_THIN_FILM) { // which light passes as if it were not there
        path->from = receiver_at(&point, &bsdf);
        if (lights_can_sample(tracer->lights)) {
            add_direct_light(path, &point, &bsdf, wo);
        }
    }
    return bounce(path, &point, &bsdf, wo);
}

// Lowers a too bright indirect contribution, which is noise for certain and light hardly ever.
static Vec3 clamped(Vec3 light, float limit)
{
    float l = luminance(light);
    return limit > 0.0f && l > limit ? vec3_scale(light, limit / l) : light;
}

static void begin(Path *path, const Tracer *tracer, int x, int y, int sample)
{
    const World *world = tracer->world;
    *path = (Path){.tracer = tracer,
                   .throughput = {1.0f, 1.0f, 1.0f},
                   .media.now = tracer->outside,
                   .spread = tracer->camera.pixel_angle,
                   .mirrored = true,
                   .straight = true,
                   .rays = 1};
    path->sampler = sampler_at(&tracer->sobol, tracer->seed, (uint32_t)(y * world->film.width + x),
                               (uint32_t)sample);
    float u[4];
    sampler_draw(&path->sampler, SET_CAMERA, u);
    float film_x = (float)x + 0.5f + filter_sample(&tracer->filter, u[0]);
    float film_y = (float)y + 0.5f + filter_sample(&tracer->filter, u[1]);
    path->ray.far = INFINITY;
    path->key = (uint32_t)random_key(path->sampler.key, (uint64_t)sample);
    path->ray.key = path->key++;
    camera_ray(&tracer->camera, film_x, film_y, u + 2, &path->ray.origin, &path->ray.direction);
    path->start = path->from.position = path->ray.origin;
}

// From the first hit, which is known, to the end.
static void finish(Path *path, bool met, Hit *hit, PathResult *result)
{
    const Tracer *tracer = path->tracer;
    *result = (PathResult){.albedo = vec3_splat(1.0f), .alpha = 1.0f, .depth = INFINITY};
    for (;;) {
        Travel travel = TRAVEL_ARRIVED;
        if (path->media.now.present) {
            travel = path_travel(path, met ? hit->t : INFINITY);
        }
        if (travel == TRAVEL_ENDED || (travel == TRAVEL_ARRIVED &&
                                       !(met ? arrive(path, hit, result) : depart(path, result)))) {
            break;
        }
        path->rays++;
        met = accel_intersect(tracer->accel, &path->ray, hit);
    }
    result->color = vec3_add(path->direct, clamped(path->indirect, tracer->world->render.clamp));
    if (!vec3_finite(result->color)) {
        result->color = vec3_splat(0.0f);
    }
    result->rays = path->rays;
}

void integrator_paths(const Tracer *tracer, int x, int y, int sample, int count,
                      PathResult result[])
{
    Path path[PACKET_SIZE];
    const Ray *ray[PACKET_SIZE] = {NULL};
    Hit hit[PACKET_SIZE];
    bool met[PACKET_SIZE];
    for (int i = 0; i < count; i++) {
        begin(&path[i], tracer, x, y, sample + i);
        ray[i] = &path[i].ray;
    }
    accel_intersect_packet(tracer->accel, ray, count, hit, met);
    for (int i = 0; i < count; i++) {
        finish(&path[i], met[i], &hit[i], &result[i]);
    }
}
