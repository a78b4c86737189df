// Measures of an out-tree's forks; see measure.h.
#ifndef RAMIFY_OUTTREE_MEASURE_FORKS_H
#define RAMIFY_OUTTREE_MEASURE_FORKS_H

#include "outtree/branching.h"

typedef struct ForkMeasures {
    double angle, angle_spread, main_angle; // degrees
    double exponent, pipe_residual, murray_residual;
    double asymmetry;
} ForkMeasures;

bool measure_forks(const OutTree *tree, const Branching *branching, ForkMeasures *out, Error *e);

#endif
