#include "render/material/bsdf.h"

#include "render/material/layers.h"
#include "render/material/maps.h"
#include "render/material/material_ops.h"
#include "render/material/pattern.h"
#include "render/warp.h"

// A shading normal that faces wo at least grazingly. Interpolated and bumped normals may turn away.
static Vec3 normal_toward(Vec3 n, Vec3 wo)
{
    const float least = 1e-3f;
    float cosine = vec3_dot(n, wo);
    return cosine >= least ? n : vec3_normalize(vec3_madd(n, 2.0f * least - cosine, wo));
}

// The most common case, a surface of one colour whose kind has no prepare. The members that prepare
// would fill stay unset, since clearing a Bsdf takes as long as filling these.
static inline void fill_plain(Bsdf *b, const MaterialEntry *entry, const SurfacePoint *point,
                              Vec3 wo)
{
    const Material *m = &entry->material;
    b->ops = entry->ops;
    b->traits = entry->ops->traits;
    b->lambert = entry->lambert;
    b->delta = false;
    b->normal = normal_toward(point->normal, wo);
    b->geometric_normal = point->geometric_normal;
    b->color = b->albedo = m->color;
    b->emission = b->absorption = vec3_splat(0.0f);
    b->roughness = m->roughness;
    b->alpha = 0.0f;
}

void bsdf_shade(const MaterialEntry *entry, const SurfacePoint *point, Bsdf *b)
{
    const Material *m = &entry->material;
    *b = (Bsdf){.ops = entry->ops,
                .traits = entry->ops->traits,
                .lambert = entry->lambert,
                .normal = point->normal,
                .geometric_normal = point->geometric_normal,
                .color = m->color,
                .transmittance = m->transmittance,
                .roughness = m->roughness,
                .alpha = entry->alpha,
                .table = entry->table};
    if (m->pattern != PATTERN_NONE || m->variation > 0.0f || point->season != 0.0f ||
        point->young > 0.0f || point->withered > 0.0f) {
        PatternShade shade = {m->color, m->transmittance, point->normal, 0.0f, m->roughness};
        pattern_apply(m, point, &shade);
        if (b->traits & TRAIT_PATTERNED) {
            b->color = shade.color;
            b->transmittance = shade.transmittance;
        }
        b->normal = shade.normal;
        b->foam = shade.foam;
        if (pattern_varies_roughness(m)) {
            maps_set_roughness(entry, shade.roughness, b);
        }
    }
    if (entry->mapped) {
        maps_apply(entry, point, b);
    }
}

void bsdf_fill(const MaterialSet *set, const SurfacePoint *point, Vec3 wo, Bsdf *b)
{
    const MaterialEntry *entry = &set->entry[point->material];
    if (entry->plain) {
        fill_plain(b, entry, point, wo);
        return;
    }
    bsdf_shade(entry, point, b);
    if (entry->ops->shade) {
        entry->ops->shade(b, entry, point, wo);
    }
    LayerMix mix;
    bool mixed = entry->layer && layers_mix(set, entry, point, b, &mix);
    b->normal = normal_toward(b->normal, wo);
    b->color = vec3_max(vec3_min(b->color, vec3_splat(1.0f)), vec3_splat(0.0f));
    b->albedo = b->color;
    if (mixed) {
        layers_prepare(&mix, b, vec3_dot(b->normal, wo));
    } else if (entry->ops->prepare) {
        entry->ops->prepare(b, entry, point, vec3_dot(b->normal, wo));
    }
}

// Lambert's law, folded. The most common case, so with as few operations as possible.
static Vec3 lambert_eval(const Bsdf *b, Vec3 wi, float *pdf)
{
    float side = vec3_dot(b->geometric_normal, wi), cosine = vec3_dot(b->normal, wi);
    float folded = cosine - 2.0f * side * vec3_dot(b->normal, b->geometric_normal);
    *pdf = side > 0.0f ? (fmaxf(cosine, 0.0f) + fmaxf(folded, 0.0f)) * (1.0f / PI_F) : 0.0f;
    return vec3_scale(b->color, *pdf);
}

Vec3 bsdf_eval(const Bsdf *bsdf, Vec3 wo, Vec3 wi, float *pdf)
{
    if (bsdf->lambert) {
        return lambert_eval(bsdf, wi, pdf);
    }
    float side = vec3_dot(bsdf->geometric_normal, wi);
    Vec3 folded = vec3_madd(wi, -2.0f * side, bsdf->geometric_normal);
    Vec3 f = vec3_splat(0.0f);
    *pdf = 0.0f;
    if (bsdf->delta) {
        return f;
    }
    if (side * vec3_dot(bsdf->normal, wi) > 0.0f) {
        f = bsdf->ops->eval(bsdf, wo, wi, pdf);
    }
    if (side * vec3_dot(bsdf->normal, folded) > 0.0f) {
        float folded_pdf;
        f = vec3_add(f, bsdf->ops->eval(bsdf, wo, folded, &folded_pdf));
        *pdf += folded_pdf;
    }
    return f;
}

// Mirrors wi at the geometric horizon if it left the side of its lobe.
static Vec3 fold(const Bsdf *b, Vec3 wi, bool transmitted)
{
    float side = vec3_dot(b->geometric_normal, wi);
    bool wrong = transmitted ? side > 0.0f : side < 0.0f;
    return wrong ? vec3_madd(wi, -2.0f * side, b->geometric_normal) : wi;
}

// The weight of every direction is the colour.
static bool lambert_sample(const Bsdf *b, const float u[3], BsdfSample *sample)
{
    sample->wi = fold(b, warp_cosine(b->normal, u[0], u[1]), false);
    lambert_eval(b, sample->wi, &sample->pdf);
    sample->weight = b->color;
    sample->delta = sample->transmitted = false;
    return sample->pdf > 0.0f;
}

static bool sample_delta(const Bsdf *b, Vec3 wo, const float u[3], BsdfSample *sample)
{
    if (!b->ops->sample_delta || !b->ops->sample_delta(b, wo, u, sample)) {
        return false;
    }
    sample->wi = fold(b, sample->wi, sample->transmitted);
    sample->delta = true;
    sample->pdf = 0.0f;
    return true;
}

bool bsdf_sample(const Bsdf *bsdf, Vec3 wo, const float u[3], BsdfSample *sample)
{
    if (bsdf->lambert) {
        return lambert_sample(bsdf, u, sample);
    }
    if (bsdf->delta) {
        return sample_delta(bsdf, wo, u, sample);
    }
    Vec3 wi;
    if (!bsdf->ops->draw(bsdf, wo, u, &wi)) {
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
