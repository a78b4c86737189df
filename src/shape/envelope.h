// Envelopes: the region of space that growth may fill. Primitives and imported meshes under
// transforms, combined by union, difference and intersection. A single primitive is evaluated
// exactly; other lists become a narrow-band level set (OpenVDB). An existing surface, which may be
// open and then has no inside, can be grown over only.
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
    SHAPE_HALF_SPACE, // y <= 0, before the transform; only for cutting
    SHAPE_BODY,       // a standing human, size.x tall: feet at the origin, facing +Z (shape/body.h)
    SHAPE_OBJECT      // the surface of another object: a name for envelope_of_surface
} ShapeKind;

typedef enum ShapeOp {
    SHAPE_UNION,       // the first shape of a list always has this
    SHAPE_DIFFERENCE,  // subtract this shape from those before it
    SHAPE_INTERSECTION // keep only what also lies inside this shape
} ShapeOp;

// One shape of the list. Sizes are in metres, before the transform.
typedef struct Shape {
    ShapeKind kind;
    ShapeOp op;
    float blend; // m: how far its edge with the shapes before it is rounded; 0 = sharp
    Vec3 size;
    Transform transform;
    Vec3 position, rotation, scale; // what a scene makes the transform of (degrees); else unused
    const char *file;               // SHAPE_MESH: OBJ, PLY, STL, glTF, GLB; borrowed
    const char *object;             // SHAPE_OBJECT: its name; borrowed
} Shape;

enum { ENVELOPE_VOXELS = 128 }; // along the largest extent, by default

typedef struct EnvelopeParams {
    const Shape *shapes; // borrowed
    int shape_count;     // >= 1
    float voxel;         // m, voxel size of level sets; 0 = largest extent / 128
    bool voxelized; // a single primitive becomes a level set, too, with faces of a voxel's size
} EnvelopeParams;

// One of the places around it where a surface is seen again.
typedef struct SurfaceCopy {
    Transform place; // from the surface to its copy
    int ring;        // 1 = next to it
    bool in_mesh;    // the surface's mesh goes on there, with ground of its own
} SurfaceCopy;

// A surface that exists already; borrowed.
typedef struct ShapeSurface {
    const Mesh *mesh; // triangles with normals
    // Moves p to the nearest point of the surface and sets the unit normal there. Thread-safe.
    void (*nearest)(const void *user, Vec3 *p, Vec3 *normal);
    const void *user;
    const SurfaceCopy *copy; // beyond it; borrowed
    int copy_count;
    const Mesh
        *water; // of land with copies in its mesh: its water, also theirs; borrowed; else NULL
} ShapeSurface;

typedef struct Envelope Envelope;

// Builds the envelope of shapes that are no SHAPE_OBJECT. An open mesh is a warning (run->warn);
// its holes are filled as well as possible.
Envelope *envelope_new(const EnvelopeParams *params, const Run *run, Error *e);

// An envelope of a surface alone, open or closed: to grow over, not in. Its volume is 0, and its
// distance has the sign of the side on which p lies of the nearest face. Borrows the surface.
Envelope *envelope_of_surface(const ShapeSurface *surface, Error *e);
void envelope_free(Envelope *envelope); // NULL is fine

Aabb envelope_bounds(const Envelope *envelope);

// Affine map from the unit cube to an oriented box around the inside, tighter than the bounds when
// a primitive is rotated. Candidate points are drawn from it.
Transform envelope_frame(const Envelope *envelope);

double envelope_volume(const Envelope *envelope); // m^3
double envelope_area(const Envelope *envelope);   // m^2, of the surface

// Signed distance to the surface, m, negative inside; clamped to the narrow band where a level set
// is used. Thread-safe.
float envelope_distance(const Envelope *envelope, Vec3 p);

// Moves p to the nearest point of an envelope_of_surface and sets the normal there; false without
// effect for other envelopes. Thread-safe.
bool envelope_nearest(const Envelope *envelope, Vec3 *p, Vec3 *normal);

// Whether p is inside: the sign of envelope_distance, but faster.
bool envelope_contains(const Envelope *envelope, Vec3 p);

// Distance at which envelope_distance is clamped, m; INFINITY if it is exact.
float envelope_band(const Envelope *envelope);

// The depth below its surface: made when first asked for, then kept. Owned by the envelope; NULL on
// error. Thread-safe.
struct DepthField;
const struct DepthField *envelope_depth(const Envelope *envelope, Error *e);

// Is envelope_distance that to the surface everywhere, as of one primitive that is not sheared?
bool envelope_is_exact(const Envelope *envelope);

// Adds the envelope to the file's grids as a level set: its own, or for a single primitive one of
// 128 voxels along the longest side. Not for an envelope_of_surface, which has no inside.
bool envelope_add_to(const Envelope *envelope, const char *name, GridFile *grids, const Run *run,
                     Error *e);

// The surface as triangles with normals; for a single mesh, that mesh. Owned by the envelope.
const Mesh *envelope_surface(const Envelope *envelope);

#endif
