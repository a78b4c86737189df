// Rings: the cross-sections of a branch's tube.
#ifndef RAMIFY_SKIN_RING_H
#define RAMIFY_SKIN_RING_H

#include "skin/plan.h"

#include <stdint.h>

typedef struct SkinRing {
    Vec3 centre;
    Vec3 normal;    // unit, the direction of the branch
    Vec3 side;      // unit, perpendicular to the normal
    Vec3 *corner;   // `sides` corners, borrowed, counter-clockwise seen from the branch's end;
                    // corner k lies at 360 k / sides - 45 degrees from the side
    uint32_t *name; // their vertex indices in the cage, borrowed
    int sides;
    float radius;    // m, of the branch
    bool uneven;     // the section is not round:
    SkinGirth girth; // by the angle from the side
    float along;     // m from the start of the axis
    float birth;
} SkinRing;

// Cosine and sine of corner k's angle to the side.
void skin_ring_direction(int sides, int k, float *cosine, float *sine);

// Ratio of the corner distance to the limit curve's radius. The limit (cubic B-spline) of a regular
// polygon has (4 + 2 cos a) / 6 of the corner distance at corners, a = 2 pi / sides, and (23
// cos(a/2) + cos(3a/2)) / 24 between them; their mean is set to the branch's radius. For four
// sides: 1.52, with a limit round to 1.5 %.
float skin_ring_scale(int sides);

// Sets the corners from centre, normal, side (made perpendicular to the normal) and radius.
void skin_ring_set_corners(SkinRing *ring);

// Corner k of a ring refined to that many sides: its own number or twice it.
Vec3 skin_ring_finer_corner(const SkinRing *ring, int sides, int k);

// Fits centre, normal and side to a ring with given corners: the mouth in a parent's face.
void skin_ring_fit(SkinRing *ring);

// Tilts rings in bends, and as a last resort moves them, so that every corner is ahead of the same
// corner of the ring before; then all side faces of the tube face away from its axis. The first
// ring is unchanged.
void skin_rings_settle(SkinRing *ring, int64_t count);

#endif
