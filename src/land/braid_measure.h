// What tells a braided river from others.
#ifndef RAMIFY_LAND_BRAID_MEASURE_H
#define RAMIFY_LAND_BRAID_MEASURE_H

#include "land/braid_level.h"

typedef struct BraidMeasures {
    double threads;     // of water across the plain, mean of all sections: total braiding intensity
    double active;      // of them, where the flow moves gravel
    double bar_ratio;   // length over width of bars with water all around, their median; NAN = none
    double trunk_share; // of the flow that the widest thread of a section takes, mean of all
    double trunk_width; // over the mean width of its section's threads, mean of all
    double wet;         // share of the plain under water
    double fall;        // mean slope of the water's surface
} BraidMeasures;

// The flow as it is: braid_run came before.
bool braid_measure(const Braid *braid, const BraidLevel *level, BraidMeasures *measures, Error *e);

#endif
