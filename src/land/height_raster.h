// A mesh seen from above as a height field.
#ifndef RAMIFY_LAND_HEIGHT_RASTER_H
#define RAMIFY_LAND_HEIGHT_RASTER_H

#include "base/mesh.h"
#include "land/height_field.h"

// The highest point of the mesh above each of side * side samples over its bounds; missing (NAN)
// where there is none. The caller frees it with height_field_free.
HeightField *height_field_of_mesh(const Mesh *mesh, int side, Error *e);

#endif
