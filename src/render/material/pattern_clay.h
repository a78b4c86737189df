// Clay that has swollen in the rain and shrunk in the sun: popcorn on slopes, plates with curled
// edges on level ground.
#ifndef RAMIFY_RENDER_MATERIAL_PATTERN_CLAY_H
#define RAMIFY_RENDER_MATERIAL_PATTERN_CLAY_H

#include "render/surface.h"

typedef struct DriedClay {
    float height; // m, about 0; down to -6 cm in cracks
    float shade;  // 0..1: in cracks
    float tone;   // about -1..1, of a crumb
} DriedClay;

// amount: 0..1; how far it has dried. level: 0..1; the share of plates. All 0 where pixels are
// wider than its pieces.
DriedClay pattern_dried_clay(const SurfacePoint *point, float amount, float level);

#endif
