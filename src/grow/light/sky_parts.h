// Parts of an overcast sky (CIE: (1 + 2 sin elevation) / 3) that light comes from: three rings of
// eight and the zenith. The rings' azimuths are symmetric to both horizontal axes.
#ifndef RAMIFY_GROW_LIGHT_SKY_PARTS_H
#define RAMIFY_GROW_LIGHT_SKY_PARTS_H

#include "base/vec.h"

enum { SKY_RINGS = 4, SKY_RING_PARTS = 8, SKY_PARTS = 3 * SKY_RING_PARTS + 1 };

typedef struct SkyPart {
    Vec3 toward;  // unit, to the sky
    float weight; // of its light on a leaf of any direction; all add up to 1
} SkyPart;

// The parts of ring number `ring` (0 = lowest; the last is the zenith alone); returns their number.
int sky_ring(int ring, SkyPart part[SKY_RING_PARTS]);

#endif
