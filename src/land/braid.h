// A braided river on its plain of gravel, by a simplified depth-averaged flow over a bed that it
// moves (in the spirit of Murray and Paola 1994 and of Nicholas 2010). Water follows the local
// inertial form of the shallow water equations (Bates et al. 2010, with the damping of de Almeida
// et al. 2012) with Chezy friction; gravel moves as bed load by the excess of shear stress,
// deflected down the slope of the bed, which also makes banks cave in.
//
// The river recirculates: the last row flows into the first, a fall of slope * rows * cell lower.
// Volume of gravel is constant to rounding; each cell is updated from its neighbours alone: the
// same bits for any number of threads.
#ifndef RAMIFY_LAND_BRAID_H
#define RAMIFY_LAND_BRAID_H

#include "base/run.h"

#include <stdint.h>

// Columns from `begin` to before `end`; none if they are equal.
typedef struct BraidSpan {
    int begin, end;
} BraidSpan;

// A square of side * side cells, row by row; rows follow one another downstream, columns go across.
typedef struct Braid {
    int side;
    double cell;     // m
    double slope;    // fall of the plane that heights are measured from, along the rows
    double mean;     // m: depth of the forming flow if it ran evenly over `width`
    double width;    // m, of the plain
    double *bed;     // m above the inclined plane
    float *depth;    // m of water
    float *flow_x;   // m^2/s through the west side of each cell; that of column 0 is closed
    float *flow_z;   // m^2/s through the north side
    float *shear;    // shear stress over that of the even flow
    float *age;      // turnovers since water moved the gravel
    float *erodible; // 0 = rock that nothing moves, 1 = loose gravel
    float *ground;   // work: the bed
    float *next_x;   // work: flows after a step
    float *next_z;
    float *share;    // work: of the outflow that a cell can give
    float *load;     // work: bed load along x of all cells, then along z, then its amount
    BraidSpan *span; // work, of each row: where water may be; all else is dry and at rest
    BraidSpan *wet;  // work, of each row: where it is
} Braid;

typedef struct BraidRates {
    double discharge; // share of the forming discharge
    double turnovers; // time: one moves a bank `mean / slope` long by that length
    bool moves;       // false = water alone
} BraidRates;

// Dry, at height 0, all of it loose. Free with braid_free.
Braid *braid_new(int side, double size, double width, double slope, double mean, Error *e);
void braid_free(Braid *braid); // NULL is fine

// The same river on twice as many cells a side; the volume of gravel is the same.
Braid *braid_refined(const Braid *braid, Error *e);

// Lets it flow. *stage names the work to the progress.
bool braid_run(Braid *braid, const BraidRates *rates, const Run *run, Error *e);

// m^3 of gravel above the inclined plane, and m^3 of water.
double braid_volume(const Braid *braid);
double braid_water(const Braid *braid);

// m^3/s through the whole width, mean of all rows; that of the forming flow.
double braid_discharge(const Braid *braid);
double braid_forming_discharge(const Braid *braid);

// Shear stress, as a share of the even flow's, that just moves gravel.
#define BRAID_THRESHOLD 0.7

static inline int64_t braid_count(const Braid *braid)
{
    return (int64_t)braid->side * braid->side;
}

#endif
