// A polygon mesh of triangles or quads as plain arrays: what importers make, what skinning makes,
// what the ray tracer and the exporters take.
#ifndef RAMIFY_BASE_MESH_H
#define RAMIFY_BASE_MESH_H

#include "base/error.h"
#include "base/vec.h"

#include <stdint.h>

typedef struct Mesh {
    int face_size;        // corners a face: 3 or 4, the same for all faces
    int64_t vertex_count; // below 2^32
    int64_t face_count;
    uint32_t *index; // face_count * face_size, counter-clockwise seen from outside
    Vec3 *position;  // m
    Vec3 *normal;    // unit, per vertex; NULL = flat shading
    Vec2 *uv;        // m around and along on grown meshes, 0..1 elsewhere; NULL = none
    float *radius;   // m, of the branch the vertex lies on; NULL = none
    float *birth;    // growth step, as a fraction of the last one, 0..1; NULL = none
    Vec2 *site;      // land: altitude (x) and wetness (y), 0..1 each; NULL = none
} Mesh;

// Which optional arrays mesh_new makes.
enum { MESH_NORMAL = 1, MESH_UV = 2, MESH_RADIUS = 4, MESH_BIRTH = 8, MESH_SITE = 16 };

// A mesh with arrays of these sizes, contents zero; NULL and e when memory is short.
Mesh *mesh_new(int face_size, int64_t vertex_count, int64_t face_count, int arrays, Error *e);
void mesh_free(Mesh *mesh); // NULL is fine

Aabb mesh_bounds(const Mesh *mesh);

// Sets normals (made if NULL) to the angle-weighted mean of the faces around each vertex.
bool mesh_compute_normals(Mesh *mesh, Error *e);

// Transforms positions and normals in place; a mirroring transform also turns the faces round.
bool mesh_transform(Mesh *mesh, const Transform *t, Error *e);

// What is wrong with a closed surface. closed = open, overused and misoriented edges are all 0.
typedef struct MeshTopology {
    int64_t edge_count;
    int64_t open_edges;        // used by one face
    int64_t overused_edges;    // used by three or more
    int64_t misoriented_edges; // used by two faces in the same direction
    int64_t degenerate_faces;  // repeat a vertex
    int64_t component_count;   // connected pieces (by shared vertices)
    int64_t euler_number; // V - E + F over used vertices; 2 for each closed piece without handles
} MeshTopology;

bool mesh_topology(const Mesh *mesh, MeshTopology *topology, Error *e);

// closed[f] (face_count of them) becomes 1 where face f belongs to a piece that encloses a body and
// is turned outward: as many of its faces run along each edge one way as the other, and its volume
// is positive. Vertices at the same place count as one; pieces hang together by vertices. 0 on all
// else: sheets, bodies with holes, and bodies turned inside out.
bool mesh_closed_faces(const Mesh *mesh, uint8_t *closed, Error *e);

#endif
