// Figures of dunes, along the wind through every brink that is at least a third as high as the
// highest.
#ifndef RAMIFY_LAND_DUNES_MEASURE_H
#define RAMIFY_LAND_DUNES_MEASURE_H

#include "land/dunes.h"

typedef struct DuneMeasures {
    int64_t brinks;  // samples on brinks; all else is NaN without any
    double height;   // m, mean, from the foot of the slip face to the brink
    double length;   // m, mean, from the foot upwind to the foot of the slip face
    double slip;     // degrees, mean slope of slip faces
    double windward; // degrees, mean slope between a quarter and three quarters of the rise upwind
    double covered;  // share of the plain under at least a hundredth of the mean height of sand
} DuneMeasures;

bool dunes_measure(const Dunes *dunes, const DuneWind *wind, DuneMeasures *measures, Error *e);

#endif
