#include "render/bsdf.h"

#include "render/bsdf_lobes.h"
#include "render/material_set.h"

// A shading normal that wo sees at least grazingly. Interpolated and bumped normals may turn away.
static Vec3 normal_toward(Vec3 n, Vec3 wo)
{
    const float least = 1e-3f;
    float cosine = vec3_dot(n, wo);
    return cosine >= least ? n : vec3_normalize(vec3_madd(n, 2.0f * least - cosine, wo));
}

// Reflection and transmission together never give back more than came.
static void leaf_colors(Bsdf *b, const SurfacePoint *point)
{
    if (point->backface) { // the underside: paler, greyer
        float grey = luminance_of(b->color);
        b->color = vec3_scale(vec3_lerp(b->color, vec3_splat(grey), 0.3f), 1.45f);
    }
    Vec3 sum = vec3_max(vec3_add(b->color, b->transmittance), vec3_splat(1.0f));
    b->color = vec3(b->color.x / sum.x, b->color.y / sum.y, b->color.z / sum.z);
    b->transmittance =
        vec3(b->transmittance.x / sum.x, b->transmittance.y / sum.y, b->transmittance.z / sum.z);
    b->albedo = vec3_add(b->color, b->transmittance);
}

Bsdf bsdf_at(const MaterialSet *set, const SurfacePoint *point, Vec3 wo)
{
    const Material *m = &set->material[point->material];
    Bsdf b = {.kind = m->kind,
              .normal = normal_toward(point->normal, wo),
              .geometric_normal = point->geometric_normal,
              .color = m->color,
              .roughness = m->roughness,
              .albedo = m->color};
    if (m->kind == MATERIAL_LEAF) {
        b.transmittance = m->transmittance;
        leaf_colors(&b, point);
    } else if (m->kind == MATERIAL_EMISSION) {
        b.emission = m->radiance;
        b.color = b.albedo = vec3_splat(0.0f);
    }
    return b;
}

static Vec3 diffuse_eval(const Bsdf *b, Vec3 wo, Vec3 wi, float *pdf)
{
    float cos_i = vec3_dot(b->normal, wi);
    if (cos_i <= 0.0f) {
        *pdf = 0.0f;
        return vec3_splat(0.0f);
    }
    *pdf = cos_i * (1.0f / PI_F);
    return rough_diffuse_eval(b->color, b->roughness, vec3_dot(b->normal, wo), cos_i,
                              vec3_dot(wo, wi));
}

// f |cos| about the shading normal alone.
static Vec3 eval_unfolded(const Bsdf *b, Vec3 wo, Vec3 wi, float *pdf)
{
    switch (b->kind) {
    case MATERIAL_DIFFUSE:
        return diffuse_eval(b, wo, wi, pdf);
    case MATERIAL_LEAF:
        return leaf_eval(b, wo, wi, pdf);
    default:
        *pdf = 0.0f;
        return vec3_splat(0.0f);
    }
}

Vec3 bsdf_eval(const Bsdf *bsdf, Vec3 wo, Vec3 wi, float *pdf)
{
    float side = vec3_dot(bsdf->geometric_normal, wi);
    Vec3 folded = vec3_madd(wi, -2.0f * side, bsdf->geometric_normal);
    Vec3 f = vec3_splat(0.0f);
    *pdf = 0.0f;
    if (side * vec3_dot(bsdf->normal, wi) > 0.0f) {
        f = eval_unfolded(bsdf, wo, wi, pdf);
    }
    if (side * vec3_dot(bsdf->normal, folded) > 0.0f) {
        float folded_pdf;
        f = vec3_add(f, eval_unfolded(bsdf, wo, folded, &folded_pdf));
        *pdf += folded_pdf;
    }
    return f;
}

// Mirrors wi at the geometric horizon when it left the side of its lobe.
static Vec3 fold(const Bsdf *b, Vec3 wi, bool transmitted)
{
    float side = vec3_dot(b->geometric_normal, wi);
    bool wrong = transmitted ? side > 0.0f : side < 0.0f;
    return wrong ? vec3_madd(wi, -2.0f * side, b->geometric_normal) : wi;
}

// The commonest case, with as few operations as it takes: every direction has the weight color.
static bool lambert_sample(const Bsdf *b, const float u[3], BsdfSample *sample)
{
    Vec3 wi = fold(b, draw_cosine(b->normal, u[0], u[1]), false);
    float side = vec3_dot(b->geometric_normal, wi);
    float cosine = vec3_dot(b->normal, wi);
    float folded = cosine - 2.0f * side * vec3_dot(b->normal, b->geometric_normal);
    sample->wi = wi;
    sample->weight = b->color;
    sample->pdf = (fmaxf(cosine, 0.0f) + fmaxf(folded, 0.0f)) * (1.0f / PI_F);
    sample->delta = sample->transmitted = false;
    return sample->pdf > 0.0f;
}

bool bsdf_sample(const Bsdf *bsdf, Vec3 wo, const float u[3], BsdfSample *sample)
{
    Vec3 wi;
    switch (bsdf->kind) {
    case MATERIAL_DIFFUSE:
        if (bsdf->roughness <= 0.0f) {
            return lambert_sample(bsdf, u, sample);
        }
        wi = draw_cosine(bsdf->normal, u[0], u[1]);
        break;
    case MATERIAL_LEAF:
        wi = leaf_draw(bsdf, wo, u);
        break;
    default:
        return false;
    }
    sample->delta = false;
    sample->transmitted = vec3_dot(bsdf->normal, wi) < 0.0f;
    sample->wi = fold(bsdf, wi, sample->transmitted);
    Vec3 f = bsdf_eval(bsdf, wo, sample->wi, &sample->pdf);
    if (!(sample->pdf > 0.0f)) {
        return false;
    }
    sample->weight = vec3_scale(f, 1.0f / sample->pdf);
    return true;
}
