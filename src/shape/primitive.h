// Exact queries of single primitives under any affine transform: distance, bounds, volume, area,
// tessellation. All in double, so that large or distant shapes keep their precision.
#ifndef RAMIFY_SHAPE_PRIMITIVE_H
#define RAMIFY_SHAPE_PRIMITIVE_H

#include "shape/envelope.h"

typedef struct Primitive {
    ShapeKind kind;
    double size[3];       // as in Shape, times those scales of the transform that keep the kind
    double inverse[3][4]; // from world space to the primitive's frame, where it has exactly this
                          // `size`
    double forward[3][4]; // the inverse; a rigid motion if exact
    bool exact;           // distances are exact; otherwise first-order accurate near the surface
    double shrink;        // |true distance| >= shrink * |distance in the primitive's frame|
    double affine[3][4];  // Shape.transform, used for tessellation
    double raw_size[3];   // Shape.size, used for tessellation
} Primitive;

// Fails with ERROR_INPUT for invalid sizes and for singular or non-finite transforms. Not for
// SHAPE_MESH.
bool primitive_new(const Shape *shape, Primitive *p, Error *e);

// Signed distance to the surface, m, negative inside; the sign is always right. *bound (if not
// NULL) is set to a lower bound of |true distance|.
double primitive_distance(const Primitive *p, Vec3 point, double *bound);

// Whether the point is inside: the sign of the distance.
bool primitive_contains(const Primitive *p, Vec3 point);

Aabb primitive_bounds(const Primitive *p);     // infinite for a half space
Transform primitive_frame(const Primitive *p); // see envelope_frame
double primitive_volume(const Primitive *p);
double primitive_area(const Primitive *p);

// Triangles with smooth normals (creases kept) and a chord error of about 0.03 % of the size. The
// caller frees it with mesh_free.
Mesh *primitive_surface(const Primitive *p, Error *e);

#endif
