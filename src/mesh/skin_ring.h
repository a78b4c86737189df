// Rings: the cross-sections that a branch's tube is stretched over.
#ifndef RAMIFY_MESH_SKIN_RING_H
#define RAMIFY_MESH_SKIN_RING_H

#include "base/vec.h"

#include <stdint.h>

// A square ring's limit curve has 2/3 of the corners' distance at the corners and 0.648 of it
// between them (cubic B-spline); this makes the limit's mean radius the branch's.
#define SKIN_CORNER_SCALE 1.521f
// Distance of a side face's middle, in branch radii.
#define SKIN_FACE_SCALE (0.70710678f * SKIN_CORNER_SCALE)

typedef struct SkinRing {
    Vec3 centre;
    Vec3 normal;    // unit, the way the branch goes
    Vec3 side;      // unit, across the normal; side face 0 looks that way
    Vec3 corner[4]; // counter-clockwise seen from the branch's end; corner k is 90 k - 45 degrees
                    // round from the side
    float radius;   // m, of the branch
    float along;    // m from the start of the axis
    float birth;
} SkinRing;

// Corners from centre, normal, side (made to stand across the normal) and radius.
void skin_ring_set_corners(SkinRing *ring);

// A ring whose corners are given: the mouth in a parent's face.
SkinRing skin_ring_from_corners(const Vec3 corner[4]);

// Tilts rings in bends, and as a last resort moves them, so that every corner lies ahead of the
// same corner of the ring before: then all side faces of the tube look away from its axis. The
// first ring stays as it is.
void skin_rings_settle(SkinRing *ring, int64_t count);

#endif
