// Ellipsoids centred at the origin with half-axes along x, y and z.
#ifndef RAMIFY_SHAPE_ELLIPSOID_H
#define RAMIFY_SHAPE_ELLIPSOID_H

#include <stdbool.h>

// Sets c to the surface point nearest to p; returns true when p is inside. Newton's method of
// Eberly 2013.
bool ellipsoid_nearest(const double half[3], const double p[3], double c[3]);

bool ellipsoid_contains(const double half[3], const double p[3]);

// Surface area by Carlson's symmetric integrals (Carlson 1995): S = 4 pi abc R_G(a^-2, b^-2, c^-2)
// (DLMF 19.33.1).
double ellipsoid_area(const double half[3]);

#endif
