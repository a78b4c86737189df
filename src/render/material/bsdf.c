#include "render/material/bsdf.h"

#include "render/material/bsdf_lobes.h"
#include "render/material/material_set.h"
#include "render/material/pattern.h"

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
        float grey = luminance(b->color);
        b->color = vec3_scale(vec3_lerp(b->color, vec3_splat(grey), 0.3f), 1.45f);
    }
    Vec3 sum = vec3_max(vec3_add(b->color, b->transmittance), vec3_splat(1.0f));
    b->color = vec3(b->color.x / sum.x, b->color.y / sum.y, b->color.z / sum.z);
    b->transmittance =
        vec3(b->transmittance.x / sum.x, b->transmittance.y / sum.y, b->transmittance.z / sum.z);
    b->albedo = vec3_add(b->color, b->transmittance);
}

// What the material's picture multiplies its colours with.
static Vec3 texture_at(const Texture *texture, const SurfacePoint *point)
{
    float u = vec3_length(point->tangent_u), v = vec3_length(point->tangent_v);
    return texture_color(texture, point->uv, u > 0.0f ? point->footprint / u : 0.0f,
                         v > 0.0f ? point->footprint / v : 0.0f);
}

// A plain diffuse surface: what other kinds read is left unset, since this is the commonest case
// and clearing a Bsdf takes as long as filling this one.
static inline void plain_diffuse(Bsdf *b, const Material *m, const SurfacePoint *point, Vec3 wo)
{
    b->kind = MATERIAL_DIFFUSE;
    b->normal = normal_toward(point->normal, wo);
    b->geometric_normal = point->geometric_normal;
    b->color = b->albedo = m->color;
    b->emission = b->absorption = vec3_splat(0.0f);
    b->roughness = m->roughness;
    b->alpha = 0.0f;
}

void bsdf_fill(const MaterialSet *set, const SurfacePoint *point, Vec3 wo, Bsdf *b)
{
    const MaterialEntry *entry = &set->entry[point->material];
    const Material *m = &entry->material;
    Vec3 transmittance = m->transmittance;
    if (entry->plain) {
        plain_diffuse(b, m, point, wo);
        return;
    }
    *b = (Bsdf){.kind = m->kind,
                .normal = point->normal,
                .geometric_normal = point->geometric_normal,
                .color = m->color,
                .roughness = m->roughness,
                .alpha = entry->alpha,
                .table = entry->table};
    if (m->pattern != PATTERN_NONE || m->variation > 0.0f) {
        PatternShade shade = {m->color, m->transmittance, point->normal};
        pattern_apply(m, point, &shade);
        b->color = m->kind == MATERIAL_DIELECTRIC ? m->color : shade.color; // bumps alone
        transmittance = shade.transmittance;
        b->normal = shade.normal;
    }
    if (entry->color) {
        Vec3 texel = texture_at(entry->color, point);
        b->color = vec3_mul(b->color, texel);
        transmittance = vec3_mul(transmittance, texel); // what absorbs light absorbs it both ways
    }
    b->normal = normal_toward(b->normal, wo);
    b->color = vec3_max(vec3_min(b->color, vec3_splat(1.0f)), vec3_splat(0.0f));
    b->albedo = b->color;
    switch (m->kind) {
    case MATERIAL_DIFFUSE:
        break;
    case MATERIAL_EMISSION:
        b->emission = m->radiance;
        b->color = b->albedo = vec3_splat(0.0f);
        break;
    case MATERIAL_DIELECTRIC:
        dielectric_prepare(b, m, point->backface, vec3_dot(b->normal, wo));
        break;
    case MATERIAL_THIN_FILM:
        thin_film_prepare(b, m, set->films, point, vec3_dot(b->normal, wo));
        break;
    case MATERIAL_LEAF:
        b->transmittance = vec3_max(transmittance, vec3_splat(0.0f));
        leaf_colors(b, point);
        layered_prepare(b, m, point->backface, vec3_dot(b->normal, wo));
        break;
    case MATERIAL_CONDUCTOR:
    case MATERIAL_PRINCIPLED:
        layered_prepare(b, m, false, vec3_dot(b->normal, wo));
        break;
    }
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
    case MATERIAL_DIELECTRIC:
        return dielectric_eval(b, wo, wi, pdf);
    case MATERIAL_CONDUCTOR:
    case MATERIAL_PRINCIPLED:
    case MATERIAL_LEAF:
        return layered_eval(b, wo, wi, pdf);
    case MATERIAL_EMISSION:
    case MATERIAL_THIN_FILM:
        break;
    }
    *pdf = 0.0f;
    return vec3_splat(0.0f);
}

static bool is_mirror(const Bsdf *b)
{
    return b->kind == MATERIAL_THIN_FILM ||
           (b->alpha <= 0.0f && (b->kind == MATERIAL_CONDUCTOR || b->kind == MATERIAL_DIELECTRIC));
}

// Lambert's law, folded: the commonest case, with as few operations as it takes.
static Vec3 lambert_eval(const Bsdf *b, Vec3 wi, float *pdf)
{
    float side = vec3_dot(b->geometric_normal, wi), cosine = vec3_dot(b->normal, wi);
    float folded = cosine - 2.0f * side * vec3_dot(b->normal, b->geometric_normal);
    *pdf = side > 0.0f ? (fmaxf(cosine, 0.0f) + fmaxf(folded, 0.0f)) * (1.0f / PI_F) : 0.0f;
    return vec3_scale(b->color, *pdf);
}

Vec3 bsdf_eval(const Bsdf *bsdf, Vec3 wo, Vec3 wi, float *pdf)
{
    if (bsdf->kind == MATERIAL_DIFFUSE && bsdf->roughness <= 0.0f) {
        return lambert_eval(bsdf, wi, pdf);
    }
    float side = vec3_dot(bsdf->geometric_normal, wi);
    Vec3 folded = vec3_madd(wi, -2.0f * side, bsdf->geometric_normal);
    Vec3 f = vec3_splat(0.0f);
    *pdf = 0.0f;
    if (is_mirror(bsdf)) {
        return f;
    }
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

// Every direction has the weight color.
static bool lambert_sample(const Bsdf *b, const float u[3], BsdfSample *sample)
{
    sample->wi = fold(b, draw_cosine(b->normal, u[0], u[1]), false);
    lambert_eval(b, sample->wi, &sample->pdf);
    sample->weight = b->color;
    sample->delta = sample->transmitted = false;
    return sample->pdf > 0.0f;
}

// Draws about the shading normal, not yet folded.
static bool draw_unfolded(const Bsdf *b, Vec3 wo, const float u[3], Vec3 *wi)
{
    switch (b->kind) {
    case MATERIAL_DIFFUSE:
        *wi = draw_cosine(b->normal, u[0], u[1]);
        return true;
    case MATERIAL_DIELECTRIC:
        return dielectric_draw(b, wo, u, wi);
    case MATERIAL_CONDUCTOR:
    case MATERIAL_PRINCIPLED:
    case MATERIAL_LEAF:
        return layered_draw(b, wo, u, wi);
    case MATERIAL_EMISSION:
    case MATERIAL_THIN_FILM:
        break;
    }
    return false;
}

static bool mirror_sample(const Bsdf *b, Vec3 wo, const float u[3], BsdfSample *sample)
{
    bool drawn = b->kind == MATERIAL_CONDUCTOR   ? conductor_mirror(b, wo, sample)
                 : b->kind == MATERIAL_THIN_FILM ? thin_film_mirror(b, wo, u, sample)
                                                 : dielectric_mirror(b, wo, u, sample);
    if (!drawn) {
        return false;
    }
    sample->wi = fold(b, sample->wi, sample->transmitted);
    sample->delta = true;
    sample->pdf = 0.0f;
    return true;
}

bool bsdf_sample(const Bsdf *bsdf, Vec3 wo, const float u[3], BsdfSample *sample)
{
    if (bsdf->kind == MATERIAL_DIFFUSE && bsdf->roughness <= 0.0f) {
        return lambert_sample(bsdf, u, sample);
    }
    if (is_mirror(bsdf)) {
        return mirror_sample(bsdf, wo, u, sample);
    }
    Vec3 wi;
    if (!draw_unfolded(bsdf, wo, u, &wi)) {
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
