// Mouths: the openings in a block of the parent's faces from which a child's tube starts.
#ifndef RAMIFY_SKIN_MOUTH_H
#define RAMIFY_SKIN_MOUTH_H

#include "skin/cage.h"
#include "skin/grid.h"
#include "skin/ring.h"

// The parent's rings around the seat.
typedef struct SkinMouthSite {
    int32_t parent;       // chain
    float phase;          // of the parent's rings
    const SkinRing *ring; // ring at the seat's lower edge; `size` more follow
    const SkinSeat *seat;
} SkinMouthSite;

// A ring's corner as a vertex; offset: m from the root to the start of the ring's axis.
SkinVertex skin_ring_vertex(const SkinRing *ring, int k, float offset);

// Whether a mouth in this seat would have only faces that face outward.
bool skin_mouth_fits(const SkinPlan *plan, const SkinMouthSite *site);

// Fills the block with nested frames of quads from its outline (whose corners have vertices) to the
// child's cross-section, which stays open. Writes the indices of the last frame's 4 * size vertices
// to mouth, counter-clockwise seen from outside, starting at the lower left.
bool skin_mouth_open(SkinCage *cage, const SkinPlan *plan, const SkinMouthSite *site,
                     uint32_t *mouth, Error *e);

#endif
