// The flow of a delta: discharge and surface from parcels of water.
#include "base/random.h"
#include "land/delta_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STREAM_WATER = 1, SWEEPS = 4 };

// g * slope * cell / speed^2 of Liang et al., eq. (3), a constant at their scale.
static const double SURFACE_PULL = 0.15;
static const double NEW_FLOW = 0.2;  // share of a step in the mean discharge
static const double NEW_LEVEL = 0.2; // likewise of the surface
static const double SMOOTH = 0.12;   // of a sweep over the surface, each neighbour's share
static const double NEW_MEAN = 0.02; // of a step in what the water carried of late

// ---- walks

// Walks a parcel to the edge. Returns the number of cells of its path, negative if it ends inside.
static int walk(const Delta *d, int parcel, DeltaStep *path)
{
    DeltaPull pull = {.inertia = 1.0 - SURFACE_PULL, .x = d->flow_x, .z = d->flow_z};
    uint64_t key = random_key(random_key(d->seed, STREAM_WATER), (uint64_t)d->step);
    key = random_key(key, (uint64_t)parcel);
    int64_t cell = d->inlet[parcel % d->inlets];
    int k = DELTA_SOUTH; // the first step leaves the first row
    for (int n = 0; n < d->work->longest; n++) {
        path[n].cell = (int32_t)cell;
        if (d->work->out[cell]) {
            return n + 1;
        }
        if (n > 0) {
            k = delta_next(d, &pull, cell, (double)random_unit(random_key(key, (uint64_t)n)));
        }
        if (k < 0) {
            return -(n + 1);
        }
        path[n].way = k;
        cell += (int64_t)delta_ways[k].row * d->columns + delta_ways[k].column;
    }
    return -d->work->longest;
}

static void walk_all(Delta *d, const Run *run)
{
    DeltaWork *w = d->work;
    (void)run;
#pragma omp parallel for schedule(dynamic, 16) num_threads(run->threads)
    for (int parcel = 0; parcel < DELTA_WATERS; parcel++) {
        w->count[parcel] = walk(d, parcel, w->path + (int64_t)parcel * w->longest);
    }
}

// Cuts the loops out of a path, which a parcel may walk in an eddy without an end. Returns the
// number of cells left.
static int cut_loops(Delta *d, DeltaStep *path, int count)
{
    int32_t *at = d->work->visits; // of each cell: its place in the path + 1
    int kept = 0;
    for (int n = 0; n < count; n++) {
        int32_t cell = path[n].cell;
        int before = at[cell];
        for (int k = before; before > 0 && k < kept; k++) {
            at[path[k].cell] = 0;
        }
        kept = before > 0 ? before - 1 : kept;
        path[kept++] = path[n];
        at[cell] = kept;
    }
    for (int n = 0; n < kept; n++) {
        at[path[n].cell] = 0;
    }
    return kept;
}

static void cut_all_loops(Delta *d)
{
    DeltaWork *w = d->work;
    memset(w->visits, 0, (size_t)delta_count(d) * sizeof *w->visits);
    for (int parcel = 0; parcel < DELTA_WATERS; parcel++) {
        int cells = w->count[parcel];
        int kept = cut_loops(d, w->path + (int64_t)parcel * w->longest, abs(cells));
        w->count[parcel] = cells < 0 ? -kept : kept;
    }
}

// ---- discharge

static void add_ways(Delta *d, const DeltaStep *path, int count)
{
    DeltaWork *w = d->work;
    for (int n = 0; n < count; n++) {
        int64_t cell = path[n].cell;
        w->visits[cell]++;
        if (n > 0) { // of the step to the cell
            w->x[cell] += delta_ways[path[n - 1].way].x;
            w->z[cell] += delta_ways[path[n - 1].way].z;
        }
        if (n + 1 < count) { // and of that from it
            w->x[cell] += delta_ways[path[n].way].x;
            w->z[cell] += delta_ways[path[n].way].z;
        }
    }
}

static void find_discharge(Delta *d)
{
    DeltaWork *w = d->work;
    int64_t count = delta_count(d);
    memset(w->x, 0, (size_t)count * sizeof *w->x);
    memset(w->z, 0, (size_t)count * sizeof *w->z);
    memset(w->visits, 0, (size_t)count * sizeof *w->visits);
    for (int parcel = 0; parcel < DELTA_WATERS; parcel++) {
        int cells = w->count[parcel];
        add_ways(d, w->path + (int64_t)parcel * w->longest, abs(cells));
    }
    double each = (double)d->inlets / DELTA_WATERS; // share of the river's discharge a cell
    for (int64_t i = 0; i < count; i++) {
        double length = sqrt(w->x[i] * w->x[i] + w->z[i] * w->z[i]);
        double flow = length > 0.0 ? NEW_FLOW * w->visits[i] * each / length : 0.0;
        d->flow_x[i] = (1.0 - NEW_FLOW) * d->flow_x[i] + flow * w->x[i];
        d->flow_z[i] = (1.0 - NEW_FLOW) * d->flow_z[i] + flow * w->z[i];
        d->water[i] += NEW_MEAN * (w->visits[i] * each - d->water[i]);
    }
}

// ---- surface

// The surface rises upstream by friction, in proportion to speed^2 / depth, along the flow.
static double rise(const Delta *d, DeltaStep step)
{
    double depth = d->work->depth[step.cell], speed = d->speed[step.cell];
    double x = d->flow_x[step.cell], z = d->flow_z[step.cell];
    if (!(speed > 0.0)) { // no flow
        return 0.0;
    }
    const DeltaWay *way = &delta_ways[step.way];
    double along = (x * way->x + z * way->z) / (sqrt(x * x + z * z) * way->near);
    double friction = speed * speed * d->depth / depth;
    return along > 0.0 ? d->slope * d->cell * along * (friction < 2.0 ? friction : 2.0) : 0.0;
}

static void sum_levels(Delta *d)
{
    DeltaWork *w = d->work;
    memset(w->sum, 0, (size_t)delta_count(d) * sizeof *w->sum);
    memset(w->visits, 0, (size_t)delta_count(d) * sizeof *w->visits);
    for (int parcel = 0; parcel < DELTA_WATERS; parcel++) {
        const DeltaStep *path = w->path + (int64_t)parcel * w->longest;
        double level = d->sea;
        for (int n = w->count[parcel] - 1; n >= 0; n--) {
            int64_t cell = path[n].cell;
            if (n + 1 < w->count[parcel]) {
                level += rise(d, path[n]);
            }
            w->sum[cell] += level;
            w->visits[cell]++;
        }
    }
}

static bool is_inside(const Delta *d, int64_t i)
{
    int64_t column = i % d->columns, row = i / d->columns;
    return column > 0 && row > 0 && column + 1 < d->columns && row + 1 < d->rows;
}

// Evens out the surface between cells with water; ground takes that of the highest water beside it
// that would cover it, so that it can be flooded.
static void smooth_level(Delta *d)
{
    DeltaWork *w = d->work;
    for (int64_t i = 0; i < delta_count(d); i++) {
        w->sum[i] = d->level[i];
        if (d->kind[i] == DELTA_PLAIN || !is_inside(d, i)) {
            continue;
        }
        bool wet = w->depth[i] > 0.0;
        double change = 0.0, highest = d->sea;
        for (int k = 0; k < DELTA_WAYS; k++) {
            int64_t n = i + (int64_t)delta_ways[k].row * d->columns + delta_ways[k].column;
            if (w->depth[n] > 0.0) {
                change += SMOOTH * (d->level[n] - d->level[i]);
                highest = d->level[n] > highest ? d->level[n] : highest;
            }
        }
        w->sum[i] = wet ? d->level[i] + change : highest;
    }
    memcpy(d->level, w->sum, (size_t)delta_count(d) * sizeof *w->sum);
}

static void find_level(Delta *d)
{
    DeltaWork *w = d->work;
    sum_levels(d);
    for (int64_t i = 0; i < delta_count(d); i++) {
        if (d->kind[i] == DELTA_EDGE) {
            d->level[i] = d->sea;
        } else if (w->visits[i] > 0) {
            d->level[i] += NEW_LEVEL * (w->sum[i] / w->visits[i] - d->level[i]);
        }
        d->level[i] = fmax(d->level[i], d->sea);
        delta_update(d, i);
    }
    for (int n = 0; n < SWEEPS; n++) {
        smooth_level(d);
        for (int64_t i = 0; i < delta_count(d); i++) {
            w->depth[i] = delta_depth(d, i);
        }
    }
    for (int64_t i = 0; i < delta_count(d); i++) {
        delta_update(d, i);
    }
}

void delta_flow(Delta *d, const Run *run)
{
    walk_all(d, run);
    cut_all_loops(d);
    find_discharge(d);
    find_level(d);
}
