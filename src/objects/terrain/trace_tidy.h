// What tracing of painted lines leaves in a tree of pixels, removed: side branches at the steps of
// the paint's edge, widths that swell where lines meet, and the steps of pixels themselves.
#ifndef RAMIFY_OBJECTS_TERRAIN_TRACE_TIDY_H
#define RAMIFY_OBJECTS_TERRAIN_TRACE_TIDY_H

#include "outtree/out_tree.h"

// tree: in pixels, with half the line's width as radius of each node; children after parents.
bool trace_tidy(OutTree *tree, Error *e);

#endif
