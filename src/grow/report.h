// Reports on growth: why it stopped, and which roots have no attractor within reach.
#ifndef RAMIFY_GROW_REPORT_H
#define RAMIFY_GROW_REPORT_H

#include "grow/attractor_grid.h"
#include "grow/colonize.h"

// Fills report->nearest and report->root for a growth that never started: the initial node nearest
// to an attractor, identified by its root. False when cancelled.
bool reach_measure(const OutTree *tree, const PointSet *attractors, GrowReport *report,
                   const Run *run, Error *e);

// Fills report->unreached after growth and, if at least a tenth of all attractors are unreached,
// report->nearest and report->furthest (from a sample of 256).
void reach_measure_left(const OutTree *tree, const AttractorGrid *grid, int64_t attractors,
                        GrowReport *report);

// Warns about roots none of whose nodes has an attractor within influence, although others have,
// and names the parameter to change. pulled: the nodes with attractors after the first update.
// False when cancelled or out of memory.
bool reach_warn(const OutTree *tree, const ColonizeParams *params, const PointSet *attractors,
                const NodeBits *pulled, const Run *run, Error *e);

#endif
