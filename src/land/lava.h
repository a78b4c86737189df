// Lava flows on a landscape: a Bingham fluid, which moves only where thickness times the gradient
// of its surface exceeds its yield strength, in the thin-layer form of Dragoni et al. (1986) as
// used by MAGFLOW (Vicari et al. 2007). Heat is carried with the lava and lost from its surface;
// cold lava is stiffer (after Harris and Rowland 2001). So a flow is as thick as its slope demands,
// leaves levees at its sides, widens on gentle ground and ends in a steep front. Debris avalanches
// are the same without cooling.
#ifndef RAMIFY_LAND_LAVA_H
#define RAMIFY_LAND_LAVA_H

#include "land/landscape.h"

typedef struct LavaParams {
    double volume;     // m^3
    double rate;       // m^3 / s
    double yield;      // m: yield strength of hot lava / (density * gravity)
    double viscosity;  // m s: viscosity / (density * gravity)
    double stiffening; // ln of the yield strength's growth from hot to cold
    double cooling;    // m / s: thickness of lava that turns cold in unit time
    double roughness;  // 0..1: relative variation of the yield strength from sample to sample
    uint64_t seed;     // of that variation
} LavaParams;

// Lets lava flow from a vent at (x, z) until it rests, and adds it to the rock; it counts as risen,
// and what runs over a base or the rim as outflow. thickness: of all samples, m of this flow. The
// same bits for any number of threads.
bool lava_erupt(Landscape *land, const LavaParams *params, double x, double z, double *thickness,
                const Run *run, Error *e);

#endif
