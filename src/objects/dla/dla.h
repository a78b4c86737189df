// Diffusion-limited aggregates as electrodeposited metal: the cluster of grow/aggregate/dla.h,
// thicker where more of it hangs on a branch.
#ifndef RAMIFY_OBJECTS_DLA_DLA_H
#define RAMIFY_OBJECTS_DLA_DLA_H

#include "mesh/geometry.h"
#include "objects/common/recipe.h"
#include "outtree/out_tree.h"

typedef struct DlaModel {
    Vec3 position;     // m, of the first particle
    Vec3 rotation;     // degrees about x, y, z; a plane cluster lies in z = 0 before it
    float size;        // m, largest extent of the whole cluster
    int dimension;     // 2 or 3
    int64_t particles; // of the whole cluster
    float thickness;   // of the tips, particle diameters
    float exponent;    // pipe model: how fast branches thicken toward the middle; larger is slower
    float swell;       // particle diameters that a plane cluster heaves out of its plane
} DlaModel;

DlaModel dla_model_default(void); // 2D, 1 m, 40,000 particles

// The cluster with radii, at its place.
OutTree *dla_model_grow(const DlaModel *params, const Recipe *recipe, Error *e);

// Adds the cluster as one smooth closed surface.
bool dla_model_geometry(const OutTree *tree, int material, int object, Geometry *geometry,
                        const Run *run, Error *e);

#endif
