// What a meandering river has left on the samples of a plain: when its channel was there last,
// where it is now, and the bends that it has cut off.
#ifndef RAMIFY_OBJECTS_TERRAIN_MEANDER_TRACE_H
#define RAMIFY_OBJECTS_TERRAIN_MEANDER_TRACE_H

#include "land/height_field.h"
#include "land/meander.h"

// Distances are in half widths of the channel.
typedef struct MeanderTrace {
    const HeightField *field; // borrowed: its grid; the river repeats after its length
    const Vec2 *moved; // borrowed: m by which each sample is looked up elsewhere, which makes banks
                       // uneven; NULL = nowhere
    float most;        // m: the most of `moved` along x or z
    float *left;       // time at which the channel left; < 0 = it never came
    float *aside;      // to the middle of the river, positive on the left; INFINITY = far
    float *bend;       // there: meander_bends
    float *old;        // to the middle of a bend that was cut off; INFINITY = far
    float *open;       // half width of what water is left there; 0 = none
    float *filled;     // 0..2: how far it has been filled; 1 = no water is left
} MeanderTrace;

// The place at t, 0..1, between the second and the third of four nodes: a cubic through all of them
// (Catmull and Rom 1974).
MeanderNode meander_between(const MeanderNode node[4], double t);

// Nothing has left a trace yet. Free with meander_trace_free, also on failure.
bool meander_trace_new(MeanderTrace *trace, const HeightField *field, Error *e);
void meander_trace_free(MeanderTrace *trace);

// Lets the river wander for `time`, in which `left` is recorded.
bool meander_trace_run(MeanderTrace *trace, Meander *m, double time, const Run *run, Error *e);
// Records where the river is now, and the bends that it has cut off.
bool meander_trace_river(MeanderTrace *trace, const Meander *m, Error *e);
bool meander_trace_oxbows(MeanderTrace *trace, const Meander *m, Error *e);
// How many bends that were cut off still hold water.
int64_t meander_open_oxbows(const Meander *m);

#endif
