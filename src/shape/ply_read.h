// Reads the common kind of PLY file by blocks: little-endian vertices, then triangles and quads.
#ifndef RAMIFY_SHAPE_PLY_READ_H
#define RAMIFY_SHAPE_PLY_READ_H

#include "base/mesh.h"

// A triangle mesh with the file's normals and texture coordinates, without degenerate faces,
// unused vertices and vertices that equal another in all their attributes. NULL and e, or NULL and
// *declined if the file is of another kind, which a general reader must read. The file was checked
// by import_check.
Mesh *ply_read(const char *file, bool *declined, Error *e);

#endif
