// Lumens: the open ends of tubes that are cut.
#ifndef RAMIFY_SKIN_LUMEN_H
#define RAMIFY_SKIN_LUMEN_H

#include "skin/cage.h"
#include "skin/ring.h"

// Closes the tube's first ring, whose corners have vertices, as a cut: a lip, the inside of a wall
// of this thickness (in radii, below 1) and a floor three radii in. offset as in skin_ring_vertex.
bool skin_lumen_close(SkinCage *cage, const SkinRing *ring, float wall, float offset, Error *e);

#endif
