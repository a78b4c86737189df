// How long a picture will take to trace, from a few of its paths.
#ifndef RAMIFY_RENDER_PROBE_H
#define RAMIFY_RENDER_PROBE_H

#include "base/run.h"
#include "render/integrator.h"

// Cost of one path by the pass that it belongs to. The first passes are dearer than later ones,
// because their waves are not full.
typedef struct PathCosts {
    double early[3]; // s of processor time a path, in the passes that end at 1, 4 and 16 samples
    double later;    // in all later ones
} PathCosts;

// Traces blocks of pixels on a grid over the crop, each pass as a rendering does. Progress stage
// "probe".
bool probe_paths(const Tracer *tracer, const Run *run, PathCosts *costs, Error *e);

// Processor seconds in which a pixel takes samples begin .. end - 1, the end of a pass.
double probe_pass_seconds(const PathCosts *costs, int begin, int end);

#endif
