// Energy-preserving rough diffuse reflection.
#include "render/material/bsdf_lobes.h"

// Directional albedo of the single-scattering lobe for white facets, and its cosine-weighted mean:
// Portsmouth et al. 2025, the closed form's polynomial fit in 1 - cos and the exact mean.
static const float ALBEDO_SLOPE = 0.5f - 2.0f / (3.0f * PI_F);
static const float MEAN_SLOPE = 2.0f / 3.0f - 28.0f / (15.0f * PI_F);

static float single_albedo(float roughness, float cosine)
{
    float m = 1.0f - cosine;
    float g = m * (0.0571085289f + m * (0.491881867f + m * (-0.332181442f + m * 0.0714429953f)));
    return (1.0f + roughness * g) / (1.0f + ALBEDO_SLOPE * roughness);
}

Vec3 rough_diffuse_eval(Vec3 color, float roughness, float cos_o, float cos_i, float cos_oi)
{
    if (roughness <= 0.0f) {
        return vec3_scale(color, cos_i * (1.0f / PI_F));
    }
    float facet = 1.0f / (1.0f + ALBEDO_SLOPE * roughness);
    float s = cos_oi - cos_o * cos_i;
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
