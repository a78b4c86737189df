// Energy-preserving rough diffuse reflection after Fujii, Oren and Nayar, with multiple scattering
// between facets (Portsmouth et al. 2025, EON). Without roughness it is Lambert's law.
#include "render/material/material_ops.h"
#include "render/warp.h"

// Directional albedo of the single-scattering lobe for white facets, and its cosine-weighted mean:
// the closed form's polynomial fit in 1 - cos and the exact mean.
static const float ALBEDO_SLOPE = 0.5f - 2.0f / (3.0f * PI_F);
static const float MEAN_SLOPE = 2.0f / 3.0f - 28.0f / (15.0f * PI_F);

static float single_albedo(float roughness, float cosine)
{
    float m = 1.0f - cosine;
    float g = m * (0.0571085289f + m * (0.491881867f + m * (-0.332181442f + m * 0.0714429953f)));
    return (1.0f + roughness * g) / (1.0f + ALBEDO_SLOPE * roughness);
}

static Vec3 eval(const Bsdf *b, Vec3 wo, Vec3 wi, float *pdf)
{
    float cos_i = vec3_dot(b->normal, wi);
    if (cos_i <= 0.0f) {
        *pdf = 0.0f;
        return vec3_splat(0.0f);
    }
    *pdf = cos_i * (1.0f / PI_F);
    Vec3 color = b->color;
    float roughness = b->roughness, cos_o = vec3_dot(b->normal, wo);
    float facet = 1.0f / (1.0f + ALBEDO_SLOPE * roughness);
    float s = vec3_dot(wo, wi) - cos_o * cos_i;
    float t = s > 0.0f ? fmaxf(cos_o, cos_i) : 1.0f;
    float single = facet * (1.0f + roughness * s / t);
    float mean = facet * (1.0f + MEAN_SLOPE * roughness);
    float missing = (1.0f - single_albedo(roughness, cos_o)) *
                    (1.0f - single_albedo(roughness, cos_i)) / (1.0f - mean);
    Vec3 multiple = vec3(color.x * color.x * mean / (1.0f - color.x * (1.0f - mean)),
                         color.y * color.y * mean / (1.0f - color.y * (1.0f - mean)),
                         color.z * color.z * mean / (1.0f - color.z * (1.0f - mean)));
    Vec3 f = vec3_madd(vec3_scale(color, single), missing, multiple);
    return vec3_scale(f, cos_i * (1.0f / PI_F));
}

static bool draw(const Bsdf *b, Vec3 wo, const float u[3], Vec3 *wi)
{
    (void)wo;
    *wi = warp_cosine(b->normal, u[0], u[1]);
    return true;
}

static bool tabulate(MaterialEntry *entry, MaterialSet *set, Error *e)
{
    (void)set;
    (void)e;
    entry->lambert = entry->material.roughness <= 0.0f;
    return true;
}

static void defaults(Material *m)
{
    m->roughness = 0.0f;
}

const MaterialOps diffuse_ops = {.traits = TRAIT_OPAQUE | TRAIT_PATTERNED,
                                 .defaults = defaults,
                                 .tabulate = tabulate,
                                 .eval = eval,
                                 .draw = draw};
