// The surface of a braided river's water, and a little beyond its edges.
#ifndef RAMIFY_LAND_BRAID_LEVEL_H
#define RAMIFY_LAND_BRAID_LEVEL_H

#include "land/braid.h"

typedef struct BraidLevel {
    int side;
    double *level; // m above the inclined plane, of cells with ring < BRAID_NO_WATER
    uint8_t *ring; // 0 = water; cells from it; BRAID_NO_WATER = farther than the rings reach
} BraidLevel;

enum { BRAID_RINGS = 10, BRAID_NO_WATER = BRAID_RINGS + 1 };

// Puddles of less than `least` cells and films are left out. Free with braid_level_free.
BraidLevel *braid_level_new(const Braid *braid, int64_t least, Error *e);
void braid_level_free(BraidLevel *level); // NULL is fine

// The water's level at a place, u and v in cells from the corner.
typedef struct BraidWater {
    bool known;
    double level; // m above the inclined plane
    double away;  // 0 = at water, 1 = as far from it as the level is known
} BraidWater;
BraidWater braid_water_at(const BraidLevel *level, double u, double v);

#endif
