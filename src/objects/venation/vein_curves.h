// The veins of a leaf as round curves.
#ifndef RAMIFY_OBJECTS_VENATION_VEIN_CURVES_H
#define RAMIFY_OBJECTS_VENATION_VEIN_CURVES_H

#include "mesh/curves.h"
#include "objects/venation/blade.h"

// Bends the flat leaf: folds the halves up about the midrib, bends the length back, leaves the
// stalk straight.
Vec3 venation_bend(const VenationParams *params, Vec3 p);

// Positions of the nodes after that many passes of smoothing, which the caller frees; NULL and e
// when out of memory.
Vec3 *venation_smoothed(const OutTree *tree, int passes, Error *e);

// Every vein segment that is not embedded as a separate round curve; their round ends overlap.
// place: from the bent leaf to the scene. Veins lie in the relief. Smoothing moves no tip, root or
// place where veins join, so loops stay closed. The caller frees the curves.
CurveSet *venation_curves(const OutTree *tree, const VenationParams *params, const Relief *relief,
                          const Transform *place, Error *e);

#endif
