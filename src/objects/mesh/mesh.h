// An imported mesh, drawn unchanged.
#ifndef RAMIFY_OBJECTS_MESH_MESH_H
#define RAMIFY_OBJECTS_MESH_MESH_H

#include "base/vec.h"

typedef struct MeshParams {
    char *file;
    Vec3 position, rotation, scale; // scale, then rotation (degrees), then translation
    bool smooth;                    // compute smooth normals if the file has none
} MeshParams;

extern const struct Table mesh_table; // of its parameters

#endif
