// The anvil of a storm: ice that has risen to the tropopause and spreads below it as one thin
// sheet, which flares from the tower, ends sharply against the wind, and is drawn out downwind in
// fibres.
#ifndef RAMIFY_RENDER_CLOUD_ANVIL_H
#define RAMIFY_RENDER_CLOUD_ANVIL_H

#include "render/cloud/detail.h"
#include "render/cloud/storm.h"

typedef struct Anvil {
    StormFrame frame;
    const DetailNoise *detail; // borrowed
    Vec3 origin;               // m: of its noise
    float phase[3];            // of its lobes
} Anvil;

// The sheet above a place of the ground.
typedef struct AnvilColumn {
    float low, high;  // m: altitudes of its sides; high < low beyond its rim
    float softness;   // of its borders
    float share;      // of the greatest extinction, where fibres take nothing
    float fibrous;    // 0 .. 1: how far fibres thin it
    Vec3 grain;       // where the fibres are looked up, at altitude 0
    Vec3 grain_slope; // the same a metre up: they lean with the wind's shear
} AnvilColumn;

Anvil anvil_of(const Cloud *cloud, const DetailNoise *detail, uint64_t key);

// x, z: m.
AnvilColumn anvil_column(const Anvil *anvil, float x, float z);

// Share of the greatest extinction, 0 .. 1, at an altitude in the sheet, m.
float anvil_share(const Anvil *anvil, const AnvilColumn *column, float altitude);

// How deep a place is inside the sheet, m; negative outside.
float anvil_depth(const AnvilColumn *column, float altitude);

#endif
