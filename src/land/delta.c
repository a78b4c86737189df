#include "land/delta_parts.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

#define HALF 0.70710678118654752

const DeltaWay delta_ways[DELTA_WAYS] = {
    {1, 0, 1, 0, 1},   {1, 1, HALF, HALF, HALF},     {0, 1, 0, 1, 1},   {-1, 1, -HALF, HALF, HALF},
    {-1, 0, -1, 0, 1}, {-1, -1, -HALF, -HALF, HALF}, {0, -1, 0, -1, 1}, {1, -1, HALF, -HALF, HALF}};

static const double FASTEST = 2.0; // speed, in that of the river

// ---- memory

static bool alloc_work(Delta *d, Error *e)
{
    int64_t count = delta_count(d);
    DeltaWork *w = d->work = memory_alloc_zero(1, sizeof *w, e);
    if (!w) {
        return false;
    }
    w->longest = d->columns + d->rows;
    return (w->depth = memory_alloc_zero(count, sizeof *w->depth, e)) &&
           (w->sum = memory_alloc_zero(count, sizeof *w->sum, e)) &&
           (w->x = memory_alloc_zero(count, sizeof *w->x, e)) &&
           (w->z = memory_alloc_zero(count, sizeof *w->z, e)) &&
           (w->visits = memory_alloc_zero(count, sizeof *w->visits, e)) &&
           (w->sand = memory_alloc_zero(count, sizeof *w->sand, e)) &&
           (w->mud = memory_alloc_zero(count, sizeof *w->mud, e)) &&
           (w->out = memory_alloc_zero(count, sizeof *w->out, e)) &&
           (w->path = memory_alloc((int64_t)w->longest * DELTA_WATERS, sizeof *w->path, e)) &&
           (w->count = memory_alloc(DELTA_WATERS, sizeof *w->count, e));
}

static bool alloc_cells(Delta *d, Error *e)
{
    int64_t count = delta_count(d);
    return (d->kind = memory_alloc_zero(count, sizeof *d->kind, e)) &&
           (d->bed = memory_alloc_zero(count, sizeof *d->bed, e)) &&
           (d->level = memory_alloc_zero(count, sizeof *d->level, e)) &&
           (d->flow_x = memory_alloc_zero(count, sizeof *d->flow_x, e)) &&
           (d->flow_z = memory_alloc_zero(count, sizeof *d->flow_z, e)) &&
           (d->speed = memory_alloc_zero(count, sizeof *d->speed, e)) &&
           (d->mud = memory_alloc_zero(count, sizeof *d->mud, e)) &&
           (d->water = memory_alloc_zero(count, sizeof *d->water, e)) &&
           (d->bared = memory_alloc_zero(count, sizeof *d->bared, e)) &&
           (d->inlet = memory_alloc_zero(d->columns, sizeof *d->inlet, e));
}

Delta *delta_new(int columns, int rows, double cell, Error *e)
{
    enum { LEAST = 16, MOST = 2048 };
    if (columns < LEAST || rows < LEAST || columns > MOST || rows > MOST || !(cell > 0.0)) {
        error_set(e, ERROR_INPUT, "a delta of %d x %d cells of %g m; it needs %d to %d a side",
                  columns, rows, cell, LEAST, MOST);
        return NULL;
    }
    Delta *d = memory_alloc_zero(1, sizeof *d, e);
    if (!d) {
        return NULL;
    }
    d->columns = columns;
    d->rows = rows;
    d->cell = cell;
    if (!alloc_cells(d, e) || !alloc_work(d, e)) {
        delta_free(d);
        return NULL;
    }
    return d;
}

static void free_work(DeltaWork *w)
{
    if (!w) {
        return;
    }
    free(w->depth);
    free(w->sum);
    free(w->x);
    free(w->z);
    free(w->visits);
    free(w->sand);
    free(w->mud);
    free(w->out);
    free(w->path);
    free(w->count);
    free(w);
}

void delta_free(Delta *d)
{
    if (!d) {
        return;
    }
    free_work(d->work);
    free(d->kind);
    free(d->bed);
    free(d->level);
    free(d->flow_x);
    free(d->flow_z);
    free(d->speed);
    free(d->mud);
    free(d->water);
    free(d->bared);
    free(d->inlet);
    free(d);
}

// ---- cells

// No parcel goes back into the first row, where the river enters.
double delta_depth(const Delta *d, int64_t i)
{
    bool closed = d->kind[i] == DELTA_PLAIN || i < d->columns;
    return closed || !(d->level[i] > d->bed[i]) ? 0.0 : d->level[i] - d->bed[i];
}

void delta_update(Delta *d, int64_t i)
{
    double depth = d->work->depth[i] = delta_depth(d, i);
    double flow = sqrt(d->flow_x[i] * d->flow_x[i] + d->flow_z[i] * d->flow_z[i]);
    double speed = depth > DELTA_DRY * d->depth ? flow * d->depth / depth : 0.0;
    d->speed[i] = speed < FASTEST ? speed : FASTEST;
}

void delta_find_out(Delta *d)
{
    const double sea = 20.0, shoal = -0.6 * d->depth;
    double reach = 0.0;
    for (int pass = 0; pass < 2; pass++) {
        double far = sqrt(reach) + sea;
        for (int64_t i = 0; i < delta_count(d); i++) {
            double x = (double)delta_column(d, i) - d->mouth[0];
            double z = (double)delta_row(d, i) - d->mouth[1], square = x * x + z * z;
            bool bed = d->kind[i] == DELTA_OPEN && d->bed[i] > d->sea + shoal && d->water[i] > 0.0;
            reach = pass == 0 && bed && square > reach ? square : reach;
            bool sails = d->kind[i] == DELTA_OPEN && square > far * far;
            d->work->out[i] = d->kind[i] == DELTA_EDGE || (pass == 1 && sails);
        }
    }
}

bool delta_begin(Delta *d, Error *e)
{
    double mouth_x = d->mouth[0], mouth_z = d->mouth[1];
    d->inlets = 0;
    for (int column = 0; column < d->columns; column++) {
        if (d->kind[column] == DELTA_TRUNK) {
            d->inlet[d->inlets++] = column;
        }
    }
    if (d->inlets == 0) {
        error_set(e, ERROR_INPUT, "no river enters the delta; its first row needs cells of trunk");
        return false;
    }
    for (int64_t i = 0; i < delta_count(d); i++) {
        double x = (double)delta_column(d, i) - mouth_x, z = (double)delta_row(d, i) - mouth_z;
        double away = sqrt(x * x + z * z);
        bool open = d->kind[i] == DELTA_OPEN || d->kind[i] == DELTA_EDGE;
        double thin = 0.5 * d->inlets / fmax(away, 0.5 * d->inlets);
        d->flow_x[i] = open && away > 0.0 ? thin * x / away : 0.0;
        d->flow_z[i] =
            open ? (away > 0.0 ? thin * z / away : thin) : (d->kind[i] == DELTA_TRUNK ? 1.0 : 0.0);
        double upstream = d->kind[i] == DELTA_TRUNK ? fmax(-z, 0.0) * d->cell : 0.0;
        d->level[i] = d->sea + d->slope * upstream;
        d->bared[i] = 0;
        delta_update(d, i);
    }
    return true;
}

double delta_volume(const Delta *d)
{
    double sum = 0.0;
    for (int64_t i = 0; i < delta_count(d); i++) {
        sum += d->bed[i];
    }
    return sum * d->cell * d->cell;
}

// ---- a parcel's step

// Weights of the ways by the surface's slope and by the flow's direction, without the depth.
typedef struct Pulls {
    double down[DELTA_WAYS], along[DELTA_WAYS], depth[DELTA_WAYS];
    double all_down, all_along;
} Pulls;

// fmax of numbers, which is a call to the library, would take half of the time.
static inline double positive(double x)
{
    return x > 0.0 ? x : 0.0;
}

static void find_pulls(const Delta *d, const DeltaPull *pull, int64_t cell, Pulls *p)
{
    const double dry = DELTA_DRY * d->depth, x = pull->x[cell], z = pull->z[cell];
    const double *depth = d->work->depth + cell, *level = d->level + cell;
    p->all_down = p->all_along = 0.0;
    for (int k = 0; k < DELTA_WAYS; k++) {
        const DeltaWay *way = &delta_ways[k];
        int64_t step = (int64_t)way->row * d->columns + way->column;
        double open = depth[step] > dry ? way->near : 0.0;
        p->depth[k] = depth[step];
        p->down[k] = open * positive(level[0] - level[step]);
        p->along[k] = open * positive(x * way->x + z * way->z);
        p->all_down += p->down[k];
        p->all_along += p->along[k];
    }
}

// In still water a parcel goes anywhere.
static void wander(const Delta *d, Pulls *p)
{
    double dry = DELTA_DRY * d->depth;
    for (int k = 0; k < DELTA_WAYS; k++) {
        p->down[k] = p->depth[k] > dry ? 1.0 : 0.0;
    }
    p->all_down = 1.0;
}

int delta_next(const Delta *d, const DeltaPull *pull, int64_t cell, double draw)
{
    Pulls p;
    find_pulls(d, pull, cell, &p);
    if (!(p.all_down * (1.0 - pull->inertia) > 0.0) && !(p.all_along > 0.0)) {
        wander(d, &p);
    }
    double upto[DELTA_WAYS], all = 0.0;
    double slope = p.all_down > 0.0 ? 1.0 / p.all_down : 0.0;
    double inertia = p.all_along > 0.0 ? pull->inertia / p.all_along : 0.0;
    slope *= p.all_along > 0.0 ? 1.0 - pull->inertia : 1.0;
    for (int k = 0; k < DELTA_WAYS; k++) {
        double depth = pull->squared ? p.depth[k] * p.depth[k] : p.depth[k];
        all += depth * (slope * p.down[k] + inertia * p.along[k]);
        upto[k] = all;
    }
    for (int k = 0; k < DELTA_WAYS; k++) {
        if (upto[k] > draw * all) {
            return k;
        }
    }
    return -1;
}

// ---- steps

static void grow_older(Delta *d)
{
    const double deep = 0.12 * d->depth, fast = 0.25;
    for (int64_t i = 0; i < delta_count(d); i++) {
        if (d->work->depth[i] > deep || d->speed[i] > fast) {
            d->bared[i] = d->step;
        }
    }
}

bool delta_run(Delta *d, const DeltaRates *rates, int64_t steps, const Run *run, Error *e)
{
    enum { OUT_STEPS = 16 };
    for (int64_t n = 0; n < steps; n++) {
        if (run_is_cancelled(run)) {
            return run_cancel_error(e);
        }
        if (n % 32 == 0) {
            run_progress(run, "delta", (double)n / (double)steps);
        }
        d->sea += rates->rise;
        if (n % OUT_STEPS == 0) {
            delta_find_out(d);
        }
        delta_flow(d, run);
        delta_carry(d, rates);
        delta_roll(d, rates);
        d->step++;
        grow_older(d);
    }
    return true;
}
