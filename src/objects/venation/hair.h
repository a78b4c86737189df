// A fine hair of a leaf, bent by chance.
#ifndef RAMIFY_OBJECTS_VENATION_HAIR_H
#define RAMIFY_OBJECTS_VENATION_HAIR_H

#include "mesh/curves.h"
#include "objects/venation/venation.h"

enum { HAIR_POINTS = 4 };

// A hair on the unbent leaf.
typedef struct Hair {
    Vec3 foot, out; // where it stands, and which way
    float lift;     // m: height of the relief there, by which all of it is raised
    float length;   // m, the mean
    uint64_t key;
} Hair;

// Adds the hair, bent with the leaf, as the next curve of hairs, which counts its curves in
// curve_count and has room for it. place: from the bent leaf to the scene.
void hair_add(CurveSet *hairs, const VenationParams *params, const Transform *place,
              const Hair *hair);

#endif
