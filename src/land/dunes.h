// Dunes: sand that the wind carries over a bare plain, in a square that repeats in both directions.
// A continuum model (Kroy, Sauermann and Herrmann 2002; Schwaemmle and Herrmann 2003; Duran and
// Herrmann 2006): the shear stress of a turbulent boundary layer over the dunes and the bubbles of
// separated air behind their brinks, a flux of sand that lags behind its saturated value by the
// saturation length, and slopes that slide at the angle of repose.
//
// The wind brings in on one side what it carries out on the other: the volume of sand is constant.
// All sums have one order: the same bits for any number of threads.
#ifndef RAMIFY_LAND_DUNES_H
#define RAMIFY_LAND_DUNES_H

#include "base/fft.h"
#include "base/run.h"

// A square grid of side * side samples, row by row; sample (0, 0) follows sample (side, side).
typedef struct Dunes {
    int side;         // a power of two
    double cell;      // m between samples
    double *sand;     // m above the plain, at least 0 but for rounding
    double *envelope; // m: the dunes with the bubbles behind them, of the last wind
    double *shear;    // 2 a sample: along the wind and across it; 1 = that over a plain
    double *flux;     // work: what arrives at each sample
    Complex *wave;    // work: spectrum
    Complex *root;    // of the transform
    double *seam;     // flux through the border at which the wind's sweep starts, one a line
    double blown[2];  // direction of the wind that `seam` belongs to; 0 = none
} Dunes;

// Unit of time: a saturated wind over a plain carries 1 m^3 a m of width in it.
typedef struct DuneWind {
    double x, z;       // unit: where it blows to
    double threshold;  // shear stress that just moves sand, share of the stress over a plain
    double saturation; // m: length in which the flux follows its saturated value
} DuneWind;

// Flat, without sand. side: a power of two. Free with dunes_free.
Dunes *dunes_new(int side, double size, Error *e);
void dunes_free(Dunes *dunes); // NULL is fine

// The same sand with twice as many samples a side, its volume the same.
Dunes *dunes_refined(const Dunes *dunes, Error *e);

// Blows for a time, in as many steps as it takes; slopes above the tangent `repose` slide after
// each step.
bool dunes_blow(Dunes *dunes, const DuneWind *wind, double time, double repose, const Run *run,
                Error *e);

// Fills envelope and shear for the sand as it is (dunes_wind.c): steps that dunes_blow begins with.
bool dunes_find_shear(Dunes *dunes, const DuneWind *wind, const Run *run, Error *e);

// Takes the grid's steps out of crests that run across it at an angle; profiles across the crests
// and the volume stay. (dunes_straighten.c)
bool dunes_straighten(Dunes *dunes, const Run *run, Error *e);

// Lets slopes above the tangent slide, in that many sweeps. (dunes_slide.c)
bool dunes_slide(Dunes *dunes, double repose, int sweeps, const Run *run, Error *e);

// m^3.
double dunes_volume(const Dunes *dunes);

// The surface at a place, m; x and z in m from sample (0, 0), any.
double dunes_at(const Dunes *dunes, double x, double z);

// The longest step that is stable, in units of time.
double dunes_step_limit(const Dunes *dunes, const DuneWind *wind);

static inline int64_t dunes_count(const Dunes *dunes)
{
    return (int64_t)dunes->side * dunes->side;
}

// Shear stress over a low hill of wave number k: SHEAR_GAIN (|k| + i SHEAR_SHIFT k) h.
#define DUNES_SHEAR_GAIN 3.4
#define DUNES_SHEAR_SHIFT 0.46

#endif
