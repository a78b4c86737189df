// Closes open surfaces, and measures closed ones.
#ifndef RAMIFY_SHAPE_MESH_CLOSE_H
#define RAMIFY_SHAPE_MESH_CLOSE_H

#include "base/mesh.h"

// Copies the mesh with vertices at equal positions joined and every hole filled by a fan about its
// centroid, which is right for flat and small holes and a guess for others. *open_edges is set to
// the number of edges with one face. Positions and faces only; the caller frees it with mesh_free.
Mesh *mesh_close(const Mesh *mesh, int64_t *open_edges, Error *e);

// Volume, m^3, by the divergence theorem; negative when the faces of the closed mesh look inward.
double mesh_signed_volume(const Mesh *mesh);

double mesh_area(const Mesh *mesh); // m^2

// Reverses faces and normals.
void mesh_flip(Mesh *mesh);

#endif
