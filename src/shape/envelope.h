// Envelopes: the region of space that growth may fill. Primitives and imported meshes with
// transforms, cut by half spaces, joined by unions and differences. A single primitive is answered
// exactly; anything else becomes a narrow-band level set (OpenVDB).
#ifndef RAMIFY_SHAPE_ENVELOPE_H
#define RAMIFY_SHAPE_ENVELOPE_H

#include "base/error.h"
#include "base/mesh.h"
#include "base/run.h"
#include "base/vec.h"
#include "shape/grid_file.h"

typedef enum ShapeKind {
    SHAPE_SPHERE,     // unit sphere about the origin
    SHAPE_ELLIPSOID,  // half-axes size
    SHAPE_BOX,        // half-extents size, about the origin
    SHAPE_CONE,       // frustum about +Y: radius size.x at y = 0, size.z at y = size.y (0 = a tip)
    SHAPE_CAPSULE,    // about the segment from the origin to (0, size.y, 0), radius size.x
    SHAPE_MESH,       // imported surface
    SHAPE_HALF_SPACE, // y <= 0, before the transform; only to cut with
    SHAPE_BODY        // a standing human, size.x tall: feet at the origin, facing +Z (shape/body.h)
} ShapeKind;

typedef enum ShapeOp {
    SHAPE_UNION,       // the first shape of a list is always this
    SHAPE_DIFFERENCE,  // take this shape away from what there is so far
    SHAPE_INTERSECTION // keep only what lies in this shape too
} ShapeOp;

// One shape of the list. Sizes in metres before the transform.
typedef struct Shape {
    ShapeKind kind;
    ShapeOp op;
    Vec3 size;
    Transform transform;
    const char *file; // SHAPE_MESH: OBJ, PLY, STL, glTF, GLB; borrowed
} Shape;

typedef struct EnvelopeParams {
    const Shape *shapes; // borrowed
    int shape_count;     // >= 1
    float voxel;         // m, of level sets; 0 = largest extent / 128
} EnvelopeParams;

typedef struct Envelope Envelope;

// Warns (run->warn) about an open mesh and does its best with it.
Envelope *envelope_new(const EnvelopeParams *params, const Run *run, Error *e);
void envelope_free(Envelope *envelope); // NULL is fine

Aabb envelope_bounds(const Envelope *envelope);

// The affine map of the unit cube onto a slanted box around the inside, tighter than the bounds
// where a primitive is turned: what to draw candidates from.
Transform envelope_frame(const Envelope *envelope);

double envelope_volume(const Envelope *envelope); // m^3
double envelope_area(const Envelope *envelope);   // m^2, of the surface

// Signed distance to the surface, m, negative inside; clamped to the level set's narrow band where
// there is one. Safe to call from many threads.
float envelope_distance(const Envelope *envelope, Vec3 p);

// Whether p is inside: the sign of envelope_distance, faster.
bool envelope_contains(const Envelope *envelope, Vec3 p);

// The distance beyond which envelope_distance is clamped, m; INFINITY where it never is.
float envelope_band(const Envelope *envelope);

// Adds the envelope as a level set to the grids of a file: its own one, or, of a single primitive,
// one of 128 voxels along the longest side.
bool envelope_add_to(const Envelope *envelope, const char *name, GridFile *grids, const Run *run,
                     Error *e);

// The surface as triangles with normals (the imported mesh itself where the envelope is just that).
// Owned by the envelope.
const Mesh *envelope_surface(const Envelope *envelope);

#endif
