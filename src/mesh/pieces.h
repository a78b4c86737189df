// Splits a mesh into its connected components.
#ifndef RAMIFY_MESH_PIECES_H
#define RAMIFY_MESH_PIECES_H

#include "base/mesh.h"

typedef struct MeshPieces {
    Mesh **piece; // owned, with the meshes; ordered by first vertex
    int64_t count;
} MeshPieces;

// Splits into components that share no vertex, with the mesh's positions and normals.
bool mesh_split(const Mesh *mesh, MeshPieces *pieces, Error *e);
void mesh_pieces_clear(MeshPieces *pieces);

#endif
