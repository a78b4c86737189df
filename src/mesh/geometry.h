// Geometry: the parts of a model, passed to the ray tracer and the exporters. Every part refers to
// its material by index into the scene's list.
#ifndef RAMIFY_MESH_GEOMETRY_H
#define RAMIFY_MESH_GEOMETRY_H

#include "base/mesh.h"
#include "base/random.h"
#include "base/run.h"
#include "land/height_field.h"
#include "mesh/curves.h"
#include "mesh/spray.h"

typedef enum PartKind { PART_MESH, PART_CURVES } PartKind;

// A simpler form of an instanced mesh. The ray tracer draws it instead where it is so small on the
// screen that the difference cannot be seen; nothing else uses it.
typedef struct CoarseMesh {
    Mesh *mesh;  // owned; NULL = none
    float error; // m in the mesh's space: size of what is left out
} CoarseMesh;

enum { PART_COARSE_MOST = 3 };

// One mesh or curve set, drawn once (instance_count 0, in world space) or at every instance.
typedef struct Part {
    PartKind kind;
    Mesh *mesh;          // PART_MESH, owned
    CurveSet *curves;    // PART_CURVES, owned
    int material;        // index into World.materials
    int object;          // index of its object in the scene, for the object-id AOV
    Transform *instance; // owned; instance_count transforms; NULL = drawn once, untransformed
    float *variation;    // owned; 0..1 per instance, for colour variation; NULL = hashed from the
                         // instance's index
    float *season;       // owned; of leaves, per instance: see InstanceLook; NULL = 0
    int64_t instance_count;
    CoarseMesh coarse[PART_COARSE_MOST]; // of an instanced mesh: from fine to coarse
    HeightField *land;   // owned; of a terrain whose maps are drawn: what the part shows, in the
                         // scene; NULL = none
    SprayParcels *spray; // owned; what it throws up; NULL = nothing
    bool is_water;       // the surface of the water of a land, on which nothing stands
    SprayParcels *water; // owned; falling water that air has made white; NULL = none
} Part;

typedef struct Geometry {
    Part *part;
    int64_t count, capacity;
} Geometry;

// By what one instance differs in colour from another.
typedef struct InstanceLook {
    float variation; // 0..1
    float season;    // of a leaf: from -1, just out of the bud, over 0, full-grown, to 1, turned to
                     // its autumn colour
} InstanceLook;

static inline float part_variation(const Part *part, int64_t instance)
{
    return part->variation ? part->variation[instance]
                           : random_unit(random_key((uint64_t)part->object, (uint64_t)instance));
}

static inline InstanceLook part_look(const Part *part, int64_t instance)
{
    return (InstanceLook){part_variation(part, instance),
                          part->season ? part->season[instance] : 0.0f};
}

// Frees the part's mesh and its coarse forms and sets them to NULL.
void part_free_meshes(Part *part);

void part_clear(Part *part); // frees all that a part owns

// Appends a part. Takes ownership of all that it owns, even on failure.
bool geometry_add(Geometry *geometry, Part part, Error *e);

// Puts the parts into the order of their objects, 0 .. objects - 1, and those of one object into
// the order in which they were added.
bool geometry_order(Geometry *geometry, int objects, Error *e);
void geometry_clear(Geometry *geometry); // frees the parts and empties the Geometry

// Copies the part's mesh to every instance as one mesh, which traces faster than many small distant
// instances and can be instanced again. The caller frees it with mesh_free.
Mesh *geometry_bake(const Part *part, const Run *run, Error *e);

// The meshes of all parts that are neither instanced nor water as one mesh of triangles with
// normals, those of its faces around each vertex; possibly without faces. The caller frees it with
// mesh_free.
Mesh *geometry_surface(const Geometry *geometry, Error *e);

// Likewise, without normals, of the water.
Mesh *geometry_water(const Geometry *geometry, Error *e);

typedef struct GeometryCounts {
    int64_t triangles; // counted once per part; a quad counts as two
    int64_t curve_segments;
    int64_t instances;
    int64_t bytes;
} GeometryCounts;

GeometryCounts geometry_counts(const Geometry *geometry);

#endif
