// What tells a delta from others.
#ifndef RAMIFY_LAND_DELTA_MEASURE_H
#define RAMIFY_LAND_DELTA_MEASURE_H

#include "land/delta.h"

typedef struct DeltaMeasures {
    double branches;   // channels that cross an arc about the river's mouth: the mean of all arcs
                       // between 0.3 and 0.9 of the delta's reach
    double mouths;     // their number on the arc with the most
    double land;       // m^2 of new land: bed above the water
    double land_share; // of it in its convex hull
    double shoreline;  // length of its shores over the square root of its area
    double reach;      // m from the river's mouth to the farthest land
} DeltaMeasures;

// fall: m by which the water has fallen
// below the level that built the land.
bool delta_measure(const Delta *d, double fall, DeltaMeasures *measures, Error *e);

#endif
