// Exact answers about single primitives under any affine transform: distance, bounds, volume, area,
// tessellated surface. Everything in double, so that large or distant shapes keep their precision.
#ifndef RAMIFY_SHAPE_PRIMITIVE_H
#define RAMIFY_SHAPE_PRIMITIVE_H

#include "shape/envelope.h"

typedef struct Primitive {
    ShapeKind kind;
    double size[3];       // as in Shape, with those scales folded in that keep the kind
    double inverse[3][4]; // world to the frame in which the primitive is as `size` says
    double forward[3][4]; // and back; a rigid motion where exact
    bool exact;           // distances are exact; otherwise to first order near the surface
    double shrink;        // |true distance| >= shrink * |distance in the primitive's frame|
    double affine[3][4];  // Shape.transform, and its ...
    double raw_size[3];   // ... Shape.size: what is tessellated
} Primitive;

// False and ERROR_INPUT for sizes that are no shape and for singular or non-finite transforms.
// Not for SHAPE_MESH.
bool primitive_new(const Shape *shape, Primitive *p, Error *e);

// Signed distance to the surface, m, negative inside, always with the right sign. *bound (if not
// NULL) is set to a number that |true distance| is not below.
double primitive_distance(const Primitive *p, Vec3 point, double *bound);

// The sign of the distance alone.
bool primitive_contains(const Primitive *p, Vec3 point);

Aabb primitive_bounds(const Primitive *p);     // infinite for a half space
Transform primitive_frame(const Primitive *p); // as envelope_frame
double primitive_volume(const Primitive *p);
double primitive_area(const Primitive *p);

// Triangles with smooth normals (creases kept), fine enough that the chord error is about 0.03 % of
// the size. The caller frees it with mesh_free.
Mesh *primitive_surface(const Primitive *p, Error *e);

#endif
