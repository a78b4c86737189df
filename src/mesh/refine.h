// Refines a quad cage to its Catmull-Clark limit surface, with a level per face. The cage is
// processed in patches, so memory beyond the result stays small, and every vertex is computed once,
// by the finest face it lies on, so there are no cracks.
#ifndef RAMIFY_MESH_REFINE_H
#define RAMIFY_MESH_REFINE_H

#include "base/mesh.h"
#include "base/run.h"

// face_level: number of times each cage face is halved, 1..6. Equal levels give quads. Different
// levels give triangles, those between fine and coarse faces sharing the fine side's vertices. The
// cage may have borders; every edge must have at most two faces. The caller frees the mesh with
// mesh_free.
Mesh *mesh_refine(const Mesh *cage, const uint8_t *face_level, const Run *run, Error *e);

#endif
