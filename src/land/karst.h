// Limestone that water dissolves. Rain that sinks in lowers the surface, faster along joints and in
// depressions, where it flows together (anisotropic dissolution after Fleurant et al. 2008). Caves
// drain the hollows, so that pits are legitimate. Where a hollow has come down to the water table
// it cannot deepen; there water eats into the foot of the slopes instead, and the plain widens as a
// front at the speed of that corrosion (the eikonal equation). What stands too steep then falls.
#ifndef RAMIFY_LAND_KARST_H
#define RAMIFY_LAND_KARST_H

#include "land/landscape.h"

typedef struct KarstRates {
    double lowering;  // m per unit of time: of level rock of weakness 1
    double focus;     // by how much a hollow as deep as `reach` dissolves faster
    double reach;     // m: from where recharge flows together
    double rounding;  // per unit of time: how much edges weather; 0 = not at all
    double edge;      // m: the size of the edges that do
    double corrosion; // m per unit of time: by which the foot of a slope of weakness 1 retreats
} KarstRates;

// Dissolves the rock down to the water table at height 0 over `time`, in equal steps. reached: of
// each sample, when it comes to the water table; before, INFINITY, or 0 where water already stands
// (a river's plain). Dissolved rock counts as outflow.
bool karst_dissolve(Landscape *land, const KarstRates *rates, double time, int steps,
                    double *reached, const Run *run, Error *e);

// Lets rock fall that stands steeper than its beds bear. steepness: a factor on them, of each
// sample. Rock that falls is dissolved: outflow. Needs land->strata.
bool karst_fell(Landscape *land, const double *steepness, Error *e);

// Takes blocks off edges of this size, m, so many times: outflow.
bool karst_round(Landscape *land, double edge, int times, const Run *run, Error *e);

// Lowers values to the greatest ones whose gradient nowhere exceeds that of the sample: arrival
// times of a front for times and slowness, heights for heights and slopes (upwind differences).
bool karst_bound_gradient(const double *gradient, int side, double cell, double *value, Error *e);

#endif
