// The parts of the model of deltas. Private to this folder.
#ifndef RAMIFY_LAND_DELTA_PARTS_H
#define RAMIFY_LAND_DELTA_PARTS_H

#include "land/delta.h"

enum { DELTA_WAYS = 8, DELTA_SOUTH = 2, DELTA_WATERS = 480, DELTA_GRAINS = 360 };

// The way to a neighbour.
typedef struct DeltaWay {
    int column, row;
    double x, z, near; // unit vector; 1 / its length in cells
} DeltaWay;

extern const DeltaWay delta_ways[DELTA_WAYS];

// Of a parcel's path: a cell, and the way from it.
typedef struct DeltaStep {
    int32_t cell, way;
} DeltaStep;

typedef struct DeltaWork {
    double *depth;   // m, of each cell
    double *sum;     // of levels that the parcels tell, or of a sweep
    double *x, *z;   // sum of the ways of parcels of this step
    int32_t *visits; // of this step
    double *sand;    // m^3 of sand that came by in this step
    double *mud;     // likewise of mud
    DeltaStep *path; // of each parcel of water, `longest` each
    int32_t *count;  // cells of each parcel's path; negative: it has not reached the edge
    int longest;
    uint8_t *out; // cells in which parcels end
} DeltaWork;

// What weighs a parcel's next step.
typedef struct DeltaPull {
    double inertia;      // share of the flow's direction; the rest is the slope of the surface
    bool squared;        // by the depth's square
    const double *x, *z; // direction of the flow
} DeltaPull;

// The way of a parcel from a cell, a draw in [0, 1) given; -1 if it is shut in.
int delta_next(const Delta *d, const DeltaPull *pull, int64_t cell, double draw);

// m of water over a cell.
double delta_depth(const Delta *d, int64_t i);

// Updates depth and speed of a cell whose bed or level has changed.
void delta_update(Delta *d, int64_t i);

// Finds where parcels end: at the edge, or SEA cells beyond the farthest shoal.
void delta_find_out(Delta *d);

// delta_water.c: routes the parcels of water and finds the level.
void delta_flow(Delta *d, const Run *run);

// delta_sediment.c: routes sand and mud.
void delta_carry(Delta *d, const DeltaRates *rates);
// Sand that moves rolls down the slopes of the bed beside its way.
void delta_roll(Delta *d, const DeltaRates *rates);

#endif
