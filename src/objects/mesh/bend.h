// Bends an imported mesh sideways, as a fish or a lizard bends.
#ifndef RAMIFY_OBJECTS_MESH_BEND_H
#define RAMIFY_OBJECTS_MESH_BEND_H

#include "base/mesh.h"

// The x axis of the mesh becomes a curve in its plane y = 0 that keeps its length: an arc from the
// middle of the box to either end, which is there turned by these degrees, toward +z if they are
// positive: `front` at the end at the high x, `back` at the low one. What lies beside the axis
// turns with it; normals, too. Zero for both leaves every bit.
void mesh_bend(Mesh *mesh, float front, float back);

#endif
