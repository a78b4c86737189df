// Rays through a mesh, with the same bits everywhere: for growth. Pictures are traced elsewhere.
#ifndef RAMIFY_MESH_MESH_RAYS_H
#define RAMIFY_MESH_MESH_RAYS_H

#include "base/mesh.h"

typedef struct MeshRays MeshRays;

// Borrows the mesh, which has less than 2^31 triangles; quads are two. NULL and e when out of
// memory.
MeshRays *mesh_rays_new(const Mesh *mesh, Error *e);
void mesh_rays_free(MeshRays *rays); // NULL is fine

// Way along the unit direction d to the nearest face, or, if `leaving`, to the nearest that is seen
// from its back; INFINITY = none within `most`.
float mesh_rays_way(const MeshRays *rays, Vec3 p, Vec3 d, bool leaving, float most);

#endif
