// Depth below an envelope's surface, defined everywhere inside, also where the envelope's own
// distances are clamped.
#ifndef RAMIFY_SHAPE_DEPTH_FIELD_H
#define RAMIFY_SHAPE_DEPTH_FIELD_H

#include "shape/envelope.h"

typedef struct DepthField {
    const Envelope *envelope; // borrowed
    float *depth; // m, on a grid of size[0] x size[1] x size[2], z fastest; NULL where the
                  // envelope's distances suffice
    int size[3];
    Vec3 origin;
    float spacing;
    float deepest; // m, the greatest depth
} DepthField;

// Solves |grad depth| = 1 by fast sweeping (Zhao 2005) on a grid of at most 96 cells a side. To be
// freed; NULL on error. envelope_depth keeps that of an envelope.
DepthField *depth_field_new(const Envelope *envelope, Error *e);
void depth_field_free(DepthField *field); // NULL is fine

// Relative depth of a point p inside: 0 at the surface, 1 at the deepest point.
float depth_field_at(const DepthField *field, Vec3 p);

#endif
