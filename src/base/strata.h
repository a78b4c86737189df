// Beds of rock: which bed lies at a place in space. Beds are listed from the top down; the first
// goes on upward, the last downward without end. Dip, folds and faults move the whole stack up and
// down, by an amount that depends on the place in plan alone (similar folds, vertical faults), so
// thicknesses are vertical.
#ifndef RAMIFY_BASE_STRATA_H
#define RAMIFY_BASE_STRATA_H

#include "base/error.h"
#include "base/vec.h"

typedef struct StrataBed {
    float thickness; // m, vertical
    float hardness;  // 0 = clay, 1 = the hardest rock
    float slope;     // degrees: the steepest face that stands; 0 = by the hardness
    Vec3 color;      // reflectance
    float lamina;    // m: mean thickness of its laminae; 0 = without
    float ledge;     // m: how far the pattern badlands lets it stand out of the wall
} StrataBed;

// A vertical fault that strikes through a place; beds on the right of the strike lie lower.
typedef struct StrataFault {
    float at[2];   // shares of the size: x and z
    float azimuth; // degrees from north (-z), clockwise: of its strike
    float drop;    // m
} StrataFault;

typedef struct StrataFolds {
    float wavelength; // m; 0 = no folds
    float amplitude;  // m, from the mean to a crest
    float azimuth;    // degrees: the direction across the axes
} StrataFolds;

typedef struct StrataParams {
    StrataBed *beds;
    int bed_count; // 0 = no strata
    float dip;     // degrees below the horizontal
    float dip_azimuth;
    StrataFolds folds;
    StrataFault *faults;
    int fault_count;
    float top; // m: y of the top of the first bed in the middle
} StrataParams;

enum { STRATA_MOST_BEDS = 64, STRATA_MOST_FAULTS = 32 };

typedef struct StrataLine { // of a fault
    float x, z;             // a place on it
    float right_x, right_z; // unit: to its right
    float drop;
} StrataLine;

// Ready for looking up. Levels are heights above the top of the first bed, before the stack was
// moved: 0 at the top, negative below.
typedef struct Strata {
    int bed_count, fault_count;
    StrataBed bed[STRATA_MOST_BEDS];
    float floor[STRATA_MOST_BEDS];     // level of each bed's lower face; -INFINITY for the last
    double run[STRATA_MOST_BEDS + 1];  // see strata_run, at the upper face of each bed
    float steepness[STRATA_MOST_BEDS]; // tangent of the steepest slope that stands
    StrataLine fault[STRATA_MOST_FAULTS];
    Vec3 mean_color; // by thickness
    Vec3 origin;
    float fall_x, fall_z;              // of the dip, m per m
    float fold_x, fold_z, fold_height; // radians per m; m
} Strata;

// origin: the place, in the mesh's space, of the top of the first bed in the middle of the land;
// size: m, of the land's side. At most STRATA_MOST_BEDS beds and STRATA_MOST_FAULTS faults. Free
// with strata_free.
Strata *strata_new(const StrataParams *params, Vec3 origin, float size, Error *e);
Strata *strata_copy(const Strata *strata, Error *e);
void strata_free(Strata *strata); // NULL is fine

// m: by how much the stack is moved up at a place, with origin.y.
float strata_base(const Strata *strata, float x, float z);

// The bed at a level.
int strata_bed(const Strata *strata, float level);

// The horizontal distance, m, that the steepest stable profile through the beds takes from level 0
// to this one (negative below 0), and the level at such a distance. On the steepest stable profile,
// whatever its beds, run rises by 1 m per m: in it, land of many beds is land of one.
double strata_run(const Strata *strata, double level);
double strata_level(const Strata *strata, double run);

// Degrees: the steepest slope at which rock of a hardness stands; 32 of clay to 80 of hard rock.
float strata_stable_slope(float hardness);

#endif
