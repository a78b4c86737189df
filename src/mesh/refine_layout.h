// Numbers the vertices and faces of a refined cage: cage vertices first, then points on edges, then
// points inside faces. A face halved `level` times has a grid of 2^level + 1 points per side; an
// edge has as many as the finer of its faces.
#ifndef RAMIFY_MESH_REFINE_LAYOUT_H
#define RAMIFY_MESH_REFINE_LAYOUT_H

#include "base/mesh.h"

typedef struct RefineLayout {
    const Mesh *cage;
    const uint8_t *face_level;
    int64_t *ring_first;  // per cage vertex + 1: index of its first face in ring_face
    uint32_t *ring_face;  // cage faces around each vertex, ascending
    uint32_t *face_edge;  // per face and side k (corner k to k + 1): the edge's index
    uint32_t *edge_owner; // per edge: the face that computes its points
    uint32_t *vertex_owner;
    int64_t *edge_first; // per edge: index of its first inner point, counted from its lower vertex
    int64_t *face_first; // per face: index of its first inner point
    uint32_t *order;     // faces sorted by level, stable
    int64_t edge_count;
    bool graded;                      // levels differ: the result has triangles
    int64_t vertex_count, face_count; // of the result
} RefineLayout;

bool refine_layout_init(RefineLayout *layout, const Mesh *cage, const uint8_t *face_level,
                        Error *e); // clear it after a failure, too
void refine_layout_clear(RefineLayout *layout);

// Index of point (x, y) of a face's grid if that face owns it, else -1.
int64_t refine_layout_owned(const RefineLayout *layout, uint32_t face, int x, int y);

// Writes the vertex indices of all faces of the result.
void refine_layout_faces(const RefineLayout *layout, uint32_t *index);

#endif
