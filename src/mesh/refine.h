// Refinement of a quad cage to its Catmull-Clark limit surface, face by face as finely as asked.
// The cage is worked on in patches, so memory beyond the result stays small, and every vertex of
// the result is computed once, by the finest face it lies on: there are no cracks.
#ifndef RAMIFY_MESH_REFINE_H
#define RAMIFY_MESH_REFINE_H

#include "base/mesh.h"
#include "base/run.h"

// face_level: how often each cage face is halved, 1..6. All the same: the result is made of quads.
// Otherwise of triangles, those between fine and coarse faces sharing the fine side's vertices.
// The cage may have borders; every edge must have at most two faces.
Mesh *mesh_refine(const Mesh *cage, const uint8_t *face_level, const Run *run, Error *e);

#endif
