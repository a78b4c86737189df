// Diffusion-limited aggregates as electrodeposited metal: the cluster of grow/aggregate/dla.h,
// branches are thicker the more particles they carry.
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
    float exponent;    // pipe model: larger = branches thicken more slowly toward the middle
    float swell;       // amplitude of a plane cluster's relief, particle diameters
} DlaModel;

DlaModel dla_model_default(void); // 2D, 1 m, 40,000 particles

// The recipe (see recipe.h). The geometry is one smooth closed surface of the one material.
bool dla_model_grow(const void *params, const Recipe *recipe, Grown *whole, Error *e);
bool dla_model_finish(const void *params, const Recipe *recipe, const Grown *whole, Grown *grown,
                      Error *e);
bool dla_model_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e);

extern const struct Table dla_table; // of its parameters

#endif
