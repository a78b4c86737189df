// Explicit steps on the faces between samples. Each row knows the span of columns that lava may
// reach in a step, so a step costs as much as the flow covers. Mobilities are bounded for
// stability: that bounds the speed, not where the lava comes to rest.
#include "land/lava.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct Span {
    int from, to; // columns from..to-1; empty: from = to
} Span;

typedef struct Flow {
    Landscape *land;
    const LavaParams *params;
    double *depth; // m of lava; the caller's
    double *heat;  // m of it that are hot
    double *yield; // m, at its temperature; 0 = not yet known
    double *hot;   // 0..1: temperature before a step
    double *surface;
    double *east, *south; // m of lava that cross the face beyond each sample in a step
    double *share;        // of that, what there is
    Span *span;           // of each row: where there is lava
    int first, last;      // rows with lava
    int column, row;      // of the vent
    double time;          // s, of a step
    double moved;         // m: the most that crossed a face in the last step
} Flow;

enum { VENT = 1 }; // samples beside the vent's that lava rises in

static void clear(Flow *f)
{
    free(f->heat);
    free(f->yield);
    free(f->hot);
    free(f->surface);
    free(f->east);
    free(f->south);
    free(f->share);
    free(f->span);
}

static bool init(Flow *f, double x, double z, Error *e)
{
    const Landscape *land = f->land;
    int64_t count = landscape_count(land);
    size_t size = sizeof(double);
    f->column = (int)((x - land->corner) / land->cell + 0.5);
    f->row = (int)((z - land->corner) / land->cell + 0.5);
    int edge = VENT + 2, end = land->side - 1 - edge;
    f->column = f->column < edge ? edge : f->column > end ? end : f->column;
    f->row = f->row < edge ? edge : f->row > end ? end : f->row;
    f->first = f->row - VENT;
    f->last = f->row + VENT;
    return (f->heat = memory_alloc_zero(count, size, e)) &&
           (f->yield = memory_alloc_zero(count, size, e)) &&
           (f->hot = memory_alloc_zero(count, size, e)) &&
           (f->surface = memory_alloc(count, size, e)) &&
           (f->east = memory_alloc_zero(count, size, e)) &&
           (f->south = memory_alloc_zero(count, size, e)) &&
           (f->share = memory_alloc_zero(count, size, e)) &&
           (f->span = memory_alloc_zero(land->side, sizeof *f->span, e));
}

static void include(Span *span, int column)
{
    if (span->from == span->to) {
        *span = (Span){column, column + 1};
    }
    span->from = column < span->from ? column : span->from;
    span->to = column >= span->to ? column + 1 : span->to;
}

// Lava rises in the vent.
static void supply(Flow *f, double volume)
{
    const double own = f->land->cell * f->land->cell;
    double each = volume / (own * (2 * VENT + 1) * (2 * VENT + 1));
    for (int row = f->row - VENT; row <= f->row + VENT; row++) {
        for (int column = f->column - VENT; column <= f->column + VENT; column++) {
            int64_t i = (int64_t)row * f->land->side + column;
            f->depth[i] += each;
            f->heat[i] += each;
            include(&f->span[row], column);
        }
    }
    f->land->uplifted += volume;
}

// The columns `margin` beyond the lava of a row and of the rows beside it, within the faces' reach.
static Span around(const Flow *f, int row, int margin)
{
    Span all = {0};
    for (int r = row - 1; r <= row + 1; r++) {
        if (r >= 0 && r < f->land->side && f->span[r].from < f->span[r].to) {
            include(&all, f->span[r].from);
            include(&all, f->span[r].to - 1);
        }
    }
    if (all.from < all.to) {
        all.from = all.from - margin < 1 ? 1 : all.from - margin;
        all.to = all.to + margin > f->land->side - 1 ? f->land->side - 1 : all.to + margin;
    }
    return all;
}

static int clamp_row(const Flow *f, int row)
{
    return row < 1 ? 1 : row > f->land->side - 2 ? f->land->side - 2 : row;
}

// The yield strength of lava of sample i at its temperature, m.
static double yield_of(const Flow *f, int64_t i)
{
    const LavaParams *p = f->params;
    double cold = 1.0 - f->heat[i] / f->depth[i];
    double varies = (double)random_unit(random_key(p->seed, (uint64_t)i)) - 0.5;
    return p->yield * (1.0 + p->roughness * varies) *
           (p->stiffening > 0.0 ? exact_exp(p->stiffening * cold) : 1.0);
}

// Surfaces and yield strengths of the lava and of the samples beside it. Temperatures change
// slowly: yield strengths are found anew in every eighth turn.
static void find_surfaces(Flow *f, int64_t turn)
{
    const Landscape *land = f->land;
    for (int row = clamp_row(f, f->first - 1); row <= clamp_row(f, f->last + 1); row++) {
        Span span = around(f, row, 1);
        for (int c = span.from; c < span.to; c++) {
            int64_t i = (int64_t)row * land->side + c;
            double depth = f->depth[i];
            f->surface[i] = land->rock[i] + land->loose[i] + depth;
            if (depth > 0.0 && (turn % 8 == 0 || f->yield[i] == 0.0)) {
                f->yield[i] = yield_of(f, i);
            }
        }
    }
}

// m that cross the face from sample i to i + step in a step of time; `across` is the other axis.
static double crossing(const Flow *f, int64_t i, int64_t step, int64_t across)
{
    const double *s = f->surface, cell = f->land->cell;
    int64_t j = i + step;
    double along = (s[i] - s[j]) / cell;
    int64_t from = along > 0.0 ? i : j;
    double depth = f->depth[from];
    if (depth <= 0.0) {
        return 0.0;
    }
    double beside = 0.25 * (s[i + across] - s[i - across] + s[j + across] - s[j - across]) / cell;
    double stress = depth * sqrt(along * along + beside * beside) / f->yield[from];
    if (stress <= 1.0) {
        return 0.0;
    }
    double share = 1.0 - 1.5 / stress + 0.5 / (stress * stress * stress);
    double mobility = depth * depth * depth * share * f->time / (3.0 * f->params->viscosity);
    double most = 0.2 * cell * cell;
    return (mobility < most ? mobility : most) * along / cell;
}

static void find_crossings(Flow *f)
{
    const int64_t side = f->land->side;
    f->moved = 0.0;
    for (int row = clamp_row(f, f->first - 1); row <= clamp_row(f, f->last + 1); row++) {
        Span span = around(f, row, 1);
        for (int c = span.from; c < span.to; c++) {
            int64_t i = row * side + c;
            f->east[i] = crossing(f, i, 1, side);
            f->south[i] = crossing(f, i, side, 1);
            double most = fmax(fabs(f->east[i]), fabs(f->south[i]));
            f->moved = most > f->moved ? most : f->moved;
        }
    }
}

// What crosses the faces of sample i outward, m.
static double outward(const Flow *f, int64_t i)
{
    return fmax(f->east[i], 0.0) + fmax(f->south[i], 0.0) + fmax(-f->east[i - 1], 0.0) +
           fmax(-f->south[i - f->land->side], 0.0);
}

static void find_shares(Flow *f)
{
    for (int row = clamp_row(f, f->first - 1); row <= clamp_row(f, f->last + 1); row++) {
        Span span = around(f, row, 1);
        for (int c = span.from; c < span.to; c++) {
            int64_t i = (int64_t)row * f->land->side + c;
            double out = outward(f, i);
            f->share[i] = out > f->depth[i] ? f->depth[i] / out : 1.0;
        }
    }
}

// Moves lava and heat over the face from i to j. Each face is visited once, so volume is kept.
static void cross(Flow *f, int64_t i, int64_t j, double amount)
{
    int64_t from = amount > 0.0 ? i : j;
    double moves = amount * f->share[from];
    f->depth[i] -= moves;
    f->depth[j] += moves;
    f->heat[i] -= moves * f->hot[from];
    f->heat[j] += moves * f->hot[from];
}

static void move(Flow *f)
{
    int side = f->land->side, from = clamp_row(f, f->first - 1), to = clamp_row(f, f->last + 1);
    for (int row = from; row <= to; row++) {
        Span span = around(f, row, 1);
        for (int c = span.from; c < span.to; c++) {
            int64_t i = (int64_t)row * side + c;
            f->hot[i] = f->depth[i] > 0.0 ? f->heat[i] / f->depth[i] : 0.0;
        }
    }
    for (int row = from; row <= to; row++) {
        Span span = around(f, row, 1);
        for (int c = span.from; c < span.to; c++) {
            int64_t i = (int64_t)row * side + c;
            if (f->east[i] != 0.0) {
                cross(f, i, i + 1, f->east[i]);
            }
            if (f->south[i] != 0.0) {
                cross(f, i, i + side, f->south[i]);
            }
            f->east[i] = f->south[i] = 0.0;
        }
    }
}

// Does lava leave here? No sample at the rim holds any, so every one with lava has all neighbours'
// neighbours.
static bool leaves(const Landscape *land, int row, int column)
{
    int last = land->side - 2;
    return land->base[(int64_t)row * land->side + column] || row <= 1 || column <= 1 ||
           row >= last || column >= last;
}

// Cools, lets go what has reached a base or the rim, and finds the spans anew.
static void settle(Flow *f)
{
    Landscape *land = f->land;
    double loss = f->params->cooling * f->time, own = land->cell * land->cell;
    int from = clamp_row(f, f->first - 1), to = clamp_row(f, f->last + 1);
    Span before = around(f, from, 1);
    for (int row = from; row <= to; row++) {
        Span span = before;
        before = row < to ? around(f, row + 1, 1) : (Span){0};
        Span lava = {0};
        for (int c = span.from; c < span.to; c++) {
            int64_t i = (int64_t)row * land->side + c;
            if (f->depth[i] <= 0.0) {
                f->depth[i] = f->heat[i] = 0.0;
                continue;
            }
            if (leaves(land, row, c)) {
                land->outflow += f->depth[i] * own;
                f->depth[i] = f->heat[i] = 0.0;
                continue;
            }
            f->heat[i] = f->heat[i] > loss ? f->heat[i] - loss : 0.0;
            f->heat[i] = f->heat[i] < f->depth[i] ? f->heat[i] : f->depth[i];
            include(&lava, c);
        }
        f->span[row] = lava;
        if (lava.from < lava.to) {
            f->first = row < f->first ? row : f->first;
            f->last = row > f->last ? row : f->last;
        }
    }
}

bool lava_erupt(Landscape *land, const LavaParams *params, double x, double z, double *thickness,
                const Run *run, Error *e)
{
    enum { CHECK = 64, MOST_AFTER = 1500 };
    const double still = 1e-4; // m in a step
    int64_t count = landscape_count(land);
    memset(thickness, 0, sizeof *thickness * (size_t)count);
    Flow flow = {.land = land, .params = params, .depth = thickness};
    bool done = init(&flow, x, z, e);
    // In a step the vent gets so much that a channel of a few samples carries it off.
    double step = 0.12 * land->cell * land->cell * land->cell;
    double left = params->volume, least = params->volume / 5000.0;
    step = step > least ? step : least;
    flow.time = step / params->rate;
    int after = 0;
    for (int64_t turn = 0; done && after < MOST_AFTER; turn++) {
        if (left > 0.0) {
            double part = left < step ? left : step;
            supply(&flow, part);
            left -= part;
        }
        find_surfaces(&flow, turn);
        find_crossings(&flow);
        if (left <= 0.0 && (flow.moved < still || ++after >= MOST_AFTER)) {
            break;
        }
        find_shares(&flow);
        move(&flow);
        settle(&flow);
        done = turn % CHECK != 0 || !run_is_cancelled(run) || run_cancel_error(e);
    }
    for (int64_t i = 0; done && i < count; i++) {
        land->rock[i] += land->loose[i] > 0.0 && thickness[i] > 0.0 ? land->loose[i] : 0.0;
        land->loose[i] = thickness[i] > 0.0 ? 0.0 : land->loose[i];
        land->rock[i] += thickness[i];
    }
    clear(&flow);
    return done;
}
