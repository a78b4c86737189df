// What a summer leaves on a blade: holes and bites of insects with dead rims, dead spots, and
// patches that turn yellow.
#ifndef RAMIFY_OBJECTS_VENATION_BLADE_WEAR_H
#define RAMIFY_OBJECTS_VENATION_BLADE_WEAR_H

#include "base/mesh.h"
#include "objects/venation/venation.h"

// A hole or a dead spot: round but for a bumpy rim, on the flat leaf.
typedef struct WornPlace {
    Vec3 center;
    float radius; // m, the mean
    float rim;    // m, width of the dead rim of a hole, of the yellow halo of a spot
    uint32_t seed;
} WornPlace;

typedef struct BladeWear {
    const VenationParams *params; // borrowed
    WornPlace *hole, *spot;       // owned
    int holes, spots;
} BladeWear;

// Places holes and bites by params->wear, clear of the thick veins, which insects leave, and spots
// by params->spots. Clear it after a failure, too.
bool blade_wear_init(BladeWear *wear, const VenationParams *params, const OutTree *tree, Error *e);
void blade_wear_clear(BladeWear *wear);

// How far (m) p lies within a hole; 0 where the blade is whole.
float blade_wear_depth(const BladeWear *wear, Vec3 p);

// Adds holes' rims, spots and yellow patches to a picture of Mesh.withered, width x height pixels
// as blade_pixel places them.
void blade_wear_paint(const BladeWear *wear, int width, int height, float *withered);

// Removes the faces of a flat blade that lie within holes, moves corners of others out to the rim,
// and drops vertices that no face uses.
bool blade_wear_cut(const BladeWear *wear, Mesh *flat, Error *e);

#endif
