// The nearest point of a triangle.
#ifndef RAMIFY_BASE_TRIANGLE_H
#define RAMIFY_BASE_TRIANGLE_H

#include "base/vec.h"

// Point of the triangle a, b, c (edges and inside) nearest to p (Ericson 2005, section 5.1.5).
Vec3 triangle_nearest(Vec3 a, Vec3 b, Vec3 c, Vec3 p);

#endif
