// Ice on a landscape. It flows as the shallow ice approximation has it (Glen's law of exponent 3),
// gains and loses mass by its altitude, slides, and wears its bed in proportion to its sliding
// (Humphrey and Raymond 1994; Egholm et al. 2009). What it wears off is carried to where the ice
// ends.
//
// Steps are implicit: the obstacle problem surface >= bed is solved by projected Gauss-Seidel
// sweeps, red samples before black ones, so the bits do not depend on the number of threads.
#ifndef RAMIFY_LAND_GLACIER_H
#define RAMIFY_LAND_GLACIER_H

#include "land/landscape.h"

// Years and metres.
typedef struct GlacierParams {
    double line;     // m: altitude of the equilibrium line
    double gradient; // of the mass balance, per year
    double most;     // m / a: largest gain
    double steepest; // gradient of the ground from which snow slides off
    double erosion;  // m of rock per m of sliding
    double till;     // share of the worn rock that is laid down where the ice ends; the rest is
                     // fine and leaves with the water
} GlacierParams;

typedef struct Glacier {
    double *ice;  // m, of each sample of the landscape
    double *slip; // m / a: sliding speed in the last step
} Glacier;

Glacier *glacier_new(const Landscape *land, Error *e); // without ice
void glacier_free(Glacier *glacier);                   // NULL is fine

// Lets the ice flow for some years on a bed that stays.
bool glacier_flow(Glacier *glacier, const Landscape *land, const GlacierParams *params,
                  double years, const Run *run, Error *e);

// Wears the bed for some years at the present speed, clears rubble that lies under ice, and lays
// till down where the ice ends. Volume is conserved.
bool glacier_wear(Glacier *glacier, Landscape *land, const GlacierParams *params, double years,
                  Error *e);

#endif
