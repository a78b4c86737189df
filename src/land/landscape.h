// Land that changes with time: bedrock in beds and loose sediment on it, worn by streams and by
// slopes. Streams erode by the stream power law and drop what they carry in proportion to their
// load (Davy and Lague 2009, in the form of Yuan et al. 2019), solved from the outlets up (Braun
// and Willett 2013). Slopes weather back bed by bed, rock steeper than its bed bears falls, rubble
// slides to its angle of repose, and soil creeps.
//
// Volume is conserved: rock + sediment + outflow - uplift stay the same. All sums have one order:
// the same bits for any number of threads.
#ifndef RAMIFY_LAND_LANDSCAPE_H
#define RAMIFY_LAND_LANDSCAPE_H

#include "base/run.h"
#include "base/strata.h"
#include "land/height_field.h"

// A square grid of side * side samples, row by row; arrays of all samples.
typedef struct Landscape {
    int side;
    double cell;           // m between samples
    double corner;         // m: x and z of sample 0
    double *rock;          // m: y of the bedrock's surface
    double *loose;         // m: thickness of the sediment on it
    double *load;          // m^3: sediment that passed in the last step
    uint8_t *base;         // 1 = water and sediment leave here; only landscape_set_base moves it
    float *weakness;       // factor on the erodibility of rock
    float *stack;          // m: strata_base of the sample; 0 without strata
    const Strata *strata;  // borrowed; NULL = one bed of hardness 0.5
    double outflow;        // m^3 that has left
    double uplifted;       // m^3 that has risen
    struct Routing *route; // of the water; NULL = not yet found
} Landscape;

// Per unit of time, which is the caller's.
typedef struct LandscapeRates {
    double uplift;       // m, where the land is not a base
    double incision;     // K of rock of hardness 0, for E = K sqrt(area) slope
    double loose;        // K of sediment
    double least_area;   // m^2: below about this catchment water does not gather to a stream
    double debris;       // K of debris flows, for E = K area^1/4 (slope - that of rest); 0 = none
    double least_debris; // m^2: below about this catchment debris does not gather
    double joints;       // by how much weak rock stands less steep, and strong rock steeper; 0..1
    double deposition;   // G of Yuan et al.: 0 = all that is eroded leaves, 1 = much is dropped
    double retreat;      // m: by how much a face of rock of hardness 0 weathers back
    double rubble; // share of weathered and fallen rock that stays as rubble; the rest is fine
                   // and leaves with the water
    double repose; // tangent of rubble's angle of repose
    double wash;   // share of the loose cover that weathers to fines and leaves
    double soil;   // m: rock that turns to soil on bare ground
    double creep;  // m^2: diffusivity of soil
    uint64_t seed; // of the water's choice among nearly equal ways
} LandscapeRates;

// Rock at height 0, no sediment, no base. size: m, of the side. Free with landscape_free.
Landscape *landscape_new(int cells, double size, const Strata *strata, Error *e);
void landscape_free(Landscape *land); // NULL is fine

// The same land with twice as many cells a side, weakness and base not yet set. Rock is
// interpolated along the stable profile of its beds (strata_run), so that cliffs and benches stay
// sharp.
Landscape *landscape_refined(const Landscape *land, const Run *run, Error *e);

// Scales heights and volumes so that the highest rock is at `relief`, m; returns the factor (1 for
// flat land). A change of units, not of the land, where the processes are linear in heights.
double landscape_scale_relief(Landscape *land, double relief);

// Lets rock fall that stands steeper than `slope`, a tangent, over any distance: no sample is
// higher than another by more than the slope allows along the grid's eight directions. What falls
// leaves.
void landscape_fell(Landscape *land, double slope);

// The same along the slope's own direction and its beds: `factor` times as steep as each bed bears
// (land->strata; without, as 45 degrees). Walls become planes, and edges sharp. ERROR_MEMORY.
bool landscape_limit_slopes(Landscape *land, double factor, Error *e);

// Rock creeps as soil does: diffusion, m^2, is the diffusivity times the time. ERROR_MEMORY.
bool landscape_round(Landscape *land, double diffusion, const Run *run, Error *e);

// What streams leave on the floors of valleys.
typedef struct LandscapeWash {
    double slope;      // of the floor of a stream that drains a hectare; others by area^-1/4
    double least_area; // m^2: of streams with a floor
    double across;     // slope of the floor toward its stream
    uint64_t seed;     // as LandscapeRates.seed
} LandscapeWash;

// Fills valleys with sediment until their floors are as steep as their streams need, out of what
// has left the land. All samples then drain over falling ways.
bool landscape_lay_wash(Landscape *land, const LandscapeWash *wash, const Run *run, Error *e);

// Finds anew where the beds of land->strata lie.
void landscape_lay_stack(Landscape *land);

// Makes sample i a base and moves its surface to this height. What is removed counts as outflow.
void landscape_set_base(Landscape *land, int64_t i, double height);

// One step. The water's ways are found anew if `reroute`, and in the first step.
bool landscape_step(Landscape *land, const LandscapeRates *rates, double time, bool reroute,
                    const Run *run, Error *e);

// The part of a step that uplift and streams have in it; the water's ways are found anew.
bool landscape_cut_streams(Landscape *land, const LandscapeRates *rates, double time,
                           const Run *run, Error *e);

// The part of a step that slopes have in it: weathering, rockfall, rubble and soil, no water.
bool landscape_slopes_only(Landscape *land, const LandscapeRates *rates, double time,
                           const Run *run, Error *e);

// The surface at a place, m, and the thickness of the sediment there: between samples, rock follows
// the stable profile.
double landscape_at(const Landscape *land, double x, double z, double *loose);

// Rock and sediment above height 0, with what has left, less what has risen: constant, m^3.
double landscape_volume(const Landscape *land);

// The surface as heights. The caller frees it.
HeightField *landscape_heights(const Landscape *land, Error *e);

// How fast rock of a hardness erodes, and how fast its faces weather back, relative to hardness 0.
double landscape_erodibility(double hardness);

static inline int64_t landscape_count(const Landscape *land)
{
    return (int64_t)land->side * land->side;
}

#endif
