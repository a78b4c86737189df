// The hairs on the thick veins of a leaf's underside, as of hazel, hornbeam and lime.
#ifndef RAMIFY_OBJECTS_VENATION_VEIN_HAIRS_H
#define RAMIFY_OBJECTS_VENATION_VEIN_HAIRS_H

#include "mesh/curves.h"
#include "objects/venation/blade.h"

// Round hairs of about params->vein_hairs (m) on the veins that stand out of the blade, on its
// front and to the sides, leaning toward the veins' ends; none where insects have eaten. place:
// from the bent leaf to the scene. The caller frees the curves.
CurveSet *vein_hairs(const OutTree *tree, const VenationParams *params, const Relief *relief,
                     const Transform *place, Error *e);

#endif
