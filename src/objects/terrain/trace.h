// Traces painted lines: the middle lines of the bright parts of a picture, as an out-tree.
#ifndef RAMIFY_OBJECTS_TERRAIN_TRACE_H
#define RAMIFY_OBJECTS_TERRAIN_TRACE_H

#include "image/image.h"
#include "outtree/out_tree.h"

// Where a connected drawing has its root.
typedef enum TraceRoot {
    TRACE_WIDEST, // where its line is widest
    TRACE_RIM     // nearest to the picture's rim
} TraceRoot;

// Thins the pixels brighter than 0.5 (darker with invert) to lines of one pixel (Zhang and Suen
// 1984), which shortest paths from the root make a tree; a loop is opened where it is farthest from
// the root. Positions: (x, 0, z) in pixels from the top left corner, z down; radii: half the line's
// width, px. Each connected drawing is a colony. grey has one channel. ERROR_INPUT when nothing or
// more than half is painted, or the picture is too large; ERROR_CANCELLED. The caller frees the
// tree.
OutTree *trace_lines(const Image *grey, bool invert, TraceRoot root, uint64_t seed, const Run *run,
                     Error *e);

#endif
