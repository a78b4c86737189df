// Cross profiles of valleys, as geomorphologists compare them: the height over the river is
// a |x|^b on each side, with b near 1 for the V that rivers cut and near 2 for the U of glaciers
// (Svensson 1959; Graf 1970).
#ifndef RAMIFY_LAND_VALLEY_PROFILE_H
#define RAMIFY_LAND_VALLEY_PROFILE_H

#include "land/height_drainage.h"

// The median of b over the profiles at right angles to rivers, those samples with a catchment of at
// least least_area (m^2), whose side rises by a sixth of the field's relief. NAN if there are none.
bool valley_profile_exponent(const HeightField *field, const Drainage *drainage, double least_area,
                             double *exponent, Error *e);

#endif
