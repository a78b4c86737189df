// The part of shape/import.h that runs in a child process: Assimp, and conversion to one mesh.
#ifndef RAMIFY_SHAPE_IMPORT_READ_H
#define RAMIFY_SHAPE_IMPORT_READ_H

#include "base/child.h"
#include "base/mesh.h"

// Header of the child's result, followed by index, position, normal and uv, as far as present.
typedef struct ImportHeader {
    int64_t vertex_count, face_count; // triangles
    int32_t normals, uvs;             // 0 or 1: given for every vertex
} ImportHeader;

#define IMPORT_WANTED "a whole OBJ, PLY, STL, glTF, GLB or VDB file"
#define IMPORT_NO_TRIANGLES \
    "the file holds no triangles; a surface of triangles or polygons is needed"

typedef struct ImportJob {
    const char *file;
    const struct VdbReaders *vdb; // for a .vdb file; otherwise NULL
} ImportJob;

// A ChildTask; data: an ImportJob.
ChildTask import_read;

#endif
