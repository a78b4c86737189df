// What growth tells people: why it stopped, and which roots have no attractor within reach.
#ifndef RAMIFY_GROW_REPORT_H
#define RAMIFY_GROW_REPORT_H

#include "grow/attractor_grid.h"
#include "grow/colonize.h"

// Fills report->nearest and report->root for a growth that never began: the initial node nearest to
// an attractor, named by its root.
void reach_measure(const OutTree *tree, const PointSet *attractors, GrowReport *report);

// Warns, naming the number to change, about roots none of whose nodes has an attractor within
// influence, though others have. pulled: the nodes with attractors after the first update.
void reach_warn(const OutTree *tree, const ColonizeParams *params, const PointSet *attractors,
                const NodeBits *pulled, const Run *run);

#endif
