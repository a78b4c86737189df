// How a blade turns in autumn: chlorophyll goes areole by areole, last along the thick veins, and
// the margin dies first.
#ifndef RAMIFY_OBJECTS_VENATION_BLADE_AUTUMN_H
#define RAMIFY_OBJECTS_VENATION_BLADE_AUTUMN_H

#include "objects/venation/venation.h"

// Fills a picture of Mesh.withered, width x height pixels as blade_pixel places them, by
// params->autumn. pale: the picture of lines and areoles (see Relief.pale), by whose areoles the
// turn goes; NULL = evenly.
bool blade_autumn_paint(const VenationParams *params, const OutTree *tree, const float *pale,
                        int width, int height, float *withered, Error *e);

#endif
