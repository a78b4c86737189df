// What a material's pattern makes of the vertices of a mesh or of the segments of curves: colours
// evaluated there, with what is finer than the mesh faded into its mean.
#ifndef RAMIFY_EXPORT_POV_SHADE_H
#define RAMIFY_EXPORT_POV_SHADE_H

#include "base/run.h"
#include "mesh/geometry.h"
#include "render/material/material.h"

// Colours of count places; owned.
typedef struct PovShades {
    Vec3 *color, *transmittance;
    Vec3 *normal; // bumped; NULL where the mesh has none or nothing bumps it
    int64_t count;
} PovShades;

void pov_shades_clear(PovShades *shades);

// Of each vertex. place: of the instance that stands for all; NULL = none.
bool pov_shade_mesh(const Material *material, const Mesh *mesh, const Transform *place,
                    float variation, const Run *run, PovShades *shades, Error *e);

// Of each segment, in the order of the points. An emitting material's is radiance times glow.
bool pov_shade_curves(const Material *material, const CurveSet *curves, PovShades *shades,
                      Error *e);

// Of each instance: the mean over the part's mesh.
bool pov_shade_instances(const Material *material, const Part *part, const Run *run,
                         PovShades *shades, Error *e);

#endif
