// Waves that cut a coast into a landscape: the front of the sea moves into the land like a wave of
// its own (the eikonal equation), at the speed that the waves' energy there and the rock allow
// (Sunamura 1992). What it reaches falls to high water and is planed down as a shore platform
// (Trenhaile 2000); the cliff above falls by the rules of slopes. A share of the rock becomes sand,
// which gathers where the waves are weak and covers the cliff's foot there (Limber and Murray
// 2011).
//
// Mean sea level is at height 0. A height field has no caves and no arches. Volume is conserved:
// landscape_volume + Shore.pool stays the same. The same bits for any number of threads.
#ifndef RAMIFY_LAND_SHORE_H
#define RAMIFY_LAND_SHORE_H

#include "land/landscape.h"

typedef struct ShoreParams {
    int sea_x, sea_z;   // the border on which the sea lies: one of them 1 or -1, the other 0
    double waves;       // degrees: where waves come from, clockwise from that side
    double wave_height; // m
    double tide;        // m from low to high water
    double grain;       // m: diameter of the sand's
    double sand;        // share of the rock that waves cut that stays as sand
    double speed;       // m per unit of time: retreat of rock of hardness 0.5 and weakness 1 on a
                        // straight shore across the waves
} ShoreParams;

// The waves' energy, on a grid of at most SHORE_WAVE_CELLS a side, rows from the sea inland.
typedef struct ShoreWaves {
    int side, stride; // stride: samples of the landscape per cell
    float *open;      // 0..1: share of sea
    float *land;      // 0..1: share of land around, within a tenth of the side
    float *energy;    // 1 = the open sea's
    float *shore;     // energy that refraction leaves at the shore nearby, smoothed along it
    float *flux[2];   // its mean direction along x and z, as long as energy where all come from one
} ShoreWaves;

enum { SHORE_WAVE_CELLS = 256 };

// Arrays of all samples of the landscape.
typedef struct Shore {
    ShoreParams params;
    double high;      // m: high water, where the cliff's foot lies
    double base;      // m of depth over which the waves' work on the rock fades by e
    double slope;     // tangent of the platform's slope at the cliff's foot
    double berm;      // m: top of a beach in the open
    double *front;    // m to the front of the sea: positive on land, negative once reached
    float *speed;     // m per unit of time, of the front
    float *soft;      // speed of the rock at sea level relative to that of hardness 0.5
    double *sand;     // m: depth of the beach
    double pool;      // m^3 of sand that is not yet part of the landscape
    double beach;     // m: width of a beach where waves have no energy
    ShoreWaves waves; // of the last step
} Shore;

// The caller sets front, for a sea that has not cut yet. Free with shore_free.
Shore *shore_new(const ShoreParams *params, const Landscape *land, Error *e);
void shore_free(Shore *shore); // NULL is fine

// The same shore on a landscape of twice as many cells a side.
Shore *shore_refined(const Shore *shore, const Landscape *finer, Error *e);

// Waves cut for a time, at most for shore_step_limit; slopes: how cliffs weather and fall in it.
bool shore_step(Shore *shore, Landscape *land, const LandscapeRates *slopes, double time,
                const Run *run, Error *e);
double shore_step_limit(const Shore *shore, const Landscape *land);

// Makes the beach part of the landscape's sediment; what has no room is lost to the deep.
bool shore_lay_beach(Shore *shore, Landscape *land, const Run *run, Error *e);

// m: the platform x m from the cliff that retreats over uniform rock.
double shore_platform(const Shore *shore, double x);

// Tangent of a beach's slope under waves of this energy (Sunamura 1984).
double shore_beach_slope(const ShoreParams *params, double energy);

#endif
