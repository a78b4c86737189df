// The blade of a leaf with its relief.
#ifndef RAMIFY_OBJECTS_VENATION_BLADE_H
#define RAMIFY_OBJECTS_VENATION_BLADE_H

#include "base/mesh.h"
#include "objects/venation/blade_wear.h"
#include "objects/venation/venation.h"

// Heights of the flat blade, row by row from the tip; every row fills the blade's width.
typedef struct Relief {
    const VenationParams *params; // borrowed
    int width, height;
    float *depth; // 0 between veins .. 1 in the middle of the midrib; NULL = flat
    float *pale;  // 0 = as green as the greenest areole .. 1 = a vein in the blade; NULL = none lie
                  // in it
    float *withered; // see Mesh.withered; NULL = nowhere
    BladeWear wear;
} Relief;

// Paints the relief of the veins; flat without params->relief, plain without params->embedded and
// whole without params->wear and spots. Clear it after a failure, too.
bool relief_init(Relief *relief, const VenationParams *params, const OutTree *tree, Error *e);
void relief_clear(Relief *relief);

// Height of the flat blade at p with its waves, m; 0 below it.
float relief_at(const Relief *relief, Vec3 p);

// The bent blade at its place, with uv, as fine as the relief; young where veins lie in it,
// withered where wear has left its traces, and without what is eaten.
Mesh *venation_blade(const VenationParams *params, const Relief *relief, const Transform *place,
                     Error *e);

#endif
