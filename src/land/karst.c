#include "land/karst.h"

#include "base/lowest_queue.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

// ---- fronts

static double lower_of(double a, double b)
{
    return a < b ? a : b;
}

// The value that the neighbours allow a sample.
static double allowed(const double *value, int side, int64_t i, double rise)
{
    int column = (int)(i % side), row = (int)(i / side);
    double a = (double)INFINITY, b = a;
    a = column > 0 ? lower_of(a, value[i - 1]) : a;
    a = column < side - 1 ? lower_of(a, value[i + 1]) : a;
    b = row > 0 ? lower_of(b, value[i - side]) : b;
    b = row < side - 1 ? lower_of(b, value[i + side]) : b;
    double low = lower_of(a, b), apart = a < b ? b - a : a - b;
    if (!(apart < rise)) {
        return low + rise;
    }
    return 0.5 * (a + b + sqrt(2.0 * rise * rise - apart * apart));
}

static bool visit(const double *gradient, int side, double cell, double *value, LowestQueue *queue,
                  int64_t i, Error *e)
{
    double most = allowed(value, side, i, gradient[i] * cell);
    if (!(most < value[i] - 1e-9 * (1.0 + fabs(most)))) {
        return true;
    }
    value[i] = most;
    return lowest_queue_push(queue, (float)most, (int32_t)i, e);
}

// The queue's order is that of floats: a sample may come up again until nothing sinks any more.
bool karst_bound_gradient(const double *gradient, int side, double cell, double *value, Error *e)
{
    LowestQueue queue = {0};
    int64_t count = (int64_t)side * side;
    bool done = true;
    for (int64_t i = 0; done && i < count; i++) {
        done = value[i] == (double)INFINITY ||
               lowest_queue_push(&queue, (float)value[i], (int32_t)i, e);
    }
    while (done && queue.count > 0) {
        QueueItem item = lowest_queue_pop(&queue);
        int64_t i = item.index;
        if (item.height > (float)value[i]) {
            continue; // it has sunk since
        }
        int column = (int)(i % side), row = (int)(i / side);
        done = (column == 0 || visit(gradient, side, cell, value, &queue, i - 1, e)) &&
               (column == side - 1 || visit(gradient, side, cell, value, &queue, i + 1, e)) &&
               (row == 0 || visit(gradient, side, cell, value, &queue, i - side, e)) &&
               (row == side - 1 || visit(gradient, side, cell, value, &queue, i + side, e));
    }
    free(queue.item);
    return done;
}

// ---- dissolution

typedef struct Hollows {
    double *mean;  // m: of the heights within reach
    double *pass;  // after the first direction
    double *taken; // m: dissolved in each row
} Hollows;

static int within(int i, int side)
{
    return i < 0 ? 0 : i >= side ? side - 1 : i;
}

// Mean of a line over 2 * reach + 1 samples; the rim goes on beyond it.
static void average(const double *from, double *to, int side, int64_t step, int reach)
{
    double sum = 0.0;
    for (int k = -reach; k <= reach; k++) {
        sum += from[within(k, side) * step];
    }
    for (int i = 0; i < side; i++) {
        to[i * step] = sum / (2 * reach + 1);
        sum += from[within(i + reach + 1, side) * step] - from[within(i - reach, side) * step];
    }
}

static void find_means(const Landscape *land, Hollows *h, int reach, const Run *run)
{
#pragma omp parallel for schedule(static) num_threads(run->threads)
    for (int row = 0; row < land->side; row++) {
        int64_t first = (int64_t)row * land->side;
        average(land->rock + first, h->pass + first, land->side, 1, reach);
    }
#pragma omp parallel for schedule(static) num_threads(run->threads)
    for (int column = 0; column < land->side; column++) {
        average(h->pass + column, h->mean + column, land->side, land->side, reach);
    }
}

static int cells_of(const Landscape *land, double length)
{
    int cells = (int)(length / land->cell + 0.5);
    return cells > 0 ? cells : 1;
}

static double speed(const Landscape *land, const KarstRates *rates, const Hollows *h, int64_t i)
{
    double depth = (h->mean[i] - land->rock[i]) / rates->reach;
    depth = depth < -1.0 ? -1.0 : depth > 2.0 ? 2.0 : depth;
    double gathers = 1.0 + rates->focus * depth;
    gathers = gathers < 0.15 ? 0.15 : gathers; // rain falls on summits, too
    return rates->lowering * (double)land->weakness[i] * gathers;
}

static void lower(Landscape *land, const KarstRates *rates, Hollows *h, double now, double step,
                  double *reached, const Run *run)
{
#pragma omp parallel for schedule(static) num_threads(run->threads)
    for (int row = 0; row < land->side; row++) {
        h->taken[row] = 0.0;
        for (int column = 0; column < land->side; column++) {
            int64_t i = (int64_t)row * land->side + column;
            double before = land->rock[i], v = speed(land, rates, h, i);
            if (before <= 0.0) {
                continue;
            }
            double after = before - v * step;
            if (after <= 0.0) {
                reached[i] = lower_of(reached[i], now + before / v);
                after = 0.0;
            }
            land->rock[i] = after;
            h->taken[row] += before - after;
        }
    }
    for (int row = 0; row < land->side; row++) {
        land->outflow += h->taken[row] * land->cell * land->cell;
    }
}

// Edges lose blocks and dissolve from several sides: convex rock sinks toward its surroundings.
static void round_edges(Landscape *land, const Hollows *h, double share)
{
    double own = land->cell * land->cell;
    for (int64_t i = 0; i < landscape_count(land); i++) {
        double above = land->rock[i] - h->mean[i];
        if (above > 0.0) {
            land->rock[i] -= share * above;
            land->outflow += share * above * own;
        }
    }
}

// The plain has widened to where the front has come in this time.
static bool widen(Landscape *land, const KarstRates *rates, double time, double *reached, Error *e)
{
    int64_t count = landscape_count(land);
    double *slowness = memory_alloc(count, sizeof *slowness, e);
    for (int64_t i = 0; slowness && i < count; i++) {
        slowness[i] = 1.0 / (rates->corrosion * (double)land->weakness[i]);
    }
    bool done = slowness && (rates->corrosion <= 0.0 ||
                             karst_bound_gradient(slowness, land->side, land->cell, reached, e));
    free(slowness);
    for (int64_t i = 0; done && i < count; i++) {
        if (reached[i] <= time && land->rock[i] > 0.0) {
            land->outflow += land->rock[i] * land->cell * land->cell;
            land->rock[i] = 0.0;
        }
    }
    return done;
}

static bool hollows_new(Hollows *h, const Landscape *land, Error *e)
{
    int64_t count = landscape_count(land);
    return (h->mean = memory_alloc(count, sizeof *h->mean, e)) &&
           (h->pass = memory_alloc(count, sizeof *h->pass, e)) &&
           (h->taken = memory_alloc(land->side, sizeof *h->taken, e));
}

static void hollows_clear(Hollows *h)
{
    free(h->mean);
    free(h->pass);
    free(h->taken);
}

bool karst_dissolve(Landscape *land, const KarstRates *rates, double time, int steps,
                    double *reached, const Run *run, Error *e)
{
    Hollows h = {0};
    bool done = hollows_new(&h, land, e);
    for (int k = 0; done && k < steps; k++) {
        run_progress(run, "dissolution", (double)k / steps);
        if (run_is_cancelled(run)) {
            done = run_cancel_error(e);
            break;
        }
        find_means(land, &h, cells_of(land, rates->reach), run);
        lower(land, rates, &h, time * k / steps, time / steps, reached, run);
        double share = rates->rounding * time / steps;
        if (share > 0.0) {
            find_means(land, &h, cells_of(land, rates->edge), run);
            round_edges(land, &h, share < 1.0 ? share : 1.0);
        }
    }
    hollows_clear(&h);
    return done && widen(land, rates, time, reached, e);
}

bool karst_round(Landscape *land, double edge, int times, const Run *run, Error *e)
{
    Hollows h = {0};
    bool done = hollows_new(&h, land, e);
    for (int k = 0; done && k < times; k++) {
        find_means(land, &h, cells_of(land, edge), run);
        round_edges(land, &h, 0.5);
    }
    hollows_clear(&h);
    return done;
}

// ---- rockfall

// On the stable profile of the beds (strata_run) a stable slope is one of gradient 1.
bool karst_fell(Landscape *land, const double *steepness, Error *e)
{
    int64_t count = landscape_count(land);
    double *run = memory_alloc(count, sizeof *run, e);
    for (int64_t i = 0; run && i < count; i++) {
        run[i] = strata_run(land->strata, land->rock[i] - land->stack[i]);
    }
    bool done = run && karst_bound_gradient(steepness, land->side, land->cell, run, e);
    for (int64_t i = 0; done && i < count; i++) {
        double height = land->stack[i] + strata_level(land->strata, run[i]);
        if (height < land->rock[i]) {
            land->outflow += (land->rock[i] - height) * land->cell * land->cell;
            land->rock[i] = height;
        }
    }
    free(run);
    return done;
}
