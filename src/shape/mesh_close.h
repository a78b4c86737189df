// Making a closed surface of an open one, and measures of closed surfaces.
#ifndef RAMIFY_SHAPE_MESH_CLOSE_H
#define RAMIFY_SHAPE_MESH_CLOSE_H

#include "base/mesh.h"

// The same triangles over vertices of which no two are at one place, with every hole filled by
// triangles about its middle: good for flat and small holes, a guess for others. *open_edges =
// edges of the mesh that one face uses. Positions and faces only; the caller frees it with
// mesh_free.
Mesh *mesh_close(const Mesh *mesh, int64_t *open_edges, Error *e);

// m^3, negative when the faces of the closed mesh look inward (divergence theorem).
double mesh_signed_volume(const Mesh *mesh);

double mesh_area(const Mesh *mesh); // m^2

// Turns faces and normals round.
void mesh_flip(Mesh *mesh);

#endif
