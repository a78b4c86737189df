#include "land/shore.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "land/landscape_parts.h"
#include "land/shore_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double MOST_SPEED = 6.0; // of any rock, relative to ShoreParams.speed

// ---- made

double shore_beach_slope(const ShoreParams *p, double energy)
{
    // tan = 0.12 / sqrt(H / (sqrt(g D) T)); the period is that of waves 50 times as long as high.
    double height = p->wave_height * sqrt(energy > 0.05 ? energy : 0.05);
    double period = sqrt(6.283185307179586 * 50.0 * p->wave_height / 9.81);
    double number = height / (sqrt(9.81 * p->grain) * period);
    return 0.12 / sqrt(number);
}

double shore_platform(const Shore *shore, double x)
{
    return shore->high - shore->base * exact_log(1.0 + shore->slope * x / shore->base);
}

// Of the beds between low water and a little above high water.
static void find_soft(Shore *shore, const Landscape *land)
{
    enum { HEIGHTS = 4 };
    for (int64_t i = 0; i < landscape_count(land); i++) {
        double sum = 0.0;
        for (int k = 0; k < HEIGHTS; k++) {
            double y = shore->high * (2.0 * k / (HEIGHTS - 1) - 0.6);
            double hardness = landscape_hardness(land, landscape_bed(land, i, y));
            sum += landscape_erodibility(hardness) / landscape_erodibility(0.5);
        }
        shore->soft[i] = (float)(sum / HEIGHTS);
    }
}

Shore *shore_new(const ShoreParams *params, const Landscape *land, Error *e)
{
    Shore *shore = memory_alloc_zero(1, sizeof *shore, e);
    if (!shore) {
        return NULL;
    }
    int64_t count = landscape_count(land);
    shore->params = *params;
    shore->high = 0.5 * params->tide;
    shore->base = 0.5 * params->tide + 1.5 * params->wave_height;
    shore->slope = 0.010 + 0.004 * params->tide; // steeper where tides are large (Trenhaile 2000)
    // Waves run up a beach by its slope times sqrt(height * length) (Hunt 1959).
    shore->berm = shore->high + shore_beach_slope(params, 1.0) * sqrt(50.0) * params->wave_height;
    bool made = shore_waves_init(&shore->waves, land, e) &&
                (shore->front = memory_alloc(count, sizeof *shore->front, e)) &&
                (shore->speed = memory_alloc_zero(count, sizeof *shore->speed, e)) &&
                (shore->soft = memory_alloc(count, sizeof *shore->soft, e)) &&
                (shore->sand = memory_alloc_zero(count, sizeof *shore->sand, e));
    if (!made) {
        shore_free(shore);
        return NULL;
    }
    for (int64_t i = 0; i < count; i++) {
        shore->front[i] = INFINITY;
    }
    find_soft(shore, land);
    return shore;
}

void shore_free(Shore *shore)
{
    if (shore) {
        shore_waves_clear(&shore->waves);
        free(shore->front);
        free(shore->speed);
        free(shore->soft);
        free(shore->sand);
        free(shore);
    }
}

Shore *shore_refined(const Shore *shore, const Landscape *finer, Error *e)
{
    Shore *next = shore_new(&shore->params, finer, e);
    int coarse = (finer->side - 1) / 2 + 1;
    for (int64_t i = 0; next && i < landscape_count(finer); i++) {
        int64_t column = i % finer->side, row = i / finer->side;
        const double *f = shore->front + row / 2 * coarse + column / 2;
        int64_t right = column % 2, down = row % 2 == 0 ? 0 : coarse;
        next->front[i] = 0.25 * (f[0] + f[right] + f[down] + f[right + down]);
    }
    if (next) {
        next->pool = shore->pool;
        next->beach = shore->beach;
    }
    return next;
}

// ---- the front

static double front_at(const Shore *shore, const Landscape *land, int column, int row)
{
    int last = land->side - 1;
    column = column < 0 ? 0 : column > last ? last : column;
    row = row < 0 ? 0 : row > last ? last : row;
    return shore->front[(int64_t)row * land->side + column];
}

// How fast the front moves at a sample, relative to ShoreParams.speed, before the rock counts.
// Waves work by their energy at the front nearby, most where they come in head-on.
static double drive(const Shore *shore, const Landscape *land, int column, int row)
{
    double off = front_at(shore, land, column, row) / land->cell;
    double nx = front_at(shore, land, column + 1, row) - front_at(shore, land, column - 1, row);
    double nz = front_at(shore, land, column, row + 1) - front_at(shore, land, column, row - 1);
    double length = sqrt(nx * nx + nz * nz);
    nx = length > 0.0 ? nx / length : 0.0;
    nz = length > 0.0 ? nz / length : 0.0;
    WavesAt waves = shore_waves_at(shore, land, column - off * nx, row - off * nz);
    double onto = waves.flux[0] * nx + waves.flux[1] * nz;
    double work = (0.35 * waves.energy + 0.65 * (onto > 0.0 ? onto : 0.0)) * waves.focus;
    double dry = shore_beach_width(shore, &waves);
    return (work > 0.04 ? work : 0.04) / (1.0 + 0.1 * (dry > 0.0 ? dry : 0.0));
}

static void find_speeds(Shore *shore, const Landscape *land, int threads)
{
    const double far = 12.0 * land->cell;
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int row = 0; row < land->side; row++) {
        for (int column = 0; column < land->side; column++) {
            int64_t i = (int64_t)row * land->side + column;
            shore->speed[i] = 0.0f;
            if (shore->front[i] > far || shore->front[i] < -far) {
                continue;
            }
            double rock = (double)(shore->soft[i] * land->weakness[i]);
            double pace = drive(shore, land, column, row) * rock / (1.0 + 0.12 * land->loose[i]);
            pace = pace < MOST_SPEED ? pace : MOST_SPEED;
            shore->speed[i] = (float)(shore->params.speed * pace);
        }
    }
}

// How much a sample rises over the lowest beside it along both axes, per metre.
static double upwind(const Shore *shore, const Landscape *land, int column, int row)
{
    double here = front_at(shore, land, column, row);
    double west = front_at(shore, land, column - 1, row);
    double east = front_at(shore, land, column + 1, row);
    double north = front_at(shore, land, column, row - 1);
    double south = front_at(shore, land, column, row + 1);
    double x = here - (west < east ? west : east), z = here - (north < south ? north : south);
    x = x > 0.0 ? x : 0.0;
    z = z > 0.0 ? z : 0.0;
    return sqrt(x * x + z * z) / land->cell;
}

double shore_step_limit(const Shore *shore, const Landscape *land)
{
    return 2.0 * land->cell / (MOST_SPEED * shore->params.speed);
}

// d front / dt = -speed |grad front| (Godunov's upwind differences).
static bool advance(Shore *shore, const Landscape *land, double time, const Run *run, Error *e)
{
    enum { PARTS = 4 }; // of a step: in each the front moves by half a cell or less
    double *next = memory_alloc(landscape_count(land), sizeof *next, e);
    for (int part = 0; next && part < PARTS; part++) {
#pragma omp parallel for schedule(static) num_threads(run->threads)
        for (int row = 0; row < land->side; row++) {
            for (int column = 0; column < land->side; column++) {
                int64_t i = (int64_t)row * land->side + column;
                double speed = (double)shore->speed[i];
                next[i] = shore->front[i];
                if (speed > 0.0) {
                    next[i] -= time / PARTS * speed * upwind(shore, land, column, row);
                }
            }
        }
        double *old = shore->front;
        shore->front = next;
        next = old;
    }
    bool done = next;
    if (done) {
        shore_measure_front(shore, land, next);
    }
    free(next);
    return done;
}

// ---- what waves have reached

// Planes a sample down for a time; what it loses, m. On a shore that retreats at speed v the rock
// sinks by slope * v where it is at high water, and by e less for each `base` deeper.
static double plane(const Shore *shore, Landscape *land, int column, int row, double time)
{
    int64_t i = (int64_t)row * land->side + column;
    double lost = 0.0;
    if (land->rock[i] > shore->high) { // just reached
        lost = land->rock[i] - shore->high;
        land->rock[i] = shore->high;
    }
    double energy = shore_waves_at(shore, land, column, row).energy;
    double washed = 1.5 * time * shore->params.speed * energy;
    washed = washed < land->loose[i] ? washed : land->loose[i];
    land->loose[i] -= washed;
    double hardness = landscape_hardness(land, landscape_bed(land, i, land->rock[i]));
    double pace = energy * (double)land->weakness[i] * landscape_erodibility(hardness) /
                  landscape_erodibility(0.5);
    pace *= shore->params.speed / (1.0 + land->loose[i] + shore->sand[i]);
    double depth = (shore->high - land->rock[i]) / shore->base;
    if (depth < 20.0) {
        double grown = exact_exp(depth) + shore->slope * pace * time / shore->base;
        double rock = shore->high - shore->base * exact_log(grown);
        if (rock < land->rock[i]) {
            lost += land->rock[i] - rock;
            land->rock[i] = rock;
        }
    }
    return lost + washed;
}

static bool cut(Shore *shore, Landscape *land, double time, const Run *run, Error *e)
{
    double *lost = memory_alloc_zero(land->side, sizeof *lost, e);
    if (!lost) {
        return false;
    }
#pragma omp parallel for schedule(dynamic, 8) num_threads(run->threads)
    for (int row = 0; row < land->side; row++) {
        for (int column = 0; column < land->side; column++) {
            if (shore->front[(int64_t)row * land->side + column] <= 0.0) {
                lost[row] += plane(shore, land, column, row, time);
            }
        }
    }
    double own = land->cell * land->cell;
    for (int row = 0; row < land->side; row++) {
        shore->pool += shore->params.sand * lost[row] * own;
        land->outflow += (1.0 - shore->params.sand) * lost[row] * own;
    }
    free(lost);
    return true;
}

// Cliffs weather and fall; of what leaves them the same share is sand.
static bool crumble(Shore *shore, Landscape *land, const LandscapeRates *slopes, double time,
                    const Run *run, Error *e)
{
    double before = land->outflow;
    bool done = landscape_slopes_only(land, slopes, time, run, e);
    double sand = shore->params.sand * (land->outflow - before);
    shore->pool += sand;
    land->outflow -= sand;
    return done;
}

bool shore_step(Shore *shore, Landscape *land, const LandscapeRates *slopes, double time,
                const Run *run, Error *e)
{
    enum { ROUNDS = 14 };
    if (run_is_cancelled(run)) {
        return run_cancel_error(e);
    }
    if (!shore_find_waves(shore, land, e) || !shore_find_beach(shore, land, ROUNDS, run, e)) {
        return false;
    }
    find_speeds(shore, land, run->threads);
    return advance(shore, land, time, run, e) && cut(shore, land, time, run, e) &&
           crumble(shore, land, slopes, time, run, e);
}
