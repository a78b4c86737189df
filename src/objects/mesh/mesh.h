// An imported mesh that is drawn as it is.
#ifndef RAMIFY_OBJECTS_MESH_MESH_H
#define RAMIFY_OBJECTS_MESH_MESH_H

#include "base/vec.h"

typedef struct MeshParams {
    char *file;
    Vec3 position, rotation, scale; // scaled, then turned (degrees), then moved
    bool smooth;                    // make smooth normals when the file has none
} MeshParams;

extern const struct Table mesh_table; // of its parameters

#endif
