// The point of a mesh nearest to another point.
#ifndef RAMIFY_SHAPE_MESH_NEAREST_H
#define RAMIFY_SHAPE_MESH_NEAREST_H

#include "base/mesh.h"

// Moves p to the nearest point of the mesh's faces (Ericson 2005, section 5.1.5) and sets the unit
// normal there: that of the face. Visits every face. False if the mesh has none.
bool mesh_nearest(const Mesh *mesh, Vec3 *p, Vec3 *normal);

#endif
