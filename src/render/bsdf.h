// BSDFs: a material evaluated at a surface point gives one Bsdf, a small value on the stack that
// can be sampled and evaluated. Directions are world-space unit vectors pointing away from the
// surface: wo to where light goes (toward the eye), wi to where it comes from.
#ifndef RAMIFY_RENDER_BSDF_H
#define RAMIFY_RENDER_BSDF_H

#include "render/material.h"
#include "render/surface.h"

// Per-material tables (energy compensation) and textures, made once per world.
typedef struct MaterialSet MaterialSet;

MaterialSet *material_set_new(const Material *materials, int count, Error *e);
void material_set_free(MaterialSet *set); // NULL is fine

typedef struct Bsdf {
    MaterialKind kind;
    Vec3 normal; // shading normal after bumps, on wo's side
    Vec3 tangent, bitangent;
    Vec3 geometric_normal;
    Vec3 color; // diffuse albedo or specular tint
    Vec3 transmittance;
    Vec3 emission; // radiance toward wo
    Vec3 specular; // f0
    Vec3 absorption;
    float alpha;     // GGX
    float roughness; // of the diffuse lobe
    float eta;       // index on the far side over that on wo's side
    float diffuse_weight;
    float specular_probability;
    Vec3 albedo; // for the albedo AOV and for choosing lobes
} Bsdf;

typedef struct BsdfSample {
    Vec3 wi;
    Vec3 weight; // f |cos| / pdf; for a delta lobe f |cos| / probability
    float pdf;   // solid angle; 0 for a delta lobe
    bool delta, transmitted;
} BsdfSample;

// Evaluates patterns and textures of set's material point->material; wo as above.
Bsdf bsdf_at(const MaterialSet *set, const SurfacePoint *point, Vec3 wo);

// Draws wi from three uniform numbers. False when absorbed.
bool bsdf_sample(const Bsdf *bsdf, Vec3 wo, const float u[3], BsdfSample *sample);

// f(wo, wi) |cos wi| and the density that bsdf_sample would have drawn wi with (0 where only delta
// lobes).
Vec3 bsdf_eval(const Bsdf *bsdf, Vec3 wo, Vec3 wi, float *pdf);

// Opacity 0..1 at a hit, for alpha-textured leaves; 1 without an alpha texture.
float material_opacity(const MaterialSet *set, int material, Vec2 uv);
static inline bool bsdf_is_emissive(const Bsdf *bsdf)
{
    return bsdf->emission.x + bsdf->emission.y + bsdf->emission.z > 0.0f;
}

#endif
