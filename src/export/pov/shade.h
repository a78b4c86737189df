// Colours of a material's pattern at the vertices of a mesh or at the segments of curves; details
// finer than the mesh fade into their mean.
#ifndef RAMIFY_EXPORT_POV_SHADE_H
#define RAMIFY_EXPORT_POV_SHADE_H

#include "base/run.h"
#include "mesh/geometry.h"
#include "render/material/material.h"

// Colours of count places; owned.
typedef struct PovShades {
    Vec3 *color, *transmittance;
    Vec3 *normal; // bumped; NULL if the mesh has no normals or the material no bumps
    int64_t count;
} PovShades;

void pov_shades_clear(PovShades *shades);

// Shades each vertex. place: transform of the instance that stands for all; NULL = none.
bool pov_shade_mesh(const Material *material, const Mesh *mesh, const Transform *place,
                    InstanceLook look, const Run *run, PovShades *shades, Error *e);

// Shades each segment, in the order of the points; radiance times glow if the material emits.
bool pov_shade_curves(const Material *material, const CurveSet *curves, PovShades *shades,
                      Error *e);

// Shades each instance with the mean over the part's mesh.
bool pov_shade_instances(const Material *material, const Part *part, const Run *run,
                         PovShades *shades, Error *e);

#endif
