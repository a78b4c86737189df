// A GGX lobe over diffuse reflection and transmission: what conductor, principled and leaf are made
// of. A kind's prepare fills color, transmittance, specular and grazing of the Bsdf by way of
// these and ends with layered_finish. Every part is reciprocal, and white layers reflect exactly
// what comes.
#ifndef RAMIFY_RENDER_MATERIAL_LAYERED_H
#define RAMIFY_RENDER_MATERIAL_LAYERED_H

#include "render/material/material_ops.h"

// A dielectric coat of this strength (Material.specular), times `weight`; fills specular, grazing
// and what the coat leaves to the layers below.
void layered_add_coat(Bsdf *bsdf, float specular, float weight, float cos_o);

// The metallic part of the glossy lobe, `weight` of it: what scattering between facets gives back.
void layered_add_metal(Bsdf *bsdf, Vec3 color, float weight, float cos_o);

// All of principled: a coat over diffuse reflection, or metal, or a mixture.
void layered_prepare(Bsdf *bsdf, float specular, float metallic, float cos_o);

// Chooses the probabilities of drawing each lobe. Last.
void layered_finish(Bsdf *bsdf, float cos_o);

bool layered_draw(const Bsdf *bsdf, Vec3 wo, const float u[3], Vec3 *wi);
Vec3 layered_eval(const Bsdf *bsdf, Vec3 wo, Vec3 wi, float *pdf);
bool layered_tabulate(MaterialEntry *entry, MaterialSet *set, Error *e);

#endif
