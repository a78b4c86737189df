// Slopes. Heights of rock are compared as runs along the stable profile of its beds (strata_run):
// there a stable slope is one of gradient 1, whatever the bed, and a face that weathers back at
// speed v sinks at v times the gradient (the eikonal equation, upwind differences after Godunov).
#include "base/memory.h"
#include "land/landscape_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// ---- faces

static double run_of(const Landscape *land, int64_t i, double height)
{
    return land->strata ? strata_run(land->strata, height - (double)land->stack[i]) : height;
}

static double height_of(const Landscape *land, int64_t i, double run)
{
    return land->strata ? strata_level(land->strata, run) + (double)land->stack[i] : run;
}

static double surface(const Landscape *land, int64_t i)
{
    return land->rock[i] + land->loose[i];
}

// The lower of the surfaces on both sides of i along a row (step 1) or a column.
static double lower_side(const Landscape *land, int64_t i, int at, int64_t step)
{
    double before = at > 0 ? surface(land, i - step) : INFINITY;
    double after = at < land->side - 1 ? surface(land, i + step) : INFINITY;
    return before < after ? before : after;
}

// The highest run that stands beside runs a and b along both axes: the solution of |grad| = 1.
static double steepest_stable(double a, double b, double cell)
{
    double low = a < b ? a : b, gap = a < b ? b - a : a - b;
    if (gap >= cell) {
        return low + cell;
    }
    return 0.5 * (a + b + sqrt(2.0 * cell * cell - gap * gap));
}

// Speed at which faces of rock of this hardness weather back, relative to hardness 0.
static double weathering(double hardness)
{
    double soft = 1.0 - hardness;
    return 0.03 + 0.97 * soft * soft;
}

// How much steeper than the stable profile of its beds the rock of sample i stands: strong rock
// stands as ribs and buttresses, rock that joints have cut lies back between them.
static double steeper(const Landscape *land, const LandscapeRates *rates, int64_t i)
{
    const double least = 0.55, most = 1.9;
    double factor = 1.0 + rates->joints * (1.0 - (double)land->weakness[i]);
    return factor < least ? least : factor > most ? most : factor;
}

// The rock's height after weathering and falling.
static double worn(const Landscape *land, const LandscapeRates *rates, int column, int row,
                   double time)
{
    int64_t i = (int64_t)row * land->side + column;
    double rock = land->rock[i], x = lower_side(land, i, column, 1);
    double z = lower_side(land, i, row, land->side);
    if (x >= rock && z >= rock) {
        return rock;
    }
    double here = run_of(land, i, rock);
    double to_x = x < rock ? run_of(land, i, x) : here, to_z = z < rock ? run_of(land, i, z) : here;
    double reach = land->cell * steeper(land, rates, i);
    double stable =
        steepest_stable(x < rock ? to_x : here + reach, z < rock ? to_z : here + reach, reach);
    double gradient =
        sqrt((here - to_x) * (here - to_x) + (here - to_z) * (here - to_z)) / land->cell;
    gradient = gradient < 1.0 ? gradient : 1.0;
    double hardness = landscape_hardness(land, landscape_bed(land, i, rock));
    double covered = land->loose[i] > 0.0 ? 1.0 / (1.0 + 0.12 * land->loose[i]) : 1.0;
    double speed = rates->retreat * weathering(hardness) * (double)land->weakness[i] * covered;
    double after = here - time * speed * gradient;
    after = after < stable ? after : stable;
    double height = height_of(land, i, after);
    return height < rock ? height : rock;
}

static bool wear_faces(Landscape *land, const LandscapeRates *rates, double time, const Run *run,
                       Error *e)
{
    double *next = memory_alloc(landscape_count(land), sizeof *next, e);
    double *fine = memory_alloc(land->side, sizeof *fine, e);
    if (!next || !fine) {
        free(next);
        free(fine);
        return false;
    }
#pragma omp parallel for schedule(static) num_threads(run->threads)
    for (int row = 0; row < land->side; row++) {
        for (int column = 0; column < land->side; column++) {
            int64_t i = (int64_t)row * land->side + column;
            next[i] = land->base[i] ? land->rock[i] : worn(land, rates, column, row, time);
        }
    }
#pragma omp parallel for schedule(static) num_threads(run->threads)
    for (int row = 0; row < land->side; row++) {
        fine[row] = 0.0;
        for (int column = 0; column < land->side; column++) {
            int64_t i = (int64_t)row * land->side + column;
            double fallen = land->rock[i] - next[i];
            double washed = land->loose[i] * rates->wash * time;
            washed = washed < land->loose[i] ? washed : land->loose[i];
            land->rock[i] = next[i];
            land->loose[i] += rates->rubble * fallen - washed;
            fine[row] += (1.0 - rates->rubble) * fallen + washed;
        }
    }
    double own = land->cell * land->cell;
    for (int row = 0; row < land->side; row++) {
        land->outflow += fine[row] * own;
    }
    free(next);
    free(fine);
    return true;
}

// ---- walls

// One sweep of the fast sweeping method (Zhao 2005) over runs, along both axes forward or back.
static void sweep_runs(const Landscape *land, double *run, bool right, bool down, double reach)
{
    int side = land->side;
    for (int j = 0; j < side; j++) {
        int row = down ? j : side - 1 - j;
        for (int k = 0; k < side; k++) {
            int column = right ? k : side - 1 - k;
            int64_t i = (int64_t)row * side + column;
            double west = column > 0 ? run[i - 1] : INFINITY;
            double east = column < side - 1 ? run[i + 1] : INFINITY;
            double north = row > 0 ? run[i - side] : INFINITY;
            double south = row < side - 1 ? run[i + side] : INFINITY;
            double x = west < east ? west : east, z = north < south ? north : south;
            double most = steepest_stable(x, z, reach);
            run[i] = run[i] < most ? run[i] : most;
        }
    }
}

bool landscape_limit_slopes(Landscape *land, double factor, Error *e)
{
    int64_t count = landscape_count(land);
    double *run = memory_alloc(count, sizeof *run, e);
    if (!run) {
        return false;
    }
    for (int64_t i = 0; i < count; i++) {
        run[i] = run_of(land, i, surface(land, i));
    }
    for (int sweep = 0; sweep < 4; sweep++) {
        sweep_runs(land, run, sweep % 2 == 0, sweep / 2 == 0, factor * land->cell);
    }
    double own = land->cell * land->cell;
    for (int64_t i = 0; i < count; i++) {
        double fallen = land->base[i] ? 0.0 : surface(land, i) - height_of(land, i, run[i]);
        if (fallen > 0.0) {
            double loose = fallen < land->loose[i] ? fallen : land->loose[i];
            land->loose[i] -= loose;
            land->rock[i] -= fallen - loose;
            land->outflow += fallen * own;
        }
    }
    free(run);
    return true;
}

// ---- rubble and soil

static const int STEP[8][2] = {{1, 0},  {1, 1},   {0, 1},  {-1, 1},
                               {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};

typedef struct Slide {
    Landscape *land;
    double *top;     // of each sample: the surface, m
    double *share;   // of what would leave each sample, that its cover allows
    double *next;    // loose cover after a step
    double *arrived; // per row: at bases, m
    double limit[2]; // m: height difference that rubble bears, to a side and across a corner
    double creep[2]; // share of a height difference that creeps
} Slide;

static bool slide_init(Slide *s, Landscape *land, const LandscapeRates *rates, double time,
                       Error *e)
{
    double creep = rates->creep * time / (land->cell * land->cell);
    creep = creep < 0.1 ? creep : 0.1;
    double limit = rates->repose * land->cell;
    *s = (Slide){
        .land = land, .limit = {limit, 1.4142135623730951 * limit}, .creep = {creep, 0.5 * creep}};
    int64_t count = landscape_count(land);
    return (s->top = memory_alloc(count, sizeof *s->top, e)) &&
           (s->share = memory_alloc(count, sizeof *s->share, e)) &&
           (s->next = memory_alloc(count, sizeof *s->next, e)) &&
           (s->arrived = memory_alloc(land->side, sizeof *s->arrived, e));
}

static void slide_clear(Slide *s)
{
    free(s->top);
    free(s->share);
    free(s->next);
    free(s->arrived);
}

// m that would leave a sample `drop` >= 0 above its neighbour.
static inline double leaves(double drop, double limit, double creep)
{
    double over = drop - limit;
    return 0.11 * (over > 0.0 ? over : 0.0) + creep * drop;
}

// The part of a row whose neighbours in direction k exist: columns from..to-1, `offset` to them.
typedef struct Span {
    int from, to;
    int64_t offset;
} Span;

static Span span_of(const Landscape *land, int row, int k)
{
    int r = row + STEP[k][1], dx = STEP[k][0];
    if (r < 0 || r >= land->side) {
        return (Span){0};
    }
    return (Span){dx < 0 ? 1 : 0, dx > 0 ? land->side - 1 : land->side,
                  (int64_t)STEP[k][1] * land->side + dx};
}

// The share of what would leave each sample of a row that its cover allows. Loops run along the
// row, direction by direction, so that they can be vectorized.
static void find_shares(const Slide *s, int row)
{
    const Landscape *land = s->land;
    int64_t first = (int64_t)row * land->side;
    const double *top = s->top + first, *loose = land->loose + first;
    double *sum = s->share + first;
    memset(sum, 0, sizeof *sum * (size_t)land->side);
    for (int k = 0; k < 8; k++) {
        Span span = span_of(land, row, k);
        const double *other = top + span.offset;
        double limit = s->limit[k & 1], creep = s->creep[k & 1];
#pragma omp simd
        for (int c = span.from; c < span.to; c++) {
            double drop = top[c] - other[c];
            sum[c] += leaves(drop > 0.0 ? drop : 0.0, limit, creep);
        }
    }
    for (int c = 0; c < land->side; c++) {
        sum[c] = land->base[first + c] || loose[c] <= 0.0 ? 0.0
                 : sum[c] > loose[c]                      ? loose[c] / sum[c]
                                                          : 1.0;
    }
}

// The loose cover of a row after what leaves and what arrives.
static void exchange(const Slide *s, int row)
{
    const Landscape *land = s->land;
    int64_t first = (int64_t)row * land->side;
    const double *top = s->top + first, *share = s->share + first;
    double *next = s->next + first;
    memcpy(next, land->loose + first, sizeof *next * (size_t)land->side);
    for (int k = 0; k < 8; k++) {
        Span span = span_of(land, row, k);
        const double *other = top + span.offset, *its_share = share + span.offset;
        double limit = s->limit[k & 1], creep = s->creep[k & 1];
#pragma omp simd
        for (int c = span.from; c < span.to; c++) {
            double drop = top[c] - other[c], fall = drop > 0.0 ? drop : -drop;
            double moves = leaves(fall, limit, creep);
            next[c] += drop > 0.0 ? -share[c] * moves : its_share[c] * moves;
        }
    }
}

// Rounding may leave a hair below nothing: it is taken from the rock. What reaches a base is gone.
static void move_row(const Slide *s, int row)
{
    Landscape *land = s->land;
    exchange(s, row);
    s->arrived[row] = 0.0;
    for (int column = 0; column < land->side; column++) {
        int64_t i = (int64_t)row * land->side + column;
        if (land->base[i]) {
            s->arrived[row] += s->next[i];
            s->next[i] = 0.0;
        } else if (s->next[i] < 0.0) {
            land->rock[i] += s->next[i];
            s->next[i] = 0.0;
        }
    }
}

static void slide_once(Slide *s, int threads)
{
    Landscape *land = s->land;
#pragma omp parallel num_threads(threads)
    {
#pragma omp for schedule(static)
        for (int64_t i = 0; i < landscape_count(land); i++) {
            s->top[i] = surface(land, i);
        }
#pragma omp for schedule(static)
        for (int row = 0; row < land->side; row++) {
            find_shares(s, row);
        }
#pragma omp for schedule(static)
        for (int row = 0; row < land->side; row++) {
            move_row(s, row);
        }
    }
    for (int row = 0; row < land->side; row++) {
        land->outflow += s->arrived[row] * land->cell * land->cell;
    }
    double *loose = land->loose;
    land->loose = s->next;
    s->next = loose;
}

// Bare rock turns to soil, the slower the thicker the soil already is (after Heimsath et al. 1997).
static void make_soil(Landscape *land, double depth, int threads)
{
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int64_t i = 0; i < landscape_count(land); i++) {
        double cover = 1.0 + 2.0 * land->loose[i];
        double soil = land->base[i] ? 0.0 : depth / (cover * cover);
        land->rock[i] -= soil;
        land->loose[i] += soil;
    }
}

static bool slide_rubble(Landscape *land, const LandscapeRates *rates, double time, const Run *run,
                         Error *e)
{
    enum { TIMES = 4 };
    Slide slide;
    bool done = slide_init(&slide, land, rates, time / TIMES, e);
    if (done && rates->soil > 0.0) {
        make_soil(land, rates->soil * time, run->threads);
    }
    for (int k = 0; done && k < TIMES; k++) {
        done = !run_is_cancelled(run) || run_cancel_error(e);
        if (done) {
            slide_once(&slide, run->threads);
        }
    }
    slide_clear(&slide);
    return done;
}

bool landscape_slopes(Landscape *land, const LandscapeRates *rates, double time, const Run *run,
                      Error *e)
{
    return wear_faces(land, rates, time, run, e) && slide_rubble(land, rates, time, run, e);
}
