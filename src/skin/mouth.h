// Mouths: where a child's tube leaves a block of its parent's faces.
#ifndef RAMIFY_SKIN_MOUTH_H
#define RAMIFY_SKIN_MOUTH_H

#include "skin/cage.h"
#include "skin/grid.h"
#include "skin/ring.h"

// The parent's rings about the seat.
typedef struct SkinMouthSite {
    int32_t parent;       // chain
    float phase;          // of the parent's rings
    const SkinRing *ring; // the seat's lower edge; size more follow
    const SkinSeat *seat;
} SkinMouthSite;

// A ring's corner as a vertex; offset: m from the root to the start of the ring's axis.
SkinVertex skin_ring_vertex(const SkinRing *ring, int k, float offset);

// Whether a mouth in this seat would have no face that looks inwards.
bool skin_mouth_fits(const SkinPlan *plan, const SkinMouthSite *site);

// Fills the block with frames of quads that shrink from its outline (whose corners have names) to
// the child's own girth, and leaves that open. Writes the names of the last frame's 4 * size
// vertices to mouth, counter-clockwise seen from outside, from the lower left.
bool skin_mouth_open(SkinCage *cage, const SkinPlan *plan, const SkinMouthSite *site,
                     uint32_t *mouth, Error *e);

#endif
