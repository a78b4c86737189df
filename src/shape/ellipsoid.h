// Ellipsoids about the origin with half-axes along x, y and z.
#ifndef RAMIFY_SHAPE_ELLIPSOID_H
#define RAMIFY_SHAPE_ELLIPSOID_H

#include <stdbool.h>

// c = the point of the surface nearest to p; true when p is inside. (Eberly, "Distance from a Point
// to an Ellipse, an Ellipsoid, or a Hyperellipsoid", 2013, with Newton's method.)
bool ellipsoid_nearest(const double half[3], const double p[3], double c[3]);

bool ellipsoid_contains(const double half[3], const double p[3]);

// Surface area, by Carlson's symmetric integrals: S = 4 pi abc R_G(a^-2, b^-2, c^-2)
// (DLMF 19.33.1).
double ellipsoid_area(const double half[3]);

#endif
