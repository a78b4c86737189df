// A meandering river: a line of nodes that moves sideways by its curvature and by that upstream, as
// Howard and Knutson (1984) do for the linear flow of Ikeda, Parker and Sawai (1981). Bends grow,
// drift downstream, and are cut off at their necks.
#ifndef RAMIFY_LAND_MEANDER_H
#define RAMIFY_LAND_MEANDER_H

#include "base/error.h"
#include "base/run.h"

#include <stdint.h>

typedef struct MeanderNode {
    double x, z; // m
} MeanderNode;

// A bend that was cut off.
typedef struct Oxbow {
    MeanderNode *node;
    int64_t count;
    double time; // when
} Oxbow;

// The river flows along z and repeats: node i + count is node i, `length` further.
typedef struct Meander {
    double width, length; // m
    double reach;         // m to the hills on each side, which do not erode; 0 = there are none
    double contrast;      // 0..1, of the banks' erodibility
    uint64_t seed;        // of the erodibility
    double time;          // the bend of fastest growth grows e-fold in about 5
    MeanderNode *node;
    int64_t count, capacity;
    double *speed; // scratch: of each node, to the left of the flow
    Oxbow *oxbow;
    int64_t oxbows, oxbow_capacity;
} Meander;

// Growth at time 0 of a small wave of `wavelength` in widths, e-folds per unit of time.
double meander_growth(double wavelength);

// A line that is nearly straight, with `bend` widths of random bends. Free with meander_free.
Meander *meander_new(double width, double length, double bend, uint64_t seed, Error *e);
void meander_free(Meander *m); // NULL is fine

// Moves the nodes by one step of time, without cutoffs.
void meander_move(Meander *m, double step);
// Spaces nodes evenly, half a width apart.
bool meander_resample(Meander *m, Error *e);
// Cuts off bends whose necks are narrower than a channel and its banks, or, where the ground is
// soft, than three of them.
bool meander_cut(Meander *m, Error *e);
// All of these.
bool meander_run(Meander *m, double time, const Run *run, Error *e);

// Curvature that the flow has felt at each node, by that upstream, times the width; positive where
// the deep outer bank is on the left of the flow. bend: of m->count.
void meander_bends(const Meander *m, double *bend);

// Length of the river over that of the valley.
double meander_sinuosity(const Meander *m);
// Mean distance along the valley from bend to bend of the same hand, in widths; 0 = no bends.
double meander_wavelength(const Meander *m);
// Pairs of pieces that cross.
int64_t meander_crossings(const Meander *m);

#endif
