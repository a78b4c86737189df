// BSDFs: a material evaluated at a surface point gives one Bsdf, a small value on the stack that
// can be sampled and evaluated. Directions are world-space unit vectors away from the surface: wo
// toward the camera side of the path, wi toward the light.
//
// Lobes are defined about the shading normal and folded over the geometric horizon: a direction
// that would pass through an opaque surface is mirrored back to its side. So shading normals and
// bumps neither lose energy (black fringes) nor leak light.
//
// Transmission carries flux: the factor eta^2 of radiance inside a denser body is omitted, since it
// cancels between entering and leaving.
#ifndef RAMIFY_RENDER_MATERIAL_BSDF_H
#define RAMIFY_RENDER_MATERIAL_BSDF_H

#include "base/run.h"
#include "render/material/material.h"
#include "render/surface.h"

// Per-material tables (energy compensation) and textures, made once per world.
typedef struct MaterialSet MaterialSet;

// Copies the materials. used: which of them parts have; tables are made for those alone; NULL =
// all. ERROR_INPUT names the material and the file if a texture cannot be read.
MaterialSet *material_set_new(const Material *materials, const bool *used, int count,
                              const Run *run, Error *e);
// Layers lie where these masks tell (mask.h), whose parts are numbered as SurfacePoint.part;
// without them nowhere. Borrowed.
struct MaskSet;
void material_set_use_masks(MaterialSet *set, const struct MaskSet *masks);
void material_set_free(MaterialSet *set); // NULL is fine

struct GgxTable;

typedef struct Bsdf {
    const struct MaterialOps *ops;
    unsigned traits; // of the material: TRAIT_*
    bool lambert;    // Lambertian reflection alone
    bool delta;      // no smooth lobes
    Vec3 normal;     // shading normal after bumps, unit, on wo's side
    Vec3 geometric_normal;
    Vec3 color;         // diffuse reflectance; the tint of what passes a dielectric
    Vec3 transmittance; // diffuse; of a film: straight through
    Vec3 emission;      // radiance toward wo
    Vec3 absorption;    // per metre, of the body that wo's ray came through; 0 outside of bodies
    Vec3 albedo;        // for the albedo AOV, 0..1
    float roughness;    // the material's
    float alpha;        // GGX; 0 = mirror
    float eta;          // index on the far side over that on wo's side
    bool inside;        // wo is inside a dielectric body
    float favour;       // least chance of the reflection at a smooth dielectric; 0 at first
    float foam;         // on water: share of the pixel, of this reflectance
    Vec3 foam_color;    // of what it does not swallow
    Vec3 foam_normal;   // unit, on wo's side
    float foam_through; // share of that which leaves on the far side

    // The glossy lobe, and the energy that it leaves to the lobes below, looked up for wo.
    Vec3
        specular; // a film's reflectance; else Schlick's f0; zero and grazing zero = no glossy lobe
    float grazing;                // Schlick's f90
    Vec3 metal;                   // f0 of the metallic part of that lobe ...
    Vec3 multiple;                // ... and how much of what it loses between facets comes back
    float restore_o;              // see GgxTable
    float coat_f0, coat_f90;      // the dielectric coat over color and transmittance
    float coat_o;                 // share that passes the coat at wo, over its mean
    float probability;            // of drawing the glossy lobe; of a film: the mirrored ray
    float through;                // of the rest: probability of drawing transmission
    const struct GgxTable *table; // borrowed from the MaterialSet
} Bsdf;

typedef struct BsdfSample {
    Vec3 wi;
    Vec3 weight; // f |cos| / pdf; for a delta lobe f |cos| / probability
    float pdf;   // solid angle; 0 for a delta lobe
    bool delta, transmitted;
} BsdfSample;

// Evaluates patterns and textures of the material point->material. In place, because copying a Bsdf
// costs the path tracer 2 % of its time.
void bsdf_fill(const MaterialSet *set, const SurfacePoint *point, Vec3 wo, Bsdf *bsdf);

static inline Bsdf bsdf_at(const MaterialSet *set, const SurfacePoint *point, Vec3 wo)
{
    Bsdf bsdf;
    bsdf_fill(set, point, wo, &bsdf);
    return bsdf;
}

// Draws wi from three uniform numbers. False when absorbed.
bool bsdf_sample(const Bsdf *bsdf, Vec3 wo, const float u[3], BsdfSample *sample);

// Returns f(wo, wi) |cos wi|; *pdf: the density with which bsdf_sample would draw wi. Both are 0
// for delta lobes.
Vec3 bsdf_eval(const Bsdf *bsdf, Vec3 wo, Vec3 wi, float *pdf);

// Opacity 0..1 at uv by the alpha texture; 1 without one.
float material_opacity(const MaterialSet *set, int material, Vec2 uv);
static inline bool bsdf_is_emissive(const Bsdf *bsdf)
{
    return bsdf->emission.x + bsdf->emission.y + bsdf->emission.z > 0.0f;
}

#endif
