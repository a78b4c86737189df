// The leaf: a thin sheet that reflects and lets through diffusely, under a wax coat.
#include "render/bsdf_lobes.h"

Vec3 leaf_draw(const Bsdf *bsdf, Vec3 wo, const float u[3])
{
    (void)wo;
    float r = luminance_of(bsdf->color), t = luminance_of(bsdf->transmittance);
    bool through = u[2] * (r + t) < t;
    return draw_cosine(through ? vec3_neg(bsdf->normal) : bsdf->normal, u[0], u[1]);
}

Vec3 leaf_eval(const Bsdf *bsdf, Vec3 wo, Vec3 wi, float *pdf)
{
    (void)wo;
    float cosine = vec3_dot(bsdf->normal, wi);
    float r = luminance_of(bsdf->color), t = luminance_of(bsdf->transmittance);
    float share = (cosine < 0.0f ? t : r) / fmaxf(r + t, 1e-12f);
    *pdf = share * fabsf(cosine) * (1.0f / PI_F);
    return vec3_scale(cosine < 0.0f ? bsdf->transmittance : bsdf->color,
                      fabsf(cosine) * (1.0f / PI_F));
}
