// A soap film: light is mirrored in interference colours or goes straight on; nothing is lost.
#include "render/material/bsdf_lobes.h"
#include "render/material/pattern_noise.h"
#include "render/material/thin_film.h"

// Thinner above, where it has drained, thicker below; streaks that flow about each other.
static float thickness_at(const Material *m, const SurfacePoint *point)
{
    float up = point->backface ? -point->normal.y : point->normal.y; // as the mesh has it
    float drained = 1.0f - 0.75f * m->film_drainage * up;
    float scale = m->pattern_scale > 0.0f ? m->pattern_scale : 0.02f;
    Vec3 p = vec3_scale(point->object_position, 1.0f / scale);
    Vec3 flow =
        vec3(noise_fractal(p, 3, 31), 0.5f * noise_fractal(p, 3, 32), noise_fractal(p, 3, 33));
    Vec3 q = vec3_madd(vec3(p.x, 2.2f * p.y, p.z), 1.6f, flow);
    float swirl = noise_fractal(q, 4, 34);
    float thickness = m->film_thickness * drained * (1.0f + 0.8f * m->film_swirl * swirl);
    return clampf(thickness, 0.0f, THIN_FILM_MOST_NM);
}

void thin_film_prepare(Bsdf *b, const Material *m, const ThinFilmTable *table,
                       const SurfacePoint *point, float cos_o)
{
    b->specular = thin_film_color(table, thickness_at(m, point), m->ior, cos_o);
    Vec3 passed = vec3_sub(vec3_splat(1.0f), b->specular);
    b->transmittance = vec3_mul(b->color, passed);
    float r = sqrtf(luminance(b->specular)), t = sqrtf(luminance(passed));
    b->probability = r / (r + t); // least noise where both sides are about as bright
    b->albedo = vec3_splat(1.0f);
}

bool thin_film_mirror(const Bsdf *b, Vec3 wo, const float u[3], BsdfSample *sample)
{
    sample->transmitted = u[2] >= b->probability;
    if (sample->transmitted) {
        sample->wi = vec3_neg(wo);
        sample->weight = vec3_scale(b->transmittance, 1.0f / (1.0f - b->probability));
    } else {
        sample->wi = vec3_sub(vec3_scale(b->normal, 2.0f * vec3_dot(b->normal, wo)), wo);
        sample->weight = vec3_scale(b->specular, 1.0f / b->probability);
    }
    return true;
}
