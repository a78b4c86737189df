// Measures of geometry, for objects that have no others.
#ifndef RAMIFY_MESH_GEOMETRY_MEASURE_H
#define RAMIFY_MESH_GEOMETRY_MEASURE_H

#include "base/measures.h"
#include "mesh/geometry.h"

// Box around the parts from number first on, instances and all; empty when there are none.
Aabb geometry_bounds(const Geometry *geometry, int64_t first);

// Adds parts, triangles and curve segments (stored once), instances, materials, and the extents of
// the box around everything, instances and the thickness of curves included.
bool geometry_measure(const Geometry *geometry, MeasureList *list, Error *e);

#endif
