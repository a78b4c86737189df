// A standing human body, seven and a half heads tall, as a signed distance: round cones for limbs,
// trunk, head and muscles, blended smoothly into each other. Arms a little apart, palms forward.
#ifndef RAMIFY_SHAPE_BODY_H
#define RAMIFY_SHAPE_BODY_H

#include "shape/envelope.h"

typedef struct Body {
    double inverse[3][4]; // world to a body of height 1: feet at y = 0, facing +Z, its left at +X
    double shrink;        // |true distance| >= shrink * |distance there|
    Aabb bounds;
} Body;

// shape->size.x is the height, m. False and ERROR_INPUT for heights that are not positive and
// transforms that are singular.
bool body_new(const Shape *shape, Body *body, Error *e);

// Signed distance (m) to first order near the surface, always with the right sign; *bound as in
// primitive_distance.
double body_distance(const Body *body, Vec3 point, double *bound);

#endif
