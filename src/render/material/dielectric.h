// The lobes of a dielectric surface, for kinds that add to it. Private to render/material.
#ifndef RAMIFY_RENDER_MATERIAL_DIELECTRIC_H
#define RAMIFY_RENDER_MATERIAL_DIELECTRIC_H

#include "render/material/material_set.h"

// As of MaterialOps.
void dielectric_prepare(Bsdf *bsdf, const MaterialEntry *entry, const SurfacePoint *point,
                        float cos_o);
Vec3 dielectric_eval(const Bsdf *bsdf, Vec3 wo, Vec3 wi, float *pdf);
bool dielectric_draw(const Bsdf *bsdf, Vec3 wo, const float u[3], Vec3 *wi);
bool dielectric_sample_delta(const Bsdf *bsdf, Vec3 wo, const float u[3], BsdfSample *sample);

#endif
