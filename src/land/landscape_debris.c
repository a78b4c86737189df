// Debris flows and rockfall along the ways of the water: they cut couloirs into steep rock and
// build cones of talus and fans where the ground grows gentle.
//
// Steep catchments are scoured at E = K A^1/4 (S - S0), S0 the slope at which debris comes to rest:
// unlike that of streams, the exponent of the area is small (Stock and Dietrich 2003, 2006). Debris
// rests at the angle of repose below the chutes of a face, and on fans the gentler the larger the
// catchment (Melton 1965). Heights are found implicitly from the bases up, as in
// landscape_streams.c; then debris is handed down, and what lies loose on steeper ground goes with
// it.
#include "base/memory.h"
#include "land/landscape_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double TALUS_AREA = 4.0e4; // m^2: debris of less rests at its angle of repose
static const double FLATTEST = 0.08;    // of fans
static const double COARSE = 0.5;       // share of the rubble that is not ground to mud on its way

// The slope at which debris of a catchment comes to rest.
static double resting_slope(double area, double repose)
{
    double share = area > TALUS_AREA ? sqrt(sqrt(TALUS_AREA / area)) : 1.0;
    double least = repose < FLATTEST ? repose : FLATTEST;
    return repose * share > least ? repose * share : least;
}

static double way_length(const Landscape *land, int32_t i, int32_t to)
{
    int32_t step = to > i ? to - i : i - to;
    bool straight = step == 1 || step == land->side;
    return land->cell * (straight ? 1.0 : 1.4142135623730951);
}

// m by which debris scours the rock of sample i, whose receiver lies at `below` after the step.
static double scour(const Landscape *land, const LandscapeRates *rates, int32_t i, double length,
                    double below, double time)
{
    double area = land->route->area[i], top = land->rock[i];
    double rest = below + length * resting_slope(area, rates->repose);
    if (top + land->loose[i] <= rest || top <= below) {
        return 0.0;
    }
    double gathers = area / (area + rates->least_debris);
    double hardness = landscape_hardness(land, landscape_bed(land, i, top));
    double speed = rates->debris * gathers * sqrt(sqrt(area)) * landscape_erodibility(hardness) *
                   (double)land->weakness[i];
    double covered = 1.0 / (1.0 + 0.5 * land->loose[i]);
    double k = speed * covered * time / length;
    double height = (top + k * rest) / (1.0 + k);
    height = height > below ? height : below;
    return top > height ? top - height : 0.0;
}

// Fills `dug`: m of rock that each sample loses. top: m, of each sample afterwards.
static void find_scour(const Landscape *land, const LandscapeRates *rates, double time, double *dug,
                       double *top)
{
    const Routing *route = land->route;
    for (int64_t k = 0; k < route->count; k++) {
        int32_t i = route->order[k], to = route->receiver[i];
        dug[i] = to == i ? 0.0 : scour(land, rates, i, way_length(land, i, to), top[to], time);
        top[i] = land->rock[i] + land->loose[i] - dug[i];
    }
}

// Hands debris down. load: m^3 that reaches each sample; settled: m that come to rest there.
static void hand_down(Landscape *land, const LandscapeRates *rates, const double *dug, double *load,
                      double *settled)
{
    const double settles = 0.5; // share of the room that one step fills
    double coarse = COARSE * rates->rubble;
    const Routing *route = land->route;
    double own = land->cell * land->cell;
    for (int64_t k = route->count - 1; k >= 0; k--) {
        int32_t i = route->order[k], to = route->receiver[i];
        if (to == i) {
            land->outflow += load[i];
            continue;
        }
        land->rock[i] -= dug[i];
        land->outflow += (1.0 - coarse) * dug[i] * own;
        double arrived = load[i] / own + coarse * dug[i];
        double fall = land->rock[i] + land->loose[i] - (land->rock[to] + land->loose[to]);
        double rest = way_length(land, i, to) * resting_slope(route->area[i], rates->repose);
        double over = fall - rest;
        if (over > 0.0) {
            double gone = settles * over < land->loose[i] ? settles * over : land->loose[i];
            land->loose[i] -= gone;
            arrived += gone;
        } else {
            double kept = -settles * over < arrived ? -settles * over : arrived;
            settled[i] = kept;
            arrived -= kept;
        }
        load[to] += arrived * own;
    }
}

// Fills `slope`: that above which what has settled spreads. On steep ground grains come to rest
// near their angle of repose; on gentle ground, where flows and streams lay them down, all spread.
static void find_spreading(const Landscape *land, double repose, double *slope)
{
    const double gentle = 0.85, steep = 1.0, rests = 0.95; // shares of the repose
    for (int64_t i = 0; i < landscape_count(land); i++) {
        int32_t to = land->route->receiver[i];
        double fall = land->rock[i] + land->loose[i] - (land->rock[to] + land->loose[to]);
        double lies = to == (int32_t)i ? 0.0 : fall / (way_length(land, (int32_t)i, to) * repose);
        double share = (lies - gentle) / (steep - gentle);
        slope[i] = rests * repose * (share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share);
    }
}

// Flows leave their way where they come to rest: what has settled spreads downhill beside it, which
// makes cones and fans of it.
typedef struct Spread {
    const Landscape *land;
    double *ground;         // m: rock and loose cover
    double *settled, *next; // m: before and after a turn
    double *top;            // m: ground and what has settled
    double *slope;          // on which what has settled rests
} Spread;

// What a row gains in a turn. Loops run along the row, direction by direction, so that they can be
// vectorized.
static void spread_row(const Spread *s, int row)
{
    const Landscape *land = s->land;
    int64_t first = (int64_t)row * land->side;
    const double *top = s->top + first, *settled = s->settled + first, *slope = s->slope + first;
    const uint8_t *base = land->base + first;
    double *gained = s->next + first;
    memset(gained, 0, sizeof *gained * (size_t)land->side);
    for (int k = 0; k < 9; k++) {
        int dx = k % 3 - 1, r = row + k / 3 - 1;
        if (k == 4 || r < 0 || r >= land->side) {
            continue;
        }
        int64_t offset = (int64_t)(r - row) * land->side + dx;
        int end = dx > 0 ? land->side - 1 : land->side;
        double way = k % 2 == 0 ? 1.4142135623730951 : 1.0; // in cells
#pragma omp simd
        for (int c = dx < 0 ? 1 : 0; c < end; c++) {
            double drop = top[c] - top[c + offset];
            double from = drop > 0.0 ? settled[c] : settled[c + offset];
            double rest = (drop > 0.0 ? slope[c] : slope[c + offset]) * land->cell;
            double over = (drop > 0.0 ? drop : -drop) - way * rest;
            double size = over > 0.0 ? over : 0.0;
            double moves = 0.11 * (size < from ? size : from);
            moves = base[c] || base[c + offset] ? 0.0 : moves;
            gained[c] += drop > 0.0 ? -moves : moves;
        }
    }
    for (int c = 0; c < land->side; c++) {
        gained[c] = settled[c] + gained[c];
    }
}

static void spread(Spread *s, int threads)
{
    enum { TIMES = 8 }; // even: the last turn ends in the array that was given
    const Landscape *land = s->land;
    int64_t count = landscape_count(land);
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int64_t i = 0; i < count; i++) {
        s->ground[i] = land->rock[i] + land->loose[i];
    }
    for (int k = 0; k < TIMES; k++) {
#pragma omp parallel num_threads(threads)
        {
#pragma omp for schedule(static)
            for (int64_t i = 0; i < count; i++) {
                s->top[i] = s->ground[i] + s->settled[i];
            }
#pragma omp for schedule(static)
            for (int row = 0; row < land->side; row++) {
                spread_row(s, row);
            }
        }
        double *swap = s->settled;
        s->settled = s->next;
        s->next = swap;
    }
}

bool landscape_debris(Landscape *land, const LandscapeRates *rates, double time, const Run *run,
                      Error *e)
{
    if (rates->debris <= 0.0) {
        return true;
    }
    int64_t count = landscape_count(land);
    double *dug = memory_alloc_zero(count, sizeof *dug, e);
    double *load = dug ? memory_alloc_zero(count, sizeof *load, e) : NULL;
    double *settled = load ? memory_alloc_zero(count, sizeof *settled, e) : NULL;
    double *top = settled ? memory_alloc(count, sizeof *top, e) : NULL;
    double *slope = top ? memory_alloc(count, sizeof *slope, e) : NULL;
    if (slope) {
        find_scour(land, rates, time, dug, top);
        hand_down(land, rates, dug, load, settled);
        find_spreading(land, rates->repose, slope);
        spread(&(Spread){land, dug, settled, load, top, slope}, run->threads);
        for (int64_t i = 0; i < count; i++) {
            land->loose[i] += settled[i];
        }
    }
    bool done = slope;
    free(slope);
    free(top);
    free(settled);
    free(load);
    free(dug);
    return done;
}
