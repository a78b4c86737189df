// Reading other programs' meshes through Assimp: OBJ, PLY, STL, glTF, GLB.
#ifndef RAMIFY_SHAPE_IMPORT_H
#define RAMIFY_SHAPE_IMPORT_H

#include "base/child.h"
#include "base/mesh.h"

// All triangles of the file as one mesh, node transforms applied, identical vertices joined,
// degenerate faces dropped; normals and UVs where the file has them for every vertex. ERROR_INPUT
// names the file and what is wrong (missing, unreadable, truncated, no triangles, non-finite or
// absurd coordinates, the reader crashed on it or wanted too much).
//
// The file is read in a child process (base/child.h), which may take 60 s and 5 s more for each MB
// of it, and 2 GB and 200 MB more for each MB. Only files in the mesh's own folder or below are
// opened.
Mesh *mesh_import(const char *file, const Run *run, Error *e);

// The same with another reader, which hands back what import_read does (shape/import_read.h).
Mesh *mesh_import_by(ChildTask *reader, const char *file, const Run *run, Error *e);

#endif
