// How much of falling snow comes to a place below what already bears it.
#ifndef RAMIFY_OBJECTS_COMMON_SNOW_FALL_H
#define RAMIFY_OBJECTS_COMMON_SNOW_FALL_H

#include "base/error.h"
#include "base/vec.h"
#include "objects/common/plant_cells.h"

#include <stdint.h>

// A grid of what catches snow within the bounds. Initialize with snow_fall_init, add all that
// catches, then call snow_fall_finish once.
typedef struct SnowFall {
    PlantCells cells;
    float *caught; // m2 across the fall in each cell; after snow_fall_finish: above the cell
} SnowFall;

bool snow_fall_init(SnowFall *fall, Aabb bounds, Error *e);
void snow_fall_free(SnowFall *fall);

// Adds an area (m2, seen from above) at p.
void snow_fall_add(SnowFall *fall, Vec3 p, float area);
void snow_fall_finish(SnowFall *fall);

// Share of the snow that comes to p, 0..1: what falls through and what slides from above.
float snow_fall_share(const SnowFall *fall, Vec3 p);

#endif
