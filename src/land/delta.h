// River deltas: a reduced-complexity model of the flow and of sand and mud over a grid of cells,
// after DeltaRCM (Liang, Voller and Paola 2015, Earth Surface Dynamics 3, 67-86). Parcels of water
// walk from the river to the borders at random, weighted by the inertia of the flow, the slope of
// the water's surface and its depth; they tell the discharge, and their ways back from the sea the
// surface. Parcels of sand and mud follow the discharge, settle and scour. Channels build bars at
// their mouths, part around them, and shift.
//
// What the river brings stays or leaves, to rounding: through the borders, or far out from all that
// has been built so far. Random numbers are keyed
// by step and parcel, sums have one order: the same bits for any number of threads.
#ifndef RAMIFY_LAND_DELTA_H
#define RAMIFY_LAND_DELTA_H

#include "base/error.h"
#include "base/run.h"

#include <stdint.h>

// What a cell may become.
typedef enum DeltaCell {
    DELTA_OPEN,  // bed that the flow moves
    DELTA_PLAIN, // old land, never under water
    DELTA_TRUNK, // the river on the old land; its bed stays
    DELTA_EDGE   // where water leaves; its bed stays
} DeltaCell;

typedef struct DeltaRates {
    double sand;  // share of sand in what the river brings, 0..1; the rest is mud
    double rise;  // of the sea, m a step
    double bring; // volume a step, in depth * (width of the river)^2
} DeltaRates;

// Cells row by row; the river enters in row 0 and flows to higher rows. Speeds are in that of the
// river where it enters.
typedef struct Delta {
    int columns, rows;
    double cell;    // m
    double depth;   // m, of the river where it enters
    double slope;   // of its surface
    double sea;     // m, level
    uint64_t seed;  // of all draws
    int64_t step;   // steps so far
    uint8_t *kind;  // DeltaCell
    double *bed;    // m
    double *level;  // m, of the water, also where the ground stands out of it
    double *flow_x; // discharge a m of width, in that of the river: direction and amount
    double *flow_z;
    double *speed;
    double *mud;            // mean share of the river's mud that the water carries, of late
    double *water;          // likewise: parcels that came by
    int64_t *bared;         // step at which a cell was last under water that could scour it
    double given, left;     // m^3 of sand and mud so far: from the river, out to sea
    double mouth[2];        // cells: where the river enters the sea
    int32_t *inlet;         // cells in which water enters
    int inlets;             // their number: the river's width
    struct DeltaWork *work; // scratch
} Delta;

// All cells open, bed and level 0. ERROR_INPUT below 16 cells a side. Free with delta_free.
Delta *delta_new(int columns, int rows, double cell, Error *e);
void delta_free(Delta *d); // NULL is fine

// After kinds, bed, depth, slope and mouth are set: finds the inlets, fills the level and a first
// flow away from the mouth. ERROR_INPUT if no cell of the trunk is in row 0.
bool delta_begin(Delta *d, Error *e);

bool delta_run(Delta *d, const DeltaRates *rates, int64_t steps, const Run *run, Error *e);

static inline int64_t delta_count(const Delta *d)
{
    return (int64_t)d->columns * d->rows;
}

static inline int64_t delta_row(const Delta *d, int64_t i)
{
    return i / d->columns;
}

static inline int64_t delta_column(const Delta *d, int64_t i)
{
    return i % d->columns;
}

// m^3 of ground above the height 0, negative below.
double delta_volume(const Delta *d);

// Depth below which water does not flow, of that of the river.
#define DELTA_DRY 0.02

#endif
