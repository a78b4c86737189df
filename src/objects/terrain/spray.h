// Spray of waterfalls.
#ifndef RAMIFY_OBJECTS_TERRAIN_SPRAY_H
#define RAMIFY_OBJECTS_TERRAIN_SPRAY_H

#include "base/vec.h"
#include "mesh/spray.h"

typedef struct FallSpray {
    Vec3 way, across; // unit, level: along the river and across it
    float half;       // m, along `across`
    float height;     // m, > 0
    float cover;      // 0..1: how closely its strands stand together
    int strands;      // of the fall
    uint64_t key;
} FallSpray;

// Adds the spray of strand number `strand`, which takes the `count` >= 2 places: puffs about it and
// from its foot, the last of them. ERROR_MEMORY.
bool terrain_spray_strand(const FallSpray *fall, int strand, const Vec3 *place, int count,
                          SprayParcels *spray, Error *e);

// m^3 of the densest spray that all strands' feet hold in the mean: what leaves a face as wide as
// the fall and as high as its puffs at the speed of the air that escapes, until it rains out.
float terrain_fall_content(const FallSpray *fall);

#endif
