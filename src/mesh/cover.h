// Which places lie under a surface that looks up: land under water.
#ifndef RAMIFY_MESH_COVER_H
#define RAMIFY_MESH_COVER_H

#include "base/mesh.h"

typedef struct Cover Cover;

// An empty cover, then meshes: their triangles (quads as two) are copied.
Cover *cover_new(Error *e);
bool cover_add(Cover *cover, const Mesh *mesh, Error *e);
void cover_free(Cover *cover); // NULL is fine

// Sorts the triangles by place: once, after the last mesh and before any cover_hides.
bool cover_finish(Cover *cover, Error *e);

// Whether the nearest surface straight above p looks up: p lies in a body, or under an open sheet.
// A body that hangs in the air above p shows it its lower side, and hides nothing.
bool cover_hides(const Cover *cover, Vec3 p);

#endif
