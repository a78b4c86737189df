// Maps of a height field: one value per sample, for materials, scattering and other programs.
#ifndef RAMIFY_LAND_HEIGHT_MAPS_H
#define RAMIFY_LAND_HEIGHT_MAPS_H

#include "land/height_field.h"

// The names of all maps, space-separated:
// slope           degrees, over eight neighbours (Horn 1981)
// aspect          degrees, toward which the land falls: 0 = north (-z), 90 = east (+x); -1 = level
// curvature       1/m, the Laplacian: positive in hollows, negative on ridges
// flow            m^2, the catchment of each sample (height_drainage.h)
// wetness         ln(catchment per width of contour / tan slope) (Beven and Kirkby 1979)
// river-distance  m to the nearest river, as height_field_measure finds them
#define HEIGHT_MAP_NAMES "slope aspect curvature flow wetness river-distance"

// A field of the same samples whose heights are the map's values; missing where the land is. The
// caller frees it. ERROR_INPUT for another name.
HeightField *height_map(const HeightField *field, const char *name, Error *e);

#endif
