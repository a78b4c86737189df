// Shared by the parts of the dunes. Private to them.
#ifndef RAMIFY_LAND_DUNES_PARTS_H
#define RAMIFY_LAND_DUNES_PARTS_H

#include "land/dunes.h"

#include <math.h>

// The grid as a wind crosses it: line after line, along the axis that is nearest to the wind. From
// one line to the next the wind drifts by `drift` places to the side.
typedef struct Crossing {
    int side;
    bool by_column, backward;
    double drift;  // places a line, -1..1
    double length; // m of the wind's way from one line to the next
    double along;  // component of the wind's direction along its axis, positive
} Crossing;

static inline Crossing crossing_of(const Dunes *dunes, const DuneWind *wind)
{
    bool by_column = fabs(wind->x) >= fabs(wind->z);
    double major = by_column ? wind->x : wind->z, minor = by_column ? wind->z : wind->x;
    return (Crossing){.side = dunes->side,
                      .by_column = by_column,
                      .backward = major < 0.0,
                      .drift = minor / fabs(major),
                      .length = dunes->cell / fabs(major),
                      .along = fabs(major)};
}

// Small grids are faster on one thread; the bits are the same.
static inline int dunes_threads(const Dunes *dunes, const Run *run)
{
    return dunes->side < 128 ? 1 : run->threads;
}

// Index of a sample; lines and places of any size wrap around.
static inline int64_t crossing_index(const Crossing *c, int64_t line, int64_t place)
{
    int64_t mask = c->side - 1;
    line = (c->backward ? -line : line) & mask;
    place &= mask;
    return c->by_column ? place * c->side + line : line * c->side + place;
}

// What a wind's way meets on a line, between two places.
static inline double crossing_at(const Crossing *c, const double *field, int64_t line, double place)
{
    double low = floor(place), t = place - low;
    int64_t k = (int64_t)low;
    return (1.0 - t) * field[crossing_index(c, line, k)] +
           t * field[crossing_index(c, line, k + 1)];
}

// dunes_slide.c: what the wind moves creeps down the slope, by `creep` (units of time) times its
// flux and the slope; then slopes above the repose slide.
bool dunes_settle(Dunes *dunes, double creep, double repose, int sweeps, const Run *run, Error *e);

#endif
