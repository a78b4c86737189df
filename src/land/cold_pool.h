// Where cold air lies: a level that follows the low ground of a landscape and leaves out its hills.
// Fog of a given depth over it fills hollows and valleys, high ones as well as low ones, and crests
// stand out of it.
#ifndef RAMIFY_LAND_COLD_POOL_H
#define RAMIFY_LAND_COLD_POOL_H

#include "base/run.h"
#include "land/height_field.h"

typedef struct ColdPoolParams {
    float radius; // m: the lowest land within a square of twice this side is the low ground
    float depth;  // m: of the air that lies on it
    float drift;  // 0..1: how far wind banks the air up before slopes and thins it behind them
    float wind;   // degrees: where it blows, from +Z toward +X
} ColdPoolParams;

enum { COLD_POOL_SIDE = 513 }; // samples along a side, at most

// Levels (m) over the square of the land, without its other maps, in at most COLD_POOL_SIDE samples
// a side: the lowest land within the radius (grey erosion, Serra 1982), smoothed by two means over
// squares of half of it, and with drift raised by
//
//     drift depth / 2 clamp((land a radius downwind - land a radius upwind) / (2 depth), -1, 1)
//
// where the land is its mean over such a square. Beyond its rim the land is taken for its mirror
// image, or, if it is periodic, for itself. The caller frees it with height_field_free.
// ERROR_MEMORY.
HeightField *cold_pool_level(const HeightField *land, const ColdPoolParams *params, const Run *run,
                             Error *e);

#endif
