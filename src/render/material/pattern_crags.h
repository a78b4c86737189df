// Rock faces: blocks between joints at several scales, as tilted facets.
#ifndef RAMIFY_RENDER_MATERIAL_PATTERN_CRAGS_H
#define RAMIFY_RENDER_MATERIAL_PATTERN_CRAGS_H

#include "render/surface.h"

typedef struct Crags {
    Vec3 slope;    // tilt of the facets: dimensionless, as pattern_tilt takes it
    float tone;    // about -1..1, one value a block
    float crevice; // 0..1: in the joints between blocks
} Crags;

// Blocks from `size` (m, in the object's space) down, as far as the pixel shows them. They are
// taller than wide, as faces are cut by steep joints.
Crags pattern_crags(const SurfacePoint *point, float size);

#endif
