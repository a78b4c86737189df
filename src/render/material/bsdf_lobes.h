// What the BSDF's source files share: the lobes, each about the shading normal, not yet folded over
// the geometric horizon. Every eval returns f |cos wi|; every draw gives a unit direction
// distributed as the pdf of the eval beside it, or false where the light is lost.
#ifndef RAMIFY_RENDER_MATERIAL_BSDF_LOBES_H
#define RAMIFY_RENDER_MATERIAL_BSDF_LOBES_H

#include "base/color.h"
#include "render/material/bsdf.h"

// Sine and cosine of 2 pi u for u in [0, 1]; error below 1e-6.
static inline void sincos_turn(float u, float *sine, float *cosine)
{
    float quadrant = floorf(4.0f * u + 0.5f);
    float x = (u - 0.25f * quadrant) * (2.0f * PI_F);
    float x2 = x * x;
    float s = x * (1.0f + x2 * (-1.0f / 6 + x2 * (1.0f / 120 + x2 * (-1.0f / 5040))));
    float c = 1.0f + x2 * (-0.5f + x2 * (1.0f / 24 + x2 * (-1.0f / 720 + x2 * (1.0f / 40320))));
    int q = (int)quadrant & 3;
    float swapped_s = q & 1 ? c : s, swapped_c = q & 1 ? s : c;
    *sine = q & 2 ? -swapped_s : swapped_s;
    *cosine = (q == 1) || (q == 2) ? -swapped_c : swapped_c;
}

// Cosine-distributed about n: a uniform point on the unit sphere resting on n.
static inline Vec3 draw_cosine(Vec3 n, float u0, float u1)
{
    float s, c;
    sincos_turn(u0, &s, &c);
    float z = 1.0f - 2.0f * u1;
    float r = sqrtf(fmaxf(0.0f, 1.0f - z * z));
    Vec3 d = vec3(n.x + r * c, n.y + r * s, n.z + z);
    float square = vec3_dot(d, d);
    return square > 1e-12f ? vec3_scale(d, 1.0f / sqrtf(square)) : n;
}

// Rough diffuse reflection after Fujii, Oren and Nayar with multiple scattering between facets
// (Portsmouth et al. 2025, EON). All cosines positive; the pdf to go with it is cos / pi.
Vec3 rough_diffuse_eval(Vec3 color, float roughness, float cos_o, float cos_i, float cos_oi);

// Conductor, principled and leaf: a glossy GGX lobe over diffuse ones. bsdf_layered.c.
void layered_prepare(Bsdf *bsdf, const Material *material, bool underside, float cos_o);
bool layered_draw(const Bsdf *bsdf, Vec3 wo, const float u[3], Vec3 *wi);
Vec3 layered_eval(const Bsdf *bsdf, Vec3 wo, Vec3 wi, float *pdf);

// Rough glass. alpha > 0. bsdf_dielectric.c.
void dielectric_prepare(Bsdf *bsdf, const Material *material, bool inside, float cos_o);
bool dielectric_draw(const Bsdf *bsdf, Vec3 wo, const float u[3], Vec3 *wi);
Vec3 dielectric_eval(const Bsdf *bsdf, Vec3 wo, Vec3 wi, float *pdf);

// Mirror-like conductors and dielectrics (alpha = 0): wi, weight and transmitted of the sample.
bool conductor_mirror(const Bsdf *bsdf, Vec3 wo, BsdfSample *sample);
bool dielectric_mirror(const Bsdf *bsdf, Vec3 wo, const float u[3], BsdfSample *sample);

// Soap film. bsdf_thin_film.c.
struct ThinFilmTable;
void thin_film_prepare(Bsdf *bsdf, const Material *material, const struct ThinFilmTable *table,
                       const SurfacePoint *point, float cos_o);
bool thin_film_mirror(const Bsdf *bsdf, Vec3 wo, const float u[3], BsdfSample *sample);

#endif
