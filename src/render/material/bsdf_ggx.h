// The GGX microfacet distribution (Walter et al. 2007) with height-correlated Smith masking, its
// sampling, and tables of its single-scattering albedo. Local frames have the shading normal along
// z.
#ifndef RAMIFY_RENDER_MATERIAL_BSDF_GGX_H
#define RAMIFY_RENDER_MATERIAL_BSDF_GGX_H

#include "base/error.h"
#include "base/vec.h"

enum { GGX_NODES = 96 };

// Functions of the cosine for one roughness, at cosines (i / (GGX_NODES - 1))^2.
typedef struct GgxTable {
    // Albedo of single scattering under Schlick's Fresnel: f0 * scale + f90 * bias; and its
    // cosine-weighted mean over the hemisphere.
    float scale[GGX_NODES], bias[GGX_NODES];
    float mean_scale, mean_bias;
    // Compensation of the energy that single scattering loses between the facets: a factor
    // restore(wo) * restore(wi) that makes a white surface reflect (a clear one reflect and
    // transmit) all of the light. It is symmetric, so reciprocity holds. [0]: outside, [1]: inside
    // glass.
    float restore[2][GGX_NODES];
} GgxTable;

// Fills scale, bias and restore of a reflecting surface of a roughness alpha, above 0 up to 1.
void ggx_table_reflection(GgxTable *table, float alpha);
// Fills restore for a dielectric of this index.
void ggx_table_dielectric(GgxTable *table, float alpha, float ior);

// Linear interpolation in one of the table's arrays at a cosine 0..1.
float ggx_table_at(const float *nodes, float cosine);

// Smith's Lambda at a cosine > 0.
static inline float ggx_lambda(float alpha, float cosine)
{
    float c2 = cosine * cosine;
    float tangent2 = fmaxf(0.0f, 1.0f - c2) / c2;
    return 0.5f * (sqrtf(1.0f + alpha * alpha * tangent2) - 1.0f);
}

// Density of facet normals at the angle whose sine squared and cosine squared are given; the sine
// apart, so that narrow lobes keep their shape in single precision.
static inline float ggx_density(float alpha, float sine2, float cosine2)
{
    float a2 = alpha * alpha;
    float d = sine2 + a2 * cosine2;
    return a2 / (PI_F * d * d);
}

// A facet normal as seen from the local direction wo (z > 0): density D G1 (wo.h) / wo.z.
// Spherical caps, Dupuy and Benyoub 2023.
Vec3 ggx_draw_normal(Vec3 wo, float alpha, float u0, float u1);

// Fresnel reflectance of a dielectric at cosine > 0; eta = index beyond over index here. cosine_t
// (may be NULL) gets the cosine of refraction, 0 at total reflection.
float fresnel_dielectric(float cosine, float eta, float *cosine_t);

static inline float schlick_weight(float cosine)
{
    float m = clampf(1.0f - cosine, 0.0f, 1.0f), m2 = m * m;
    return m2 * m2 * m;
}

// An orthonormal frame about the unit vector n (Duff et al. 2017).
typedef struct Frame {
    Vec3 x, y, z;
} Frame;

static inline Frame frame_about(Vec3 n)
{
    float sign = copysignf(1.0f, n.z);
    float a = -1.0f / (sign + n.z), b = n.x * n.y * a;
    return (Frame){vec3(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x),
                   vec3(b, sign + n.y * n.y * a, -n.y), n};
}

static inline Vec3 frame_local(const Frame *f, Vec3 v)
{
    return vec3(vec3_dot(f->x, v), vec3_dot(f->y, v), vec3_dot(f->z, v));
}

static inline Vec3 frame_world(const Frame *f, Vec3 v)
{
    return vec3_madd(vec3_madd(vec3_scale(f->x, v.x), v.y, f->y), v.z, f->z);
}

#endif
