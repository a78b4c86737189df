// The fine hairs that fringe the margin of a young blade, as beech's.
#ifndef RAMIFY_OBJECTS_VENATION_MARGIN_HAIRS_H
#define RAMIFY_OBJECTS_VENATION_MARGIN_HAIRS_H

#include "mesh/curves.h"
#include "objects/venation/blade.h"

// Round hairs of about params->hairs (m) along both sides of the blade, away from it and toward its
// tip, each bent by chance; none where insects have eaten the margin. place: from the bent leaf to
// the scene. The caller frees the curves.
CurveSet *margin_hairs(const VenationParams *params, const Relief *relief, const Transform *place,
                       Error *e);

#endif
