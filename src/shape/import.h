// Reading other programs' meshes through Assimp: OBJ, PLY, STL, glTF, GLB.
#ifndef RAMIFY_SHAPE_IMPORT_H
#define RAMIFY_SHAPE_IMPORT_H

#include "base/mesh.h"

// All triangles of the file as one mesh, node transforms applied, identical vertices joined,
// degenerate faces dropped; normals and UVs where the file has them for every vertex. ERROR_INPUT
// names the file and what is wrong (missing, unreadable, truncated, no triangles, non-finite or
// absurd coordinates).
Mesh *mesh_import(const char *file, Error *e);

#endif
