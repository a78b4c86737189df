// Distances to the nearest of many samples of a grid.
#ifndef RAMIFY_BASE_DISTANCE_TRANSFORM_H
#define RAMIFY_BASE_DISTANCE_TRANSFORM_H

#include "base/error.h"

// squared: columns * rows values, row by row; 0 at the samples that distances are to, INFINITY at
// the others. Each becomes its squared distance to the nearest of the former; all stay INFINITY
// where there is none. across, along: m between columns and between rows. Exact (Felzenszwalb and
// Huttenlocher, "Distance Transforms of Sampled Functions", Theory of Computing 8, 2012). false and
// e when out of memory.
bool distance_transform(double *squared, int columns, int rows, double across, double along,
                        Error *e);

#endif
