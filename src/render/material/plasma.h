// MATERIAL_PLASMA: a thin gas that glows within a closed mesh or round curves and hides nothing.
#ifndef RAMIFY_RENDER_MATERIAL_PLASMA_H
#define RAMIFY_RENDER_MATERIAL_PLASMA_H

#include "render/material/material.h"
#include "render/surface.h"

// Radiance that a ray of this unit direction gathers on its way through the body whose surface it
// met at the point; 0 where it leaves the body.
Vec3 plasma_radiance(const Material *material, const SurfacePoint *point, Vec3 direction);

#endif
