// What growth tells people: why it stopped, and which roots have no attractor within reach.
#ifndef RAMIFY_GROW_REPORT_H
#define RAMIFY_GROW_REPORT_H

#include "grow/attractor_grid.h"
#include "grow/colonize.h"

// Fills report->nearest and report->root for a growth that never began: the initial node nearest to
// an attractor, named by its root. false when interrupted.
bool reach_measure(const OutTree *tree, const PointSet *attractors, GrowReport *report,
                   const Run *run, Error *e);

// Fills report->unreached after growth, and where they are a tenth of all attractors or more,
// report->nearest and report->furthest as well (of 256 of them).
void reach_measure_left(const OutTree *tree, const AttractorGrid *grid, int64_t attractors,
                        GrowReport *report);

// Warns, naming the number to change, about roots none of whose nodes has an attractor within
// influence, though others have. pulled: the nodes with attractors after the first update. false
// when interrupted or out of memory.
bool reach_warn(const OutTree *tree, const ColonizeParams *params, const PointSet *attractors,
                const NodeBits *pulled, const Run *run, Error *e);

#endif
