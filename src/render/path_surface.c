// A path at a surface: what the surface adds to it, and the ray that leaves it.
#include "render/first_seen.h"
#include "render/material/bsdf_ggx.h"
#include "render/material/plasma.h"
#include "render/path.h"

#include <stddef.h>

enum { MOST_CROSSINGS = 256 }; // of index-matched interfaces by one path

// A reflection blurred so far, radians, does not show air and haze; of diffuse light it is 0.19.
static const float BLURRED = 0.15f;

// Straight on through an index-matched interface. False after too many of them.
static bool cross_index_matched(Path *path, const SurfacePoint *point)
{
    path->lamps_known = false; // the field ends at any surface
    media_cross(&path->media, path->tracer, point->material, point->backface);
    path->throughput =
        vec3_mul(path->throughput, path->tracer->world->material[point->material].color);
    path->ray = ray_leaving(point, path->ray.direction, path->key++);
    path->footprint = point->footprint;
    return ++path->crossings < MOST_CROSSINGS;
}

// Straight on through glowing gas, whose light is added: no lamp, it is found by such paths alone.
// False after too many surfaces of it.
static bool cross_gas(Path *path, const SurfacePoint *point)
{
    const Material *m = &path->tracer->world->material[point->material];
    path_add_light(path, plasma_radiance(m, point, path->ray.direction));
    path->ray = ray_leaving(point, path->ray.direction, path->key++);
    path->footprint = point->footprint;
    return ++path->crossings < MOST_CROSSINGS;
}

// From within open water, a ray from where light was gathered goes straight out, as the shadow rays
// do, or is mirrored back. False after too many crossings.
static bool leave_open_water(Path *path, const SurfacePoint *point)
{
    const Material *m = &path->tracer->world->material[point->material];
    Vec3 direction = path->ray.direction;
    float cosine = vec3_dot(direction, point->geometric_normal);
    float passage = open_water_passage(m, fabsf(cosine));
    if (path->roulette < passage) {
        path->roulette /= passage;
        return cross_index_matched(path, point);
    }
    path->roulette = (path->roulette - passage) / (1.0f - passage);
    path->ray = ray_leaving(point, vec3_madd(direction, -2.0f * cosine, point->geometric_normal),
                            path->key++);
    path->footprint = point->footprint;
    path->bsdf_pdf = 0.0f;
    path->strayed = true;
    return ++path->crossings < MOST_CROSSINGS;
}

static Vec3 at_most_one(Vec3 v)
{
    return vec3(fminf(v.x, 1.0f), fminf(v.y, 1.0f), fminf(v.z, 1.0f));
}

// Of the first surface. The haze and films before it add a veil, whose albedo is white, as that of
// lamps and the sky.
static void note_guides(const Path *path, const Bsdf *bsdf)
{
    PathResult *result = path->result;
    float transmittance = path->clear * fminf(luminance(path->throughput), 1.0f);
    float seen = bsdf_is_emissive(bsdf) ? 0.0f : transmittance;
    result->albedo = vec3_add(vec3_scale(bsdf->albedo, seen), vec3_splat(1.0f - seen));
    // in a mirror, too, a lamp shows as one
    bool mirrors = result->seen == SEEN_LIGHT && !bsdf_is_emissive(bsdf);
    result->normal = vec3_madd(path->veil_normal, mirrors ? 0.0f : path->clear, bsdf->normal);
}

// Still open water: chance decides whether the path is mirrored, so what is mirrored is looked up
// by a ray of its own, and counts by its share. Where that is the sky, the water's own guides stay.
static void note_mirrored_by_water(const Path *path, const Vertex *vertex)
{
    const float still = 0.01f, rough = 0.05f; // alpha
    const Tracer *tracer = path->tracer;
    const Bsdf *bsdf = &vertex->bsdf;
    float sharp = bsdf->delta ? 1.0f : smoothstepf(rough, still, bsdf->alpha);
    float cosine = vec3_dot(bsdf->normal, vertex->wo);
    Vec3 direction = vec3_sub(vec3_scale(bsdf->normal, 2.0f * cosine), vertex->wo);
    float side = vec3_dot(direction, bsdf->geometric_normal);
    if (vertex->point.backface || sharp <= 0.0f || bsdf->foam >= 1.0f) {
        return;
    }
    direction =
        side < 0.0f ? vec3_madd(direction, -2.0f * side, bsdf->geometric_normal) : direction;
    Ray ray = ray_leaving(&vertex->point, direction, path->key);
    Hit hit;
    if (!accel_intersect(tracer->accel, &ray, &hit) || accel_light(tracer->accel, &hit) >= 0) {
        return;
    }
    SurfacePoint point;
    accel_surface(tracer->accel, &ray, &hit, &point);
    point.footprint = vertex->point.footprint + path->spread * hit.t;
    Bsdf met = bsdf_at(tracer->materials, &point, vec3_neg(direction));
    PathResult *result = path->result;
    float share =
        sharp * path->clear * (1.0f - bsdf->foam) * fresnel_dielectric(cosine, bsdf->eta, NULL);
    Vec3 albedo = bsdf_is_emissive(&met) ? vec3_splat(1.0f) : met.albedo;
    result->albedo = vec3_lerp(result->albedo, albedo, share);
    result->normal = vec3_lerp(result->normal, met.normal, share);
}

// The AOVs of the first surface.
static void note_first_hit(const Path *path, const Vertex *vertex)
{
    PathResult *result = path->result;
    const SurfacePoint *point = &vertex->point;
    note_guides(path, &vertex->bsdf);
    if (vertex->bsdf.traits & TRAIT_OPEN && path->guided) {
        note_mirrored_by_water(path, vertex);
    }
    result->hit = true;
    result->position = point->position;
    result->depth = path->travelled;
    result->object = point->object;
}

// Albedo and normal of what a mirror or glass shows, instead of its own.
static void note_mirrored(const Path *path, const Bsdf *bsdf)
{
    Vec3 albedo = bsdf_is_emissive(bsdf) ? vec3_splat(1.0f) : bsdf->albedo;
    path->result->albedo = vec3_mul(at_most_one(path->throughput), albedo);
    path->result->normal = bsdf->normal;
}

// The density of the path's ray, as it is weighed against light sampling of this lamp (-1: glowing
// geometry).
static float pdf_against(const Path *path, int lamp)
{
    const Lights *lights = path->tracer->lights;
    float ratio = path->weighed ? lights_ratio(lights, &path->from, lamp) : 1.0f;
    return path->bsdf_pdf / (ratio * lights_mix(lights, path->near, true));
}

// Radiance of the lamp that the path's ray meets.
static Vec3 lamp_radiance(const Path *path, int lamp, const Hit *hit)
{
    return lights_emitted(path->tracer->lights, lamp, path->start, path->ray.direction,
                          path->travelled + hit->t, pdf_against(path, lamp));
}

// Radiance of the glowing surface that the path's ray meets.
static Vec3 surface_radiance(const Path *path, const Hit *hit, const SurfacePoint *point,
                             const Bsdf *bsdf)
{
    SurfacePlace place = accel_place(path->tracer->accel, hit);
    float glow = lights_glow(path->tracer->lights, &place, point->position, &path->from,
                             pdf_against(path, -1));
    return vec3_scale(bsdf->emission, glow);
}

// The same of either. 0 if it does not glow.
static Vec3 radiance_met(const Path *path, const Hit *hit)
{
    const Tracer *tracer = path->tracer;
    int lamp = accel_light(tracer->accel, hit);
    if (lamp >= 0) {
        return lamp_radiance(path, lamp, hit);
    }
    SurfacePoint point;
    accel_surface(tracer->accel, &path->ray, hit, &point);
    point.footprint = path->footprint + path->spread * hit->t;
    Bsdf bsdf;
    bsdf_fill(tracer->materials, &point, vec3_neg(path->ray.direction), &bsdf);
    return bsdf_is_emissive(&bsdf) ? surface_radiance(path, hit, &point, &bsdf) : vec3_splat(0.0f);
}

void path_show_light(Path *path, const Hit *hit)
{
    const Tracer *tracer = path->tracer;
    path->shown = path->mirrored && tracer->has_glow &&
                  (path->media.now.scatters || tracer->clouds) && hit_glows(tracer, hit);
    if (!path->shown) {
        return;
    }
    Vec3 share = path_air_clear(path, hit->t, tracer->world->sky.haze_distance);
    media_dim(&path->media, tracer, &path->ray, hit->t, &share);
    float clear = path->media.count > 0 ? 1.0f : path_rain_clear(tracer, &path->ray, hit->t);
    share = vec3_scale(share, clear * path_clouds_clear(path, hit->t));
    path_add_light(path, vec3_mul(share, radiance_met(path, hit)));
}

// Fills the vertex's BSDF. False where the path ends: on what glows, at its greatest depth, by
// roulette.
static bool shade(Vertex *vertex)
{
    Path *path = vertex->path;
    const Tracer *tracer = path->tracer;
    const SurfacePoint *point = &vertex->point;
    Bsdf *bsdf = &vertex->bsdf;
    vertex->wo = vec3_neg(path->ray.direction);
    bsdf_fill(tracer->materials, point, vertex->wo, bsdf);
    if (path->straight) {
        const float favour = 0.9f; // the other way leads to what is far darker
        bsdf->favour = path->result->seen == SEEN_LIGHT ? favour : 0.0f;
        note_first_hit(path, vertex);
    } else if (path->mirrored && path->guided) {
        note_mirrored(path, bsdf);
    }
    bool known = path->lamps_known || path->shown;
    path->lamps_known = false;
    if (bsdf_is_emissive(bsdf)) {
        if (!known) {
            path_add_light(path, surface_radiance(path, &vertex->hit, point, bsdf));
        }
        return false;
    }
    if (path->depth >= tracer->world->render.max_depth || !path_survives(path)) {
        return false;
    }
    path->in_cloud = path->strayed = false;
    if (path->depth > 0) {
        path_leave_diffusely(path);
    }
    if (!(bsdf->traits & TRAIT_THIN)) {
        path->near = NEAR_BY_POWER;
        path->weighed = false;
        bool opaque = bsdf->traits & TRAIT_OPAQUE;
        path->from =
            (LightReceiver){point->position, opaque ? point->geometric_normal : vec3_splat(0.0f)};
    }
    return true;
}

Arrival path_arrive(Vertex *vertex)
{
    Path *path = vertex->path;
    const Tracer *tracer = path->tracer;
    const Hit *hit = &vertex->hit;
    path_see_through_rain(path, hit->t);
    path_see_through_air(path, hit->t, tracer->world->sky.haze_distance);
    int light = accel_light(tracer->accel, hit);
    if (light >= 0) {
        if (!path->lamps_known && !path->shown) {
            path_add_light(path, lamp_radiance(path, light, hit));
        }
        return ARRIVAL_ENDED;
    }
    path->travelled += hit->t;
    SurfacePoint *point = &vertex->point;
    accel_surface(tracer->accel, &path->ray, hit, point);
    point->footprint = path->footprint + path->spread * hit->t;
    if (tracer->has_passable && material_lets_through(&tracer->world->material[point->material])) {
        const Material *m = &tracer->world->material[point->material];
        if (material_has(m, TRAIT_GAS)) {
            return cross_gas(path, point) ? ARRIVAL_CROSSED : ARRIVAL_ENDED;
        }
        if (material_is_index_matched(m)) {
            return cross_index_matched(path, point) ? ARRIVAL_CROSSED : ARRIVAL_ENDED;
        }
        if (path->gathers && point->backface) {
            return leave_open_water(path, point) ? ARRIVAL_CROSSED : ARRIVAL_ENDED;
        }
    }
    return shade(vertex) ? ARRIVAL_SCATTERS : ARRIVAL_ENDED;
}

void path_note_behind(Path *path, const Hit *hit)
{
    const Tracer *tracer = path->tracer;
    const Filling *filling = &path->media.now;
    MediumLine line;
    if (filling->present && filling->scatters &&
        media_line(&path->media, tracer, &path->ray, hit->t, &line)) {
        path->clear *= luminance(medium_transmittance(filling->extinction, line.length));
    }
    if (tracer->clouds && path->media.count == 0) {
        path->clear *= path_see_past_clouds(path, hit->t, &path->veil_normal);
    }
    if (accel_light(tracer->accel, hit) >= 0) {
        path->result->normal = path->veil_normal; // a lamp in a cloud leaves no mark in it
        return;
    }
    SurfacePoint point;
    accel_surface(tracer->accel, &path->ray, hit, &point);
    point.footprint = path->footprint + path->spread * hit->t;
    if (tracer->has_passable && material_lets_through(&tracer->world->material[point.material])) {
        return;
    }
    Bsdf bsdf;
    bsdf_fill(tracer->materials, &point, vec3_neg(path->ray.direction), &bsdf);
    note_guides(path, &bsdf);
}

// Does light pass foam at this vertex, which scatters it, so that it is gathered from below, too?
static bool glows_through(const Vertex *vertex)
{
    const float most = 0.3f; // foam that thin foam hides of the refracted light
    return vertex->bsdf.foam > most && vertex->bsdf.foam_through > 0.0f;
}

// Into open water light is not sampled: what leaves it again is refracted.
static bool enters_open_water(const Vertex *vertex, Vec3 direction)
{
    return vertex->bsdf.traits & TRAIT_OPEN && !vertex->point.backface && !glows_through(vertex) &&
           vec3_dot(direction, vertex->point.geometric_normal) < 0.0f;
}

void path_sample_light(Vertex *vertex, const float u[4])
{
    Path *path = vertex->path;
    const Tracer *tracer = path->tracer;
    const SurfacePoint *point = &vertex->point;
    const Bsdf *bsdf = &vertex->bsdf;
    LightSample light;
    if (bsdf->traits & TRAIT_THIN || !lights_sample(tracer->lights, &path->from, u, &light)) {
        return;
    }
    if (enters_open_water(vertex, light.direction)) {
        return;
    }
    float pdf;
    Vec3 f = bsdf_eval(bsdf, vertex->wo, light.direction, &pdf);
    if (!(f.x + f.y + f.z > 0.0f)) {
        return;
    }
    Ray shadow = ray_leaving(point, light.direction, path->key++);
    path_aim(&shadow, &light);
    Vec3 radiance =
        vec3_scale(vec3_mul(f, light.radiance), power_heuristic(light.pdf, pdf) / light.pdf);
    if (tracer->has_passable || path->media.now.present || tracer->outside.present ||
        tracer->clouds) {
        Media media = path->media;
        if (bsdf->traits & TRAIT_BODY &&
            vec3_dot(light.direction, point->geometric_normal) < 0.0f) {
            media_cross(&media, tracer, point->material, point->backface);
        }
        path_cast_shadow_through(path, &shadow, &light, &media, radiance);
    } else {
        path_cast_shadow(path, &shadow, radiance);
    }
}

bool path_bounce(Vertex *vertex, const float u[4])
{
    Path *path = vertex->path;
    const SurfacePoint *point = &vertex->point;
    const Bsdf *bsdf = &vertex->bsdf;
    BsdfSample sample;
    if (!bsdf_sample(bsdf, vertex->wo, u, &sample)) {
        return false;
    }
    path->throughput = vec3_mul(path->throughput, sample.weight);
    path->ray = ray_leaving(point, sample.wi, path->key++);
    path->depth++;
    path->footprint = point->footprint;
    path->roulette = u[3];
    if (sample.transmitted && bsdf->traits & TRAIT_THIN) {
        return true; // goes straight on, as shadow rays do
    }
    path->straight = false;
    path->guided = path->guided && !(bsdf->traits & TRAIT_OPEN); // mirrored or not: that is noise
    path->start = path->ray.origin;
    path->travelled = 0.0f;
    path->bsdf_pdf = sample.delta || enters_open_water(vertex, sample.wi) ? 0.0f : sample.pdf;
    bool gathered = !(bsdf->traits & TRAIT_OPEN) ||
                    (sample.transmitted && !point->backface && glows_through(vertex));
    path->gathers = !sample.delta && gathered;
    if (!sample.delta) {
        path->mirrored = false;
        float lobe = 0.25f / (1.0f + sample.pdf);
        path->spread = larger(path->spread, lobe);
        path->sharp = path->sharp && lobe < BLURRED;
    }
    if (sample.transmitted && bsdf->traits & TRAIT_BODY) {
        media_cross(&path->media, path->tracer, point->material, point->backface);
    }
    return true;
}
