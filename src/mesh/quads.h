// A mesh of quads that grows vertex by vertex, for leaves and other organs of plants.
#ifndef RAMIFY_MESH_QUADS_H
#define RAMIFY_MESH_QUADS_H

#include "base/mesh.h"

// Initialize to {.e = e}. After a failure the functions do nothing and quads_mesh returns NULL.
typedef struct Quads {
    Vec3 *position;
    Vec2 *uv;
    uint32_t *index; // 4 a face
    int64_t vertex_count, position_capacity, uv_capacity;
    int64_t face_count, index_capacity;
    const Transform *place; // of the vertices that are added; NULL = identity
    bool ages;              // the mesh gets Mesh.young
    float young;            // of the vertices that are added
    float *youth;           // of all vertices, if ages
    int64_t youth_capacity;
    bool failed;
    Error *e;
} Quads;

// Adds a vertex; returns its number.
uint32_t quads_vertex(Quads *quads, Vec3 position, Vec2 uv);

void quads_face(Quads *quads, uint32_t a, uint32_t b, uint32_t c, uint32_t d);

// Adds the faces between `rows` rows of `columns` vertices each, the first of which is `first`.
void quads_grid(Quads *quads, uint32_t first, int rows, int columns);

// Adds an open tube about an axis of `count` points with these radii (m), each side `sides` faces
// round. uv: of all its vertices.
void quads_tube(Quads *quads, const Vec3 *axis, const float *radius, int count, int sides, Vec2 uv);

// Adds a body of revolution about +Y: `count` rings of radius profile[i].x at height profile[i].y.
// uv: u around, v along. Rings of radius 0 close it.
void quads_revolve(Quads *quads, const Vec2 *profile, int count, int sides);

// The mesh with normals and uv; the caller frees it with mesh_free. Empties quads, also on failure.
Mesh *quads_mesh(Quads *quads);
void quads_clear(Quads *quads);

#endif
