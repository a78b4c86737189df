// The stack of media around a path, and the transmittance of shadow rays.
#include "render/path.h"

#include "render/material/bsdf_ggx.h"

#include <stddef.h>

enum { MOST_CROSSINGS = 64 };

void tracer_set_media(Tracer *tracer, Aabb bounds)
{
    const World *world = tracer->world;
    const Medium *m = &world->medium;
    if (m->kind != MEDIUM_NONE) {
        tracer->outside = filling_of(m->scattering, m->absorption, m->anisotropy);
    }
    bounds = aabb_add(bounds, world->camera.position);
    tracer->center = vec3_scale(vec3_add(bounds.low, bounds.high), 0.5f);
    float radius = 0.5f * vec3_distance(bounds.low, bounds.high);
    tracer->medium_radius = m->extent > 0.0f ? m->extent : 3.0f * radius;
    tracer->has_glow = world->light_count > 0;
    for (int64_t i = 0; i < world->geometry.count; i++) {
        const Material *surface = &world->material[world->geometry.part[i].material];
        tracer->has_glow = tracer->has_glow || material_has(surface, TRAIT_EMISSIVE);
        tracer->has_passable = tracer->has_passable || material_lets_through(surface);
    }
}

static void refresh(Media *media, const Tracer *tracer)
{
    media->sheltered = false;
    for (int i = 0; i < media->count; i++) {
        const Material *m = &tracer->world->material[media->body[i]];
        media->sheltered = media->sheltered || !material_lets_through(m);
    }
    if (media->count > 0) {
        const Material *m = &tracer->world->material[media->body[media->count - 1]];
        media->now = filling_of(m->scattering, m->absorption, m->anisotropy);
    } else {
        media->now = tracer->outside;
    }
}

void media_cross(Media *media, const Tracer *tracer, int material, bool leaving)
{
    if (!leaving) {
        if (media->count < DEEPEST_NESTING) {
            media->body[media->count++] = material;
        }
    } else {
        int i = media->count - 1;
        while (i >= 0 && media->body[i] != material) {
            i--;
        }
        if (i < 0) {
            return; // the path began inside
        }
        for (media->count--; i < media->count; i++) {
            media->body[i] = media->body[i + 1];
        }
    }
    refresh(media, tracer);
}

float open_water_passage(const Material *m, float cosine)
{
    return (1.0f - fresnel_dielectric(cosine, m->ior, NULL)) / (m->ior * m->ior);
}

bool media_line(const Media *media, const Tracer *tracer, const Ray *ray, float far,
                MediumLine *line)
{
    if (!media->now.present) {
        return false;
    }
    *line = media->count > 0 ? medium_line_inside(far)
                             : medium_line(&tracer->world->medium, tracer->center,
                                           tracer->medium_radius, ray->origin, ray->direction, far);
    return line->count > 0;
}

void media_dim(const Media *media, const Tracer *tracer, const Ray *ray, float far, Vec3 *share)
{
    MediumLine line;
    if (media_line(media, tracer, ray, far, &line)) {
        *share = vec3_mul(*share, medium_transmittance(media->now.extinction, line.length));
    }
}

// The ray is aimed from its offset origin. Aimed from the surface, it would miss the end point or
// meet other faces of the light.
void path_aim(Ray *ray, const LightSample *light)
{
    if (isinf(light->distance)) {
        return;
    }
    Vec3 to = vec3_sub(light->end, ray->origin);
    float distance = vec3_length(to);
    ray->direction = distance > 0.0f ? vec3_scale(to, 1.0f / distance) : ray->direction;
    ray->far = distance;
    ray->slack = light->slack;
    ray->part = light->part;
}

// Crosses films and index-matched interfaces one by one.
static bool passes_bodies(Path *path, Ray ray, const LightSample *light, Media media, Vec3 *share)
{
    const Tracer *tracer = path->tracer;
    for (int i = 0; i < MOST_CROSSINGS; i++) {
        Hit hit;
        path->rays++;
        bool met = accel_intersect(tracer->accel, &ray, &hit);
        media_dim(&media, tracer, &ray, met ? hit.t : ray.far, share);
        if (!met) {
            return true;
        }
        if (accel_light(tracer->accel, &hit) >= 0) {
            return false;
        }
        SurfacePoint point;
        accel_surface(tracer->accel, &ray, &hit, &point);
        const Material *m = &tracer->world->material[point.material];
        if (material_has(m, TRAIT_THIN)) {
            float cosine = fabsf(vec3_dot(ray.direction, point.geometric_normal));
            *share = vec3_scale(*share, 1.0f - material_shadow_opacity(m, cosine));
        } else if (material_has(m, TRAIT_GAS)) {
            // it lets all light pass
        } else if (material_is_index_matched(m)) {
            *share = vec3_mul(*share, m->color);
            media_cross(&media, tracer, point.material, point.backface);
        } else if (point.backface && material_has(m, TRAIT_OPEN)) {
            float cosine = fabsf(vec3_dot(ray.direction, point.geometric_normal));
            *share = vec3_scale(*share, open_water_passage(m, cosine));
            media_cross(&media, tracer, point.material, true);
        } else {
            return false;
        }
        ray.origin = vec3_madd(point.position, -point.epsilon, point.facet_normal);
        path_aim(&ray, light);
        ray.key++;
    }
    return false;
}

void path_cast_shadow_through(Path *path, const Ray *ray, const LightSample *light,
                              const Media *media, Vec3 radiance)
{
    Vec3 share = vec3_splat(path_pass_clouds(path, ray));
    if (share.x <= 0.0f) {
        return;
    }
    if (!path->tracer->has_passable) {
        media_dim(media, path->tracer, ray, ray->far, &share);
        path_cast_shadow(path, ray, vec3_mul(radiance, share));
    } else if (passes_bodies(path, *ray, light, *media, &share)) {
        path->depth++; // the light is one bounce further
        path_add_light(path, vec3_mul(radiance, share));
        path->depth--;
    }
}
