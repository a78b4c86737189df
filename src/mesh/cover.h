// Tests which points lie below an upward-facing surface, such as land under water, and finds what
// lies on top.
#ifndef RAMIFY_MESH_COVER_H
#define RAMIFY_MESH_COVER_H

#include "base/mesh.h"

typedef struct Cover Cover;

// Creates an empty cover; cover_add copies a mesh's triangles (quads as two).
Cover *cover_new(Error *e);
bool cover_add(Cover *cover, const Mesh *mesh, Error *e);
void cover_free(Cover *cover); // NULL is fine

// Builds the grid; called once, after the last mesh and before any cover_hides and
// cover_top.
bool cover_finish(Cover *cover, Error *e);

// Whether the nearest surface vertically above p faces up: p is inside a body or under an open
// sheet. A body floating above p shows its lower side and hides nothing.
bool cover_hides(const Cover *cover, Vec3 p);

// The highest triangle at a place in plan: its height there and its unit normal, turned upwards.
// Edges that triangles share have no gaps. False: there is none.
bool cover_top(const Cover *cover, float x, float z, float *height, Vec3 *normal);

#endif
