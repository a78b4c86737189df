// Detail that follows the size on the screen: coarse leaves and grass, tubes for thin curves.
#ifndef RAMIFY_RENDER_ACCEL_ACCEL_DETAIL_H
#define RAMIFY_RENDER_ACCEL_ACCEL_DETAIL_H

#include "mesh/geometry.h"
#include "render/camera.h"

// Index of the coarsest form of the part whose error is invisible at the instance: 0 = the part's
// mesh, i = coarse[i - 1]. reach: radius of the part's mesh about its origin, m.
int detail_level(const Part *part, int64_t instance, float reach, const Views *views);

// Radius of the mesh about its origin.
float detail_reach(const Mesh *mesh);

// Are the curves of the part thinner than a few pixels wherever they are?
bool detail_is_thin(const Part *part, const Views *views);

#endif
