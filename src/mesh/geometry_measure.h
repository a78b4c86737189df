// Measures of geometry, for objects without measures of their own.
#ifndef RAMIFY_MESH_GEOMETRY_MEASURE_H
#define RAMIFY_MESH_GEOMETRY_MEASURE_H

#include "base/measures.h"
#include "mesh/geometry.h"

// Bounding box of the mesh or curves of a part, in their own space; empty without any.
Aabb part_bounds(const Part *part);

// Bounding box of the parts from number first on, with instances; empty when there are none.
Aabb geometry_bounds(const Geometry *geometry, int64_t first);

// Appends parts, triangles and curve segments (each counted once), instances, materials, and the
// extents of the bounding box, including instances and the thickness of curves.
bool geometry_measure(const Geometry *geometry, MeasureList *list, Error *e);

#endif
