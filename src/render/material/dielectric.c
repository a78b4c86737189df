// Smooth or rough glass or ice (Walter et al. 2007), scaled so that no energy is lost between the
// facets.
#include "render/material/dielectric.h"

#include "render/material/bsdf_ggx.h"
#include "render/material/material_ops.h"

#include <stddef.h>

void dielectric_prepare(Bsdf *b, const MaterialEntry *entry, const SurfacePoint *point, float cos_o)
{
    const Material *m = &entry->material;
    bool inside = point->backface;
    b->delta = b->alpha <= 0.0f;
    b->eta = inside ? 1.0f / m->ior : m->ior;
    b->inside = inside;
    b->absorption = inside ? m->absorption : vec3_splat(0.0f);
    if (b->alpha > 0.0f) {
        b->restore_o = ggx_table_at(b->table->restore[inside], cos_o);
    }
}

// The direction refracted at a facet h; false at total reflection.
static bool refract(Vec3 wo, Vec3 h, float eta, Vec3 *wi)
{
    float cosine = vec3_dot(wo, h), cosine_t;
    if (fresnel_dielectric(cosine, eta, &cosine_t) >= 1.0f) {
        return false;
    }
    *wi = vec3_normalize(
        vec3_sub(vec3_scale(h, cosine / eta - cosine_t), vec3_scale(wo, 1.0f / eta)));
    return true;
}

bool dielectric_draw(const Bsdf *b, Vec3 wo, const float u[3], Vec3 *wi)
{
    Frame frame = frame_about(b->normal);
    Vec3 h = frame_world(&frame, ggx_draw_normal(frame_local(&frame, wo), b->alpha, u[0], u[1]));
    float cosine = vec3_dot(wo, h);
    if (u[2] < fresnel_dielectric(cosine, b->eta, NULL)) {
        *wi = vec3_normalize(vec3_sub(vec3_scale(h, 2.0f * cosine), wo));
        return vec3_dot(b->normal, *wi) > 0.0f;
    }
    return refract(wo, h, b->eta, wi) && vec3_dot(b->normal, *wi) < 0.0f;
}

// Single scattering: f |cos wi| without tint, and its density.
static float single_eval(const Bsdf *b, Vec3 wo, Vec3 wi, float signed_i, float *pdf)
{
    bool reflected = signed_i > 0.0f;
    Vec3 h = vec3_normalize(vec3_madd(wo, reflected ? 1.0f : b->eta, wi));
    float cos_h = vec3_dot(b->normal, h);
    if (cos_h < 0.0f) {
        h = vec3_neg(h);
    }
    float o_h = vec3_dot(wo, h), i_h = vec3_dot(wi, h), cos_o = vec3_dot(b->normal, wo);
    *pdf = 0.0f;
    if (o_h <= 0.0f || (reflected ? i_h <= 0.0f : i_h >= 0.0f)) {
        return 0.0f;
    }
    Vec3 across = vec3_cross(b->normal, h);
    float density = ggx_density(b->alpha, vec3_dot(across, across), cos_h * cos_h);
    float fresnel = fresnel_dielectric(o_h, b->eta, NULL);
    float lambda_o = ggx_lambda(b->alpha, cos_o);
    float lambda_i = ggx_lambda(b->alpha, fmaxf(fabsf(signed_i), 1e-6f));
    float common;
    if (reflected) {
        common = fresnel * density / (4.0f * cos_o);
    } else {
        float d = o_h + b->eta * i_h;
        common = (1.0f - fresnel) * density * o_h * b->eta * b->eta * -i_h / (cos_o * d * d);
    }
    *pdf = common / (1.0f + lambda_o);
    return common / (1.0f + lambda_o + lambda_i);
}

Vec3 dielectric_eval(const Bsdf *b, Vec3 wo, Vec3 wi, float *pdf)
{
    float signed_i = vec3_dot(b->normal, wi);
    bool reflected = signed_i > 0.0f, inside = b->inside;
    float f = single_eval(b, wo, wi, signed_i, pdf);
    bool far_side = reflected ? inside : !inside;
    f *= b->restore_o * ggx_table_at(b->table->restore[far_side], fabsf(signed_i));
    return vec3_scale(reflected ? vec3_splat(1.0f) : b->color, f);
}

bool dielectric_sample_delta(const Bsdf *b, Vec3 wo, const float u[3], BsdfSample *sample)
{
    float cosine = vec3_dot(b->normal, wo);
    float fresnel = fresnel_dielectric(cosine, b->eta, NULL);
    float chance = fmaxf(fresnel, b->favour);
    sample->transmitted = u[2] >= chance;
    if (!sample->transmitted) {
        sample->wi = vec3_sub(vec3_scale(b->normal, 2.0f * cosine), wo);
        sample->weight = vec3_splat(fresnel / chance);
        return true;
    }
    sample->weight = vec3_scale(b->color, (1.0f - fresnel) / (1.0f - chance));
    return refract(wo, b->normal, b->eta, &sample->wi);
}

static bool tabulate(MaterialEntry *entry, MaterialSet *set, Error *e)
{
    (void)set;
    bool mirror = material_entry_is_mirror(entry);
    if (!material_entry_add_table(entry, e)) {
        return false;
    }
    ggx_table_dielectric(entry->table, entry->alpha, entry->material.ior);
    entry->alpha = mirror ? 0.0f : entry->alpha;
    return true;
}

static void describe(const Material *m, Appearance *a)
{
    a->ior = m->ior;
}

static void defaults(Material *m)
{
    m->color = vec3_splat(1.0f);
    m->roughness = 0.0f;
}

const MaterialOps dielectric_ops = {.traits = TRAIT_BODY | TRAIT_MIRROR,
                                    .defaults = defaults,
                                    .describe = describe,
                                    .tabulate = tabulate,
                                    .prepare = dielectric_prepare,
                                    .eval = dielectric_eval,
                                    .draw = dielectric_draw,
                                    .sample_delta = dielectric_sample_delta};
