// Rings: the cross-sections that a branch's tube is stretched over.
#ifndef RAMIFY_SKIN_RING_H
#define RAMIFY_SKIN_RING_H

#include "base/vec.h"

#include <stdint.h>

typedef struct SkinRing {
    Vec3 centre;
    Vec3 normal;    // unit, the way the branch goes
    Vec3 side;      // unit, across the normal
    Vec3 *corner;   // `sides` of them, not owned, counter-clockwise seen from the branch's end;
                    // corner k is 360 k / sides - 45 degrees round from the side
    uint32_t *name; // their numbers in the cage, not owned
    int sides;
    float radius; // m, of the branch
    float along;  // m from the start of the axis
    float birth;
} SkinRing;

// Cosine and sine of corner k's direction, from the side.
void skin_ring_direction(int sides, int k, float *cosine, float *sine);

// Distance of a ring's corners over the radius of its limit curve. A regular polygon's limit (cubic
// B-spline) has (4 + 2 cos a) / 6 of the corners' distance at corners, a = 2 pi / sides, and
// (23 cos(a/2) + cos(3a/2)) / 24 between them: their mean becomes the branch's radius. Four sides:
// 1.52, and the limit is round to 1.5 %.
float skin_ring_scale(int sides);

// Corners from centre, normal, side (made to stand across the normal) and radius.
void skin_ring_set_corners(SkinRing *ring);

// Corner k of a ring as if it had that many sides: its own number or twice it.
Vec3 skin_ring_finer_corner(const SkinRing *ring, int sides, int k);

// Centre, normal and side of a ring whose corners are given: the mouth in a parent's face.
void skin_ring_fit(SkinRing *ring);

// Tilts rings in bends, and as a last resort moves them, so that every corner lies ahead of the
// same corner of the ring before: then all side faces of the tube look away from its axis. The
// first ring stays as it is.
void skin_rings_settle(SkinRing *ring, int64_t count);

#endif
