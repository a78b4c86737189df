// Shapes that flow into each other, as one signed distance.
#ifndef RAMIFY_SHAPE_BLEND_H
#define RAMIFY_SHAPE_BLEND_H

#include "shape/body.h"
#include "shape/primitive.h"

// Polynomial smooth minimum of two distances: differs from it only where they differ by less than
// `width`, and by a quarter of that at most.
double blend_distance(double a, double b, double width);

// A shape, which is combined with those before it.
typedef struct BlendPart {
    const Shape *shape;
    const Primitive *primitive; // NULL = a body
    const Body *body;
} BlendPart;

typedef struct Blend {
    const BlendPart *part;
    int count;
} Blend;

// Signed distance (m): first-order accurate near the surface, except for the edges that are
// rounded. *bound is as in primitive_distance. blend: a Blend.
double blend_all_distance(const void *blend, Vec3 p, double *bound);

#endif
