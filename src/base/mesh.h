// A polygon mesh of triangles or quads as plain arrays: made by importers and skinning, used by the
// ray tracer and the exporters.
#ifndef RAMIFY_BASE_MESH_H
#define RAMIFY_BASE_MESH_H

#include "base/error.h"
#include "base/vec.h"

#include <stdint.h>

typedef struct Mesh {
    int face_size;        // vertices per face: 3 or 4, the same for all faces
    int64_t vertex_count; // below 2^32
    int64_t face_count;
    uint32_t *index; // face_count * face_size, counter-clockwise seen from outside
    Vec3 *position;  // m
    Vec3 *normal;    // unit, per vertex; NULL = flat shaded
    Vec2 *uv;        // m, around and along on grown meshes, 0..1 elsewhere; NULL = none
    float *radius;   // m, radius of the vertex's branch; NULL = none
    float *birth;    // growth step, as a fraction of the last one, 0..1; NULL = none
    Vec2 *site;      // land: altitude (x) and wetness (y), 0..1 each; NULL = none
    float *foam;     // water: share of it that is white with air, 0..1; NULL = none
    float *shore;    // land: m by which it lies lower than MESH_SHORE above the water near
                     // it, 0 = higher or far from water; NULL = there is no water
    float *young;    // leaves: 1 = grown this year, paler, 0 = older; NULL = older everywhere
    float *withered; // leaves: 0 = green, MESH_YELLOW, MESH_BROWN = dead and moist, 1 = dead and
                     // dry; NULL = green everywhere
    struct Waves *waves;   // of a sea, for what is finer than the mesh; owned; NULL = none
    struct Strata *strata; // land: its beds of rock, in the mesh's space; owned; NULL = none
} Mesh;

// Optional arrays for mesh_new.
enum {
    MESH_NORMAL = 1,
    MESH_UV = 2,
    MESH_RADIUS = 4,
    MESH_BIRTH = 8,
    MESH_SITE = 16,
    MESH_FOAM = 32,
    MESH_SHORE_ARRAY = 64,
    MESH_YOUNG = 128,
    MESH_WITHERED = 256
};

// Mesh.withered where the green has gone, and where tissue has died.
#define MESH_YELLOW 0.45f
#define MESH_BROWN 0.7f

#define MESH_SHORE 8.0f // m above water: how far up shores reach

// Creates a mesh with arrays of these sizes, zeroed; NULL and e when out of memory. Free with
// mesh_free.
Mesh *mesh_new(int face_size, int64_t vertex_count, int64_t face_count, int arrays, Error *e);
void mesh_free(Mesh *mesh); // NULL is fine

Aabb mesh_bounds(const Mesh *mesh);

// Sets normals (allocated if NULL) to the angle-weighted mean of the faces around each vertex.
bool mesh_compute_normals(Mesh *mesh, Error *e);

// Transforms positions and normals in place; a mirroring transform also reverses the faces.
bool mesh_transform(Mesh *mesh, const Transform *t, Error *e);

// Topological defects of a surface. It is closed if open, overused and misoriented edges are all 0.
typedef struct MeshTopology {
    int64_t edge_count;
    int64_t open_edges;        // used by one face
    int64_t overused_edges;    // used by three or more
    int64_t misoriented_edges; // used by two faces in the same direction
    int64_t degenerate_faces;  // repeat a vertex
    int64_t component_count;   // connected components (by shared vertices)
    int64_t euler_number; // V - E + F over used vertices; 2 per closed component without handles
} MeshTopology;

bool mesh_topology(const Mesh *mesh, MeshTopology *topology, Error *e);

// Sets closed[f] (face_count entries) to 1 if face f is part of a component that encloses a volume
// and faces outward: along each edge as many faces run one way as the other, and the volume is
// positive. Vertices at equal positions count as one; components are connected by vertices. 0 for
// sheets, bodies with holes, and inverted bodies.
bool mesh_closed_faces(const Mesh *mesh, uint8_t *closed, Error *e);

#endif
