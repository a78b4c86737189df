// Tests which points lie below an upward-facing surface, such as land under water.
#ifndef RAMIFY_MESH_COVER_H
#define RAMIFY_MESH_COVER_H

#include "base/mesh.h"

typedef struct Cover Cover;

// Creates an empty cover; cover_add copies a mesh's triangles (quads as two).
Cover *cover_new(Error *e);
bool cover_add(Cover *cover, const Mesh *mesh, Error *e);
void cover_free(Cover *cover); // NULL is fine

// Builds the grid; called once, after the last mesh and before any cover_hides.
bool cover_finish(Cover *cover, Error *e);

// Whether the nearest surface vertically above p faces up: p is inside a body or under an open
// sheet. A body floating above p shows its lower side and hides nothing.
bool cover_hides(const Cover *cover, Vec3 p);

#endif
