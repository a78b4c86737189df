// Grid points in and next to a body, and shortest paths within the body.
#ifndef RAMIFY_OBJECTS_FRACTURE_BODY_GRID_H
#define RAMIFY_OBJECTS_FRACTURE_BODY_GRID_H

#include "base/error.h"
#include "base/run.h"
#include "base/vec.h"

#include <stdint.h>

// Signed distance to the body, m, negative inside, clamped to +- a band of at least the grid's
// spacing. *outer: the distance to the outer surface alone, ignoring the hollow. Called from
// several threads.
typedef float (*BodyDistance)(const void *body, Vec3 p, float *outer);

typedef struct BodyGrid {
    Vec3 origin; // m: of point (0, 0, 0); the outermost points have no node
    float spacing;
    int64_t size[3];
    int32_t *node_at; // per point, z fastest: its node; -1 = none
    int32_t *point;   // per node: its point
    Vec3 *position;   // per node, m
    bool *surface;    // per node: within a spacing of the outer surface
    int32_t count;    // of nodes
} BodyGrid;

// The nodes: points inside the body or less than a spacing from it. ERROR_MEMORY if there are too
// many points. Zero on failure.
bool body_grid_new(BodyGrid *grid, BodyDistance distance, const void *body, Aabb box, float spacing,
                   const Run *run, Error *e);
void body_grid_clear(BodyGrid *grid);

// The cell about p: nodes at its eight corners (z fastest, -1 = none), and in t (may be NULL) the
// place in the cell, 0..1 an axis. False when no corner has a node.
bool body_grid_cell(const BodyGrid *grid, Vec3 p, int32_t corner[8], float t[3]);

// A source that spreads through the body: `cost` at `at`, rising with the distance from there.
typedef struct SpreadSource {
    Vec3 at;
    float cost;
    int32_t label;
    int32_t node; // start node
} SpreadSource;

typedef struct SpreadEntry {
    float cost;     // INFINITY = none
    int32_t source; // -1 = none
} SpreadEntry;

// Sets, for each node, the `kept` cheapest sources of different labels, cheapest first (Dijkstra's
// algorithm; entry holds count * kept). The cost is a source's own plus the straight distance, and
// grows by at least 0.8 of each step, so that paths around a bend cost more. order (count; may be
// NULL): nodes sorted by least cost; *reached (may be NULL): how many have one.
bool body_grid_spread(const BodyGrid *grid, const SpreadSource *source, int64_t source_count,
                      int kept, SpreadEntry *entry, int32_t *order, int32_t *reached,
                      const Run *run, Error *e);

#endif
