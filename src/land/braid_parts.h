// Shared by the parts of the braided river. Private to them.
#ifndef RAMIFY_LAND_BRAID_PARTS_H
#define RAMIFY_LAND_BRAID_PARTS_H

#include "land/braid.h"

#include <math.h>

#define BRAID_GRAVITY 9.81
#define BRAID_FROUDE 0.6      // of even flow: sets the friction, slope / Froude^2
#define BRAID_CORRECTION 0.02 // share of a wrong discharge that an update corrects
#define BRAID_CHANGE 0.1      // see braid_change
#define BRAID_DEFLECTION 0.03 // of the load by the slope across it, times the slope of the valley
#define BRAID_SPIRAL 11.0     // of the load in bends, times depth over radius: Rozovskii 1957
#define BRAID_REFERENCE 3.0   // shear of the reference load
#define BRAID_DRY 0.01        // mean depths: less water does not flow

#define BRAID_SLIDE 2.0 // see braid_change
#define BRAID_ROOTS 0.7 // share of a bank's retreat that roots hold back in the end
#define BRAID_MOST 5.0  // shear above which load grows no more, so that updates stay stable

enum { BRAID_FLOW_STEPS = 4 }; // of the water for one update of the bed

// Mean depths by which the reference load changes a cell in an update: less on fine grids, where
// gravel that slides down a bank crosses a cell sooner.
static inline double braid_change(const Braid *b)
{
    double cells = b->mean / (b->slope * b->cell); // over which the flow answers to its bed
    return fmin(BRAID_CHANGE, BRAID_SLIDE / cells);
}

// Turnovers in an update of the bed.
static inline double braid_update_turnovers(const Braid *b)
{
    return braid_change(b) * b->cell * b->slope / b->mean;
}

// Bed load of a shear stress: Meyer-Peter and Mueller's excess to the power 3/2.
static inline float braid_load_of(float shear)
{
    float most = (float)BRAID_MOST, bounded = shear < most ? shear : most;
    float excess = bounded - (float)BRAID_THRESHOLD;
    excess = excess > 0.0f ? excess : 0.0f;
    return excess * sqrtf(excess);
}

// braid_span.c: fills b->ground and finds the water, after a change of bed, depth or flow from
// outside.
void braid_begin(Braid *b);
// The columns of a row beyond which it is dry and at rest, among those of `among`.
BraidSpan braid_wet_span(const Braid *b, BraidSpan among, int row);
// Widens the spans to where the water can come in a step, and gravel in an update. They never
// shrink, so what lies outside stays zero in all arrays of the flow and its load.
void braid_widen(Braid *b);

// braid_flow.c: the longest stable step, s; one step of the water.
float braid_step_limit(const Braid *b);
void braid_flow(Braid *b, float step, int threads);

// braid_bed.c: fills shear and load of the flow; moves this load for one update.
void braid_find_load(Braid *b, int threads);
void braid_move_bed(Braid *b, int threads);

#endif
