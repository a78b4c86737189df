#include "render/material/layered.h"

#include "base/color.h"
#include "render/material/bsdf_ggx.h"
#include "render/warp.h"

// The share of light that the glossy lobe leaves at a cosine.
static float left_at(const GgxTable *table, float f0, float f90, float cosine)
{
    float albedo =
        f0 * ggx_table_at(table->scale, cosine) + f90 * ggx_table_at(table->bias, cosine);
    return fmaxf(0.0f, 1.0f - albedo);
}

// Reflectance of the second and later facets: a geometric series over the mean Fresnel (Kulla and
// Conty 2017, with their F_ms over the single scattering's F).
static float metal_tint(float f0, float white_mean)
{
    float mean = f0 + (1.0f - f0) / 21.0f; // of Schlick's Fresnel over the hemisphere
    return mean * white_mean / (1.0f - mean * (1.0f - white_mean));
}

void layered_add_metal(Bsdf *b, Vec3 color, float weight, float cos_o)
{
    if (weight <= 0.0f) {
        return;
    }
    float white_mean = fminf(1.0f, b->table->mean_scale + b->table->mean_bias);
    b->metal = color;
    b->multiple = vec3_scale(vec3(metal_tint(color.x, white_mean), metal_tint(color.y, white_mean),
                                  metal_tint(color.z, white_mean)),
                             weight);
    b->restore_o = ggx_table_at(b->table->restore[0], cos_o);
}

// specular 0.5 is an index of 1.5. Below 2 % no real coat reflects: grazing fades with it.
void layered_add_coat(Bsdf *b, float specular, float weight, float cos_o)
{
    float f0 = 0.08f * specular;
    b->coat_f0 = weight * f0;
    b->coat_f90 = weight * fminf(1.0f, 50.0f * f0);
    float mean = b->coat_f0 * b->table->mean_scale + b->coat_f90 * b->table->mean_bias;
    b->coat_o = left_at(b->table, b->coat_f0, b->coat_f90, cos_o) / (1.0f - mean);
    b->specular = vec3_splat(b->coat_f0);
    b->grazing = b->coat_f90;
}

void layered_finish(Bsdf *b, float cos_o)
{
    float scale = ggx_table_at(b->table->scale, cos_o), bias = ggx_table_at(b->table->bias, cos_o);
    float glossy = luminance(b->specular) * scale + b->grazing * bias;
    float below = left_at(b->table, b->coat_f0, b->coat_f90, cos_o);
    float reflected = luminance(b->color) * below;
    float transmitted = luminance(b->transmittance) * below;
    float diffuse = reflected + transmitted;
    b->through = transmitted > 0.0f ? transmitted / diffuse : 0.0f;
    b->probability = glossy > 0.0f ? glossy / (glossy + diffuse) : 0.0f;
    if (glossy > 0.0f && diffuse > 0.0f) { // each lobe keeps a share of the samples
        b->probability = clampf(b->probability, 0.1f, 0.9f);
    }
}

void layered_prepare(Bsdf *b, float specular, float metallic, float cos_o)
{
    layered_add_coat(b, specular, 1.0f, cos_o);
    layered_add_metal(b, b->color, metallic, cos_o);
    b->specular = vec3_lerp(b->specular, b->color, metallic);
    b->grazing = lerpf(b->grazing, 1.0f, metallic);
    b->color = vec3_scale(b->color, 1.0f - metallic);
    b->transmittance = vec3_splat(0.0f);
    layered_finish(b, cos_o);
}

bool layered_draw(const Bsdf *b, Vec3 wo, const float u[3], Vec3 *wi)
{
    if (u[2] < b->probability) {
        Frame frame = frame_about(b->normal);
        Vec3 local = frame_local(&frame, wo);
        Vec3 h = ggx_draw_normal(local, b->alpha, u[0], u[1]);
        Vec3 reflected = vec3_sub(vec3_scale(h, 2.0f * vec3_dot(local, h)), local);
        *wi = vec3_normalize(frame_world(&frame, reflected));
        return vec3_dot(b->normal, *wi) > 0.0f; // else absorbed between the facets
    }
    bool through = u[2] - b->probability < b->through * (1.0f - b->probability);
    *wi = warp_cosine(through ? vec3_neg(b->normal) : b->normal, u[0], u[1]);
    return true;
}

// The glossy lobe; both directions above the surface.
static Vec3 glossy_eval(const Bsdf *b, Vec3 wo, Vec3 wi, float cos_o, float cos_i, float *pdf)
{
    Vec3 h = vec3_normalize(vec3_add(wo, wi));
    Vec3 across = vec3_cross(b->normal, h);
    float cos_h = vec3_dot(b->normal, h);
    float density = ggx_density(b->alpha, vec3_dot(across, across), cos_h * cos_h);
    float lambda_o = ggx_lambda(b->alpha, cos_o), lambda_i = ggx_lambda(b->alpha, cos_i);
    float common = density / (4.0f * cos_o);
    *pdf = common / (1.0f + lambda_o);
    float s = schlick_weight(vec3_dot(wo, h));
    Vec3 fresnel = vec3_add(vec3_scale(b->specular, 1.0f - s), vec3_splat(b->grazing * s));
    if (b->restore_o > 0.0f) {
        float more = b->restore_o * ggx_table_at(b->table->restore[0], cos_i) - 1.0f;
        Vec3 metal = vec3_add(vec3_scale(b->metal, 1.0f - s), vec3_splat(s));
        fresnel = vec3_madd(fresnel, more, vec3_mul(metal, b->multiple));
    }
    return vec3_scale(fresnel, common / (1.0f + lambda_o + lambda_i));
}

Vec3 layered_eval(const Bsdf *b, Vec3 wo, Vec3 wi, float *pdf)
{
    float signed_i = vec3_dot(b->normal, wi);
    float cos_i = fabsf(signed_i), cosine_pdf = cos_i * (1.0f / PI_F);
    float coat_i = b->coat_f90 > 0.0f ? left_at(b->table, b->coat_f0, b->coat_f90, cos_i) : 1.0f;
    float coupled = b->coat_o * coat_i * cosine_pdf;
    if (signed_i < 0.0f) {
        *pdf = (1.0f - b->probability) * b->through * cosine_pdf;
        return vec3_scale(b->transmittance, coupled);
    }
    *pdf = (1.0f - b->probability) * (1.0f - b->through) * cosine_pdf;
    Vec3 f = vec3_scale(b->color, coupled);
    if (b->probability > 0.0f) {
        float glossy_pdf;
        f = vec3_add(f, glossy_eval(b, wo, wi, vec3_dot(b->normal, wo), cos_i, &glossy_pdf));
        *pdf += b->probability * glossy_pdf;
    }
    return f;
}

// An entry before this one with the same table, which depends on alpha alone; NULL = none.
static const MaterialEntry *find_alike(const MaterialEntry *entry, const MaterialSet *set)
{
    for (const MaterialEntry *other = set->entry; other < entry; other++) {
        if (other->table && other->ops == entry->ops && other->alpha == entry->alpha) {
            return other;
        }
    }
    return NULL;
}

bool layered_tabulate(MaterialEntry *entry, MaterialSet *set, Error *e)
{
    if (!material_entry_add_table(entry, e)) {
        return false;
    }
    const MaterialEntry *alike = find_alike(entry, set);
    if (alike) {
        *entry->table = *alike->table;
    } else {
        ggx_table_reflection(entry->table, entry->alpha);
    }
    return true;
}
