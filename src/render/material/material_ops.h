// What a kind of material defines. Private to render/material.
//
// Lobes are defined about the shading normal; bsdf.c folds them over the geometric horizon. Every
// eval returns f |cos wi|; every draw gives a unit direction distributed as the pdf of the eval
// beside it, or false where the light is absorbed.
#ifndef RAMIFY_RENDER_MATERIAL_MATERIAL_OPS_H
#define RAMIFY_RENDER_MATERIAL_MATERIAL_OPS_H

#include "render/material/appearance.h"
#include "render/material/material_set.h"

// NULL: nothing to do; of eval, draw and sample_delta: no such lobes.
typedef struct MaterialOps {
    unsigned traits;

    // What differs from the defaults of all kinds.
    void (*defaults)(Material *material);
    // What differs from the appearance of a matt surface of the material's colour.
    void (*describe)(const Material *material, Appearance *appearance);
    // Fills the entry's tables, once per world.
    bool (*tabulate)(MaterialEntry *entry, MaterialSet *set, Error *e);

    // Replaces normal and roughness by what the surface seen from wo shows of itself.
    void (*shade)(Bsdf *bsdf, const MaterialEntry *entry, const SurfacePoint *point, Vec3 wo);
    // Completes a Bsdf that has its normals, colours, alpha and table. cos_o: of the shading normal
    // and wo.
    void (*prepare)(Bsdf *bsdf, const MaterialEntry *entry, const SurfacePoint *point, float cos_o);
    // The smooth lobes.
    Vec3 (*eval)(const Bsdf *bsdf, Vec3 wo, Vec3 wi, float *pdf);
    bool (*draw)(const Bsdf *bsdf, Vec3 wo, const float u[3], Vec3 *wi);
    // Fills wi, weight and transmitted where Bsdf.delta is set, which leaves no smooth lobes.
    bool (*sample_delta)(const Bsdf *bsdf, Vec3 wo, const float u[3], BsdfSample *sample);
    // TRAIT_THIN: see material_shadow_opacity.
    float (*shadow_opacity)(const Material *material, float cosine);
} MaterialOps;

#define KIND(NAME, name) extern const MaterialOps name##_ops;
MATERIAL_KINDS(KIND)
#undef KIND

// Begins a Bsdf: colours, roughness and normal of the entry's pattern and pictures at the point.
void bsdf_shade(const MaterialEntry *entry, const SurfacePoint *point, Bsdf *bsdf);

const MaterialOps *material_ops(MaterialKind kind);

#endif
