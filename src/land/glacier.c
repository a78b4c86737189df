#include "land/glacier.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// 2 A (rho g)^3 / 5 with A = 2.4e-24 / (s Pa^3), temperate ice: 1 / (a m^3).
static const double FLOW = 2.2e-5;
// Of Weertman's sliding, u = SLIDE ice^2 slope^3 (rho g absorbed): 1 / (a m), several times as fast
// as ice of 200 m shears.
static const double SLIDE = 1.5;

// Thin ice on steep ground is held by its bed and by its neighbours, which the shallow ice
// approximation does not know: without this it would slide as fast as thick ice below.
static const double STEEPEST = 0.15; // gradient
static const double FASTEST = 120.0; // m / a: faster only in ice falls, whose ice is thin

// A bed that bends across the flow holds the ice from both sides: it slides 1 / (1 + NARROW k)
// times as fast for a curvature k (Braun, Zwartz and Tomkin 1999). A gorge fills and widens before
// it deepens, so valleys get their U.
static const double NARROW = 700.0; // m
// Ice drags its neighbours along (membrane stress): speeds are even over about this reach.
static const double REACH = 300.0; // m
static const double THIN = 10.0;   // m: thinner ice is not dragged

Glacier *glacier_new(const Landscape *land, Error *e)
{
    Glacier *glacier = memory_alloc_zero(1, sizeof *glacier, e);
    int64_t count = landscape_count(land);
    if (glacier && (glacier->ice = memory_alloc_zero(count, sizeof *glacier->ice, e)) &&
        (glacier->slip = memory_alloc_zero(count, sizeof *glacier->slip, e))) {
        return glacier;
    }
    glacier_free(glacier);
    return NULL;
}

void glacier_free(Glacier *glacier)
{
    if (glacier) {
        free(glacier->ice);
        free(glacier->slip);
        free(glacier);
    }
}

// The equation of a sample that exchanges ice with its neighbours.
typedef struct Equation {
    int64_t at;
    double held;                     // m: what it would be without them
    double west, north, east, south; // shares of their surfaces
    double all;                      // 1 + these
} Equation;

typedef struct Flow {
    const Landscape *land;
    double *bed, *top, *gain; // m, m, m / a
    double *along, *down;     // m^2 / a: diffusivity between a sample and the next in its row, in
                              // its column
    Equation *equation;       // room for those of all samples
} Flow;

static void flow_clear(Flow *f)
{
    free(f->bed);
    free(f->top);
    free(f->gain);
    free(f->along);
    free(f->down);
    free(f->equation);
}

static bool flow_init(Flow *f, const Landscape *land, Error *e)
{
    int64_t count = landscape_count(land);
    *f = (Flow){.land = land};
    return (f->bed = memory_alloc(count, sizeof *f->bed, e)) &&
           (f->top = memory_alloc(count, sizeof *f->top, e)) &&
           (f->gain = memory_alloc(count, sizeof *f->gain, e)) &&
           (f->along = memory_alloc_zero(count, sizeof *f->along, e)) &&
           (f->down = memory_alloc_zero(count, sizeof *f->down, e)) &&
           (f->equation = memory_alloc(count + 2, sizeof *f->equation, e));
}

// Central difference along a row (step 1) or a column; one-sided at the border.
static double gradient(const Landscape *land, const double *h, int64_t i, int at, int64_t step)
{
    int back = at > 0, on = at < land->side - 1;
    return (h[i + on * step] - h[i - back * step]) / ((double)(back + on) * land->cell);
}

static double slope_squared(const Landscape *land, const double *h, int column, int row)
{
    int64_t i = (int64_t)row * land->side + column;
    double x = gradient(land, h, i, column, 1), z = gradient(land, h, i, row, land->side);
    return x * x + z * z;
}

// What a sample gains: nothing where the ground is too steep to hold snow.
static void find_gain(Flow *f, const GlacierParams *params, int threads)
{
    const Landscape *land = f->land;
    double limit = params->steepest * params->steepest;
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int row = 0; row < land->side; row++) {
        for (int column = 0; column < land->side; column++) {
            int64_t i = (int64_t)row * land->side + column;
            double gain = params->gradient * (f->top[i] - params->line);
            if (gain > 0.0) {
                double held = 1.0 - slope_squared(land, f->bed, column, row) / limit;
                gain = (gain < params->most ? gain : params->most) * (held > 0.0 ? held : 0.0);
            }
            f->gain[i] = land->base[i] ? -1e3 : gain;
        }
    }
}

// The square of the surface's gradient between sample i and the next one `step` on: the difference
// of both along the step, which central differences would miss, and their mean across it. at: the
// row of a step along a row, the column of one along a column.
static double edge_slope_squared(const Flow *f, int64_t i, int64_t step, int at)
{
    const Landscape *land = f->land;
    int64_t aside = step == 1 ? land->side : 1;
    double ahead = (f->top[i + step] - f->top[i]) / land->cell;
    double across =
        0.5 * (gradient(land, f->top, i, at, aside) + gradient(land, f->top, i + step, at, aside));
    return ahead * ahead + across * across;
}

// The diffusivity between sample i and the next one `step` on: creep and sliding of the mean
// thickness.
static double between(const Flow *f, int64_t i, int64_t step, int at)
{
    int64_t n = i + step;
    double low = f->bed[i] > f->bed[n] ? f->bed[i] : f->bed[n];
    double high = f->top[i] > f->top[n] ? f->top[i] : f->top[n];
    double ice = high - low; // over the sill between them
    if (ice <= 0.0) {
        return 0.0;
    }
    double squared = edge_slope_squared(f, i, step, at);
    squared = squared < 0.25 ? squared : 0.25; // steeper ice falls, but is thin
    return ice * ice * ice * squared * (FLOW * ice * ice + SLIDE);
}

// The flow is lagged: half of the last step's diffusivity keeps it from swinging.
static void find_diffusivity(Flow *f, bool first, int threads)
{
    const Landscape *land = f->land;
    double kept = first ? 0.0 : 0.5;
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int row = 0; row < land->side; row++) {
        for (int column = 0; column < land->side; column++) {
            int64_t i = (int64_t)row * land->side + column;
            if (column + 1 < land->side) {
                double now = between(f, i, 1, row);
                f->along[i] = kept * f->along[i] + (1.0 - kept) * now;
            }
            if (row + 1 < land->side) {
                double now = between(f, i, land->side, column);
                f->down[i] = kept * f->down[i] + (1.0 - kept) * now;
            }
        }
    }
}

// Collects the equations of every second sample, in order, and returns how many there are. Samples
// without neighbours that give or take get their surface at once. old: m, ice before the step.
static int64_t set_up(Flow *f, const double *old, double years, int color, Equation *equation)
{
    const Landscape *land = f->land;
    double share = years / (land->cell * land->cell);
    int side = land->side;
    int64_t count = 0;
    for (int row = 0; row < side; row++) {
        for (int column = (row + color) % 2; column < side; column += 2) {
            int64_t i = (int64_t)row * side + column;
            double west = column > 0 ? share * f->along[i - 1] : 0.0;
            double north = row > 0 ? share * f->down[i - side] : 0.0;
            double east = share * f->along[i], south = share * f->down[i];
            double held = f->bed[i] + old[i] + years * f->gain[i];
            double all = 1.0 + west + north + east + south;
            if (west > 0.0 || north > 0.0 || east > 0.0 || south > 0.0) {
                equation[count++] = (Equation){i, held, west, north, east, south, all};
            } else {
                f->top[i] = held > f->bed[i] ? held : f->bed[i];
            }
        }
    }
    return count;
}

// One projected Gauss-Seidel update.
static void solve(Flow *f, const Equation *equation, int64_t count)
{
    int64_t side = f->land->side;
#pragma omp for schedule(static)
    for (int64_t k = 0; k < count; k++) {
        const Equation *q = &equation[k];
        double *here = f->top + q->at, bed = f->bed[q->at];
        double sum = q->held;
        sum += q->west > 0.0 ? q->west * here[-1] : 0.0;
        sum += q->north > 0.0 ? q->north * here[-side] : 0.0;
        sum += q->east > 0.0 ? q->east * here[1] : 0.0;
        sum += q->south > 0.0 ? q->south * here[side] : 0.0;
        double top = sum / q->all;
        *here = top > bed ? top : bed;
    }
}

// Lets the ice flow for some years, implicitly. old: m, ice before the step.
static void flow(Flow *f, const double *old, double years, int threads)
{
    enum { SWEEPS = 16 };
    Equation *const equation[2] = {f->equation, f->equation + landscape_count(f->land) / 2 + 1};
    int64_t count[2];
    for (int color = 0; color < 2; color++) {
        count[color] = set_up(f, old, years, color, equation[color]);
    }
#pragma omp parallel num_threads(threads)
    for (int k = 0; k < 2 * SWEEPS; k++) {
        solve(f, equation[k % 2], count[k % 2]);
    }
}

// One Gauss-Seidel update of every second sample of u - REACH^2 laplacian(u) = own on the ice,
// whose margin is a mirror.
static void drag_sweep(const Landscape *land, const double *ice, const double *own, double *slip,
                       int color, int threads)
{
    int side = land->side;
    double share = REACH * REACH / (land->cell * land->cell);
    const int64_t step[4] = {-1, 1, -side, side};
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int row = 0; row < side; row++) {
        for (int column = (row + color) % 2; column < side; column += 2) {
            int64_t i = (int64_t)row * side + column;
            const bool inside[4] = {column > 0, column + 1 < side, row > 0, row + 1 < side};
            double sum = 0.0, count = 0.0;
            for (int k = 0; k < 4; k++) {
                if (inside[k] && ice[i + step[k]] > THIN) {
                    sum += slip[i + step[k]];
                    count += 1.0;
                }
            }
            if (ice[i] > THIN) {
                slip[i] = (own[i] + share * sum) / (1.0 + share * count);
            }
        }
    }
}

// Curvature of the bed across the flow of the ice, 1 / m; positive in a trough.
static double curvature_across(const Flow *f, int64_t i)
{
    const Landscape *land = f->land;
    int side = land->side, column = (int)(i % side), row = (int)(i / side);
    if (column == 0 || row == 0 || column == side - 1 || row == side - 1) {
        return 0.0;
    }
    const double *z = f->bed + i;
    double gx = gradient(land, f->top, i, column, 1), gz = gradient(land, f->top, i, row, side);
    double squared = gx * gx + gz * gz, own = 1.0 / (land->cell * land->cell);
    double xx = (z[1] - 2.0 * z[0] + z[-1]) * own, zz = (z[side] - 2.0 * z[0] + z[-side]) * own;
    double xz = 0.25 * (z[side + 1] - z[side - 1] - z[1 - side] + z[-1 - side]) * own;
    return squared > 0.0 ? (gz * gz * xx - 2.0 * gx * gz * xz + gx * gx * zz) / squared
                         : 0.5 * (xx + zz);
}

static void find_slip(Glacier *glacier, const Flow *f, int threads)
{
    enum { SWEEPS = 30 };
    double *own = f->gain; // no longer needed
    int64_t count = landscape_count(f->land);
    int side = f->land->side;
    for (int64_t i = 0; i < count; i++) {
        double ice = glacier->ice[i], squared = 0.0;
        if (ice > 0.0) {
            squared = slope_squared(f->land, f->top, (int)(i % side), (int)(i / side));
        }
        squared = squared < STEEPEST * STEEPEST ? squared : STEEPEST * STEEPEST;
        double speed = SLIDE * ice * ice * squared * sqrt(squared);
        own[i] = speed < FASTEST ? speed : FASTEST;
        glacier->slip[i] = own[i];
    }
    for (int k = 0; k < 2 * SWEEPS; k++) {
        drag_sweep(f->land, glacier->ice, own, glacier->slip, k % 2, threads);
    }
    for (int64_t i = 0; i < count; i++) {
        double bent = curvature_across(f, i);
        glacier->slip[i] /= 1.0 + NARROW * (bent > 0.0 ? bent : 0.0);
    }
}

bool glacier_flow(Glacier *glacier, const Landscape *land, const GlacierParams *params,
                  double years, const Run *run, Error *e)
{
    const double LONGEST = 5.0; // a
    Flow f;
    bool done = flow_init(&f, land, e);
    for (double left = years; done && left > 0.0;) {
        double step = left < LONGEST ? left : LONGEST;
        for (int64_t i = 0; i < landscape_count(land); i++) {
            f.bed[i] = land->rock[i] + land->loose[i];
            f.top[i] = f.bed[i] + glacier->ice[i];
        }
        find_gain(&f, params, run->threads);
        find_diffusivity(&f, left == years, run->threads);
        flow(&f, glacier->ice, step, run->threads);
        for (int64_t i = 0; i < landscape_count(land); i++) {
            glacier->ice[i] = f.top[i] - f.bed[i];
        }
        left -= step;
        done = !run_is_cancelled(run) || run_cancel_error(e);
    }
    if (done) {
        find_slip(glacier, &f, run->threads);
    }
    flow_clear(&f);
    return done;
}

// How readily a sample takes till: thin ice that melts, and the ground just before it.
static double margin(const Glacier *glacier, const Landscape *land, const GlacierParams *params,
                     int64_t i)
{
    double ice = glacier->ice[i], top = land->rock[i] + land->loose[i] + ice;
    if (land->base[i] || ice <= 0.0 || ice > 80.0 || top > params->line) {
        return 0.0;
    }
    return (params->line - top) * (1.0 - ice / 80.0);
}

static void lay_till(const Glacier *glacier, Landscape *land, const GlacierParams *params,
                     double depth)
{
    double sum = 0.0;
    for (int64_t i = 0; i < landscape_count(land); i++) {
        sum += margin(glacier, land, params, i);
    }
    double share = sum > 0.0 ? params->till * depth / sum : 0.0, laid = 0.0;
    for (int64_t i = 0; share > 0.0 && i < landscape_count(land); i++) {
        double till = share * margin(glacier, land, params, i);
        land->loose[i] += till;
        laid += till;
    }
    land->outflow += (depth - laid) * land->cell * land->cell;
}

// The mean sliding speed about a sample: ice bears on its surroundings. The border mirrors.
static double mean_slip(const Glacier *glacier, const Landscape *land, int column, int row)
{
    int last = land->side - 1;
    int left = column > 0 ? column - 1 : 1, right = column < last ? column + 1 : last - 1;
    int above = row > 0 ? row - 1 : 1, below = row < last ? row + 1 : last - 1;
    const double *here = glacier->slip + (int64_t)row * land->side;
    const double *north = glacier->slip + (int64_t)above * land->side;
    const double *south = glacier->slip + (int64_t)below * land->side;
    return 0.25 * here[column] +
           0.125 * (here[left] + here[right] + north[column] + south[column]) +
           0.0625 * (north[left] + north[right] + south[left] + south[right]);
}

bool glacier_wear(Glacier *glacier, Landscape *land, const GlacierParams *params, double years,
                  Error *e)
{
    double *worn = memory_alloc_zero(landscape_count(land), sizeof *worn, e), depth = 0.0;
    if (!worn) {
        return false;
    }
    for (int64_t i = 0; i < landscape_count(land); i++) {
        if (!land->base[i] && glacier->ice[i] > 0.0) {
            double mean = mean_slip(glacier, land, (int)(i % land->side), (int)(i / land->side));
            worn[i] = params->erosion * years * mean * (double)land->weakness[i];
        }
    }
    for (int64_t i = 0; i < landscape_count(land); i++) {
        double loose = glacier->ice[i] > 20.0 ? land->loose[i] : 0.0;
        land->loose[i] -= loose;
        land->rock[i] -= worn[i];
        depth += worn[i] + loose;
    }
    lay_till(glacier, land, params, depth);
    free(worn);
    return true;
}
