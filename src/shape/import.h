// Imports meshes through Assimp (OBJ, PLY, STL, glTF, GLB) and surfaces of OpenVDB grids (VDB).
#ifndef RAMIFY_SHAPE_IMPORT_H
#define RAMIFY_SHAPE_IMPORT_H

#include "base/child.h"
#include "base/mesh.h"

// Reads all triangles of the file into one mesh: node transforms applied, identical vertices
// joined, degenerate faces dropped; normals and UVs if the file has them for every vertex.
// ERROR_INPUT names the file and the fault (missing, unreadable, truncated, no triangles,
// non-finite or out-of-range coordinates, the reader crashed or exceeded its limits).
//
// The file is read in a child process (base/child.h), limited to 60 s plus 5 s per MB of the file,
// and to 2 GB plus 200 MB per MB. Only files in the mesh's folder or below it are opened. The
// caller frees the mesh with mesh_free.
Mesh *mesh_import(const char *file, const Run *run, Error *e);

// The same with another reader that returns its result as import_read does (shape/import_read.h).
Mesh *mesh_import_by(ChildTask *reader, const char *file, const Run *run, Error *e);

#endif
