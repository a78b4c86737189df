// Signed distance to a standing human body, seven and a half heads tall: round cones for limbs,
// trunk, head and muscles, smoothly blended. The arms hang slightly apart, palms forward.
#ifndef RAMIFY_SHAPE_BODY_H
#define RAMIFY_SHAPE_BODY_H

#include "shape/envelope.h"

typedef struct Body {
    double inverse[3][4]; // from world space to a body of height 1: feet at y = 0, facing +Z, its
                          // left at +X
    double shrink;        // |true distance| >= shrink * |distance there|
    Aabb bounds;
} Body;

// shape->size.x is the height, m. Fails with ERROR_INPUT when the height is not positive or the
// transform is singular.
bool body_new(const Shape *shape, Body *body, Error *e);

// Signed distance (m): first-order accurate near the surface, sign always right. *bound is as in
// primitive_distance.
double body_distance(const Body *body, Vec3 point, double *bound);

#endif
