// Growth of a flat snow crystal from vapour on a hexagonal lattice: the mesoscopic model of Gravner
// and Griffeath (Modeling snow crystal growth II, Physica D 237, 2008).
#ifndef RAMIFY_GROW_AGGREGATE_SNOWFAKE_H
#define RAMIFY_GROW_AGGREGATE_SNOWFAKE_H

#include "base/run.h"

#include <stdint.h>

// The model's parameters, with the names of the paper. Masses are in the paper's unit.
typedef struct SnowfakeRates {
    float rho;   // vapour far away, per cell
    float beta;  // boundary mass at which a tip or a flat edge freezes on
    float alpha; // least boundary mass at which a concave corner freezes on where vapour is scarce
    float theta; // vapour around a cell below which it is scarce
    float kappa; // share of the vapour that freezes as it meets the crystal
    float mu;    // share of the boundary mass that evaporates in a step
    float gamma; // share of the ice at the boundary that evaporates in a step
} SnowfakeRates;

typedef struct SnowfakeParams {
    int radius; // cells from the middle to the farthest tip, at which it stops; 4 .. 4000
    const SnowfakeRates *life; // rates at equal steps of the crystal's radius, between which they
                               // are linear; borrowed
    int life_count;            // at least 1
    float noise;               // relative random variation of the vapour that meets the crystal
    uint64_t seed;
} SnowfakeParams;

// Cell (q, r) of axial coordinates, -radius .. radius each, is element
// (r + radius) * width + q + radius; its place is (q + r / 2, r sqrt(3) / 2) cells.
typedef struct Snowfake {
    int radius, width; // width = 2 radius + 1
    float *ice;        // mass of ice of each cell; 0 = none
    float *born;       // of each cell of ice: the time at which it froze, 0 .. 1 of all steps
    double
        mass_error; // relative change of all mass since the start, but for what came from outside
    int64_t steps;
} Snowfake;

// Grows a crystal. Masses are integers, so that it is symmetric to the bit without noise, and the
// same for any number of threads. ERROR_INPUT if it cannot reach the radius in that vapour;
// ERROR_CANCELLED.
bool snowfake_grow(const SnowfakeParams *params, const Run *run, Snowfake *fake, Error *e);

void snowfake_clear(Snowfake *fake);

// Rates between two, t = 0 .. 1.
SnowfakeRates snowfake_rates_between(const SnowfakeRates *a, const SnowfakeRates *b, float t);

// Number of steps from the middle to cell (q, r).
int snowfake_distance(int q, int r);

static inline int64_t snowfake_cell(const Snowfake *fake, int q, int r)
{
    return (int64_t)(r + fake->radius) * fake->width + q + fake->radius;
}

#endif
