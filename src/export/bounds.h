// Boxes about parts of the geometry; empty where there is nothing.
#ifndef RAMIFY_EXPORT_BOUNDS_H
#define RAMIFY_EXPORT_BOUNDS_H

#include "mesh/geometry.h"

Aabb part_shape_bounds(const Part *part); // of its mesh or curves, in their own space
Aabb part_bounds(const Part *part);       // of all its instances
Aabb geometry_bounds(const Geometry *geometry);

#endif
