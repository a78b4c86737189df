// An imported mesh, drawn unchanged, with hoar frost on it if that is asked for.
#ifndef RAMIFY_OBJECTS_MESH_MESH_H
#define RAMIFY_OBJECTS_MESH_MESH_H

#include "base/vec.h"
#include "objects/common/hoar.h"

typedef struct MeshParams {
    char *file;
    Vec3 position, rotation, scale; // scale, then rotation (degrees), then translation
    float bend_front, bend_back;    // degrees: see bend.h; before all of those
    bool smooth;                    // compute smooth normals if the file has none
    HoarParams hoar;
} MeshParams;

enum { MESH_OWN, MESH_RIME }; // roles of materials

extern const struct Table mesh_table; // of its parameters

#endif
