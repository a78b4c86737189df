// Taking a mesh apart into its connected pieces.
#ifndef RAMIFY_MESH_PIECES_H
#define RAMIFY_MESH_PIECES_H

#include "base/mesh.h"

typedef struct MeshPieces {
    Mesh **piece; // owned, as the pieces are; in order of their first vertex
    int64_t count;
} MeshPieces;

// The pieces that share no vertex, with the positions and normals of the mesh.
bool mesh_split(const Mesh *mesh, MeshPieces *pieces, Error *e);
void mesh_pieces_clear(MeshPieces *pieces);

#endif
