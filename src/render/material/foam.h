// Foam on water: rafts of bubbles that break up into a lace of strands about holes of many sizes,
// dense where a wave has just broken, a thin veil where foam is old.
#ifndef RAMIFY_RENDER_MATERIAL_FOAM_H
#define RAMIFY_RENDER_MATERIAL_FOAM_H

#include "base/vec.h"

// Share of a pixel of this width, m, that foam hides at a place of the water, m, whose
// surroundings it hides to the share `cover`, 0..1. Its mean over places is the cover, for any
// width; it grows with the cover; a wider pixel shows less of the lace. Holes are longer along x.
float foam_share(float cover, Vec2 at, float width);

#endif
