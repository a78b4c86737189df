// White water: what the strands of a waterfall become below its lip.
#ifndef RAMIFY_OBJECTS_TERRAIN_WHITE_WATER_H
#define RAMIFY_OBJECTS_TERRAIN_WHITE_WATER_H

#include "base/vec.h"
#include "mesh/spray.h"

#include <stdint.h>

// A fall. Initialize what is of no account below to 0.
typedef struct WhiteWater {
    Vec3 across, way; // unit, level: across the river and along it
    float spacing;    // m between neighbouring strands
    float discharge;  // m^3/s
    float shutter;    // s for which clots are seen on their way
    uint64_t key;
    double weights, falling; // sums over strands: of parcels' weights; of weights times seconds
                             // that they are white
    double strands;          // sum of strands' weights
} WhiteWater;

typedef struct WhiteStrand {
    int number;
    float side;        // m from the middle of the fall
    float width;       // relative to the mean
    const Vec3 *place; // `count` >= 2, from the lip to the foot, `step` seconds apart
    int count;
    float step;
} WhiteStrand;

// How much of the water that has fallen by this share of the height, 0..1, is white.
float white_water_share(float share);

// Adds the clots of a strand, with their tails, weighted. ERROR_MEMORY.
bool white_water_strand(WhiteWater *fall, const WhiteStrand *strand, SprayParcels *water, Error *e);

// Turns weights into contents, when all strands are added: of as much water as falls.
void white_water_settle(const WhiteWater *fall, SprayParcels *water);

#endif
