// A ball as a mesh: markers, lamps.
#ifndef RAMIFY_MESH_BALL_H
#define RAMIFY_MESH_BALL_H

#include "base/mesh.h"

// The closed unit sphere about the origin in `rings` rings (2 or more) of 2 * rings quads, those at
// the poles triangles: 4 * rings * (rings - 1) triangles in all, with normals.
Mesh *ball_mesh(int rings, Error *e);

#endif
