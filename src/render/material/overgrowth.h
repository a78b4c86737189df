// Moss and lichen on bark and stone.
#ifndef RAMIFY_RENDER_MATERIAL_OVERGROWTH_H
#define RAMIFY_RENDER_MATERIAL_OVERGROWTH_H

#include "render/surface.h"

typedef struct Overgrowth {
    float share;  // 0..1: how far it covers what is below
    float height; // m, that it adds to the surface
    Vec3 color;
} Overgrowth;

// Moss on a place of which `damp` (0..1 and more) and `low` (0..1: depth in a furrow) tell how well
// it does. amount: 0..1; thickest: m.
Overgrowth moss_at(float amount, const SurfacePoint *point, float damp, float low, float thickest);

// Lichen in crusts and rosettes: grey-green, some yellow. amount: 0..1.
Overgrowth lichen_at(float amount, const SurfacePoint *point);

#endif
