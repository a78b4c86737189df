#include "land/landscape.h"

#include "base/memory.h"
#include "land/landscape_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void landscape_lay_stack(Landscape *land)
{
    for (int64_t i = 0; land->strata && i < landscape_count(land); i++) {
        double x = land->corner + (double)(i % land->side) * land->cell;
        int64_t row = i / land->side;
        double z = land->corner + (double)row * land->cell;
        land->stack[i] = strata_base(land->strata, (float)x, (float)z);
    }
}

Landscape *landscape_new(int cells, double size, const Strata *strata, Error *e)
{
    Landscape *land = memory_alloc_zero(1, sizeof *land, e);
    if (!land) {
        return NULL;
    }
    *land = (Landscape){
        .side = cells + 1, .cell = size / cells, .corner = -0.5 * size, .strata = strata};
    int64_t count = landscape_count(land);
    bool made = (land->rock = memory_alloc_zero(count, sizeof *land->rock, e)) &&
                (land->loose = memory_alloc_zero(count, sizeof *land->loose, e)) &&
                (land->load = memory_alloc_zero(count, sizeof *land->load, e)) &&
                (land->base = memory_alloc_zero(count, 1, e)) &&
                (land->weakness = memory_alloc(count, sizeof *land->weakness, e)) &&
                (land->stack = memory_alloc_zero(count, sizeof *land->stack, e));
    if (!made) {
        landscape_free(land);
        return NULL;
    }
    for (int64_t i = 0; i < count; i++) {
        land->weakness[i] = 1.0f;
    }
    landscape_lay_stack(land);
    return land;
}

void landscape_free(Landscape *land)
{
    if (land) {
        free(land->rock);
        free(land->loose);
        free(land->load);
        free(land->base);
        free(land->weakness);
        free(land->stack);
        routing_free(land->route);
        free(land);
    }
}

double landscape_erodibility(double hardness)
{
    double soft = 1.0 - hardness;
    return 0.06 + 0.94 * soft * soft;
}

void landscape_set_base(Landscape *land, int64_t i, double height)
{
    double removed = land->rock[i] + land->loose[i] - height;
    land->outflow += removed * land->cell * land->cell;
    land->rock[i] = height;
    land->loose[i] = 0.0;
    land->base[i] = 1;
}

static void lift(Landscape *land, double rise)
{
    double own = land->cell * land->cell;
    for (int64_t i = 0; i < landscape_count(land) && rise != 0.0; i++) {
        if (!land->base[i]) {
            land->rock[i] += rise;
            land->uplifted += rise * own;
        }
    }
}

bool landscape_step(Landscape *land, const LandscapeRates *rates, double time, bool reroute,
                    const Run *run, Error *e)
{
    if (run_is_cancelled(run)) {
        return run_cancel_error(e);
    }
    lift(land, rates->uplift * time);
    if ((reroute || !land->route) && !landscape_find_route(land, rates->seed, run, e)) {
        return false;
    }
    return landscape_streams(land, rates, time, e) && landscape_debris(land, rates, time, run, e) &&
           landscape_slopes(land, rates, time, run, e);
}

bool landscape_cut_streams(Landscape *land, const LandscapeRates *rates, double time,
                           const Run *run, Error *e)
{
    if (run_is_cancelled(run)) {
        return run_cancel_error(e);
    }
    lift(land, rates->uplift * time);
    return landscape_find_route(land, rates->seed, run, e) &&
           landscape_streams(land, rates, time, e);
}

bool landscape_slopes_only(Landscape *land, const LandscapeRates *rates, double time,
                           const Run *run, Error *e)
{
    return landscape_slopes(land, rates, time, run, e);
}

HeightField *landscape_heights(const Landscape *land, Error *e)
{
    float cell = (float)land->cell, corner = (float)land->corner;
    HeightField *field =
        height_field_new(land->side, land->side, (Vec2){cell, cell}, (Vec2){corner, corner}, e);
    for (int64_t i = 0; field && i < landscape_count(land); i++) {
        field->height[i] = (float)(land->rock[i] + land->loose[i]);
    }
    return field;
}

double landscape_volume(const Landscape *land)
{
    double sum = 0.0;
    for (int row = 0; row < land->side; row++) {
        double line = 0.0;
        for (int column = 0; column < land->side; column++) {
            int64_t i = (int64_t)row * land->side + column;
            line += land->rock[i] + land->loose[i];
        }
        sum += line;
    }
    return sum * land->cell * land->cell + land->outflow - land->uplifted;
}

// ---- between samples

static int clamp_index(int i, int count)
{
    return i < 0 ? 0 : i >= count ? count - 1 : i;
}

static double catmull_rom(const double h[4], double t)
{
    double a = 0.5 * (h[2] - h[0]), b = h[0] - 2.5 * h[1] + 2.0 * h[2] - 0.5 * h[3];
    double c = 0.5 * (h[3] - h[0]) + 1.5 * (h[1] - h[2]);
    return h[1] + t * (a + t * (b + t * c));
}

static int locate(double x, const Landscape *land, double *share)
{
    double t = (x - land->corner) / land->cell, last = (double)(land->side - 1);
    t = t < 0.0 ? 0.0 : t > last ? last : t;
    int i = (int)t;
    i = i > land->side - 2 ? land->side - 2 : i;
    *share = t - (double)i;
    return i;
}

double landscape_at(const Landscape *land, double x, double z, double *loose)
{
    double u, v, rows[4], cover[2];
    int column = locate(x, land, &u), row = locate(z, land, &v);
    double base = land->strata ? (double)strata_base(land->strata, (float)x, (float)z) : 0.0;
    for (int j = 0; j < 4; j++) {
        int64_t first = (int64_t)clamp_index(row + j - 1, land->side) * land->side;
        double four[4];
        for (int k = 0; k < 4; k++) {
            int64_t i = first + clamp_index(column + k - 1, land->side);
            four[k] = land->strata ? strata_run(land->strata, land->rock[i] - base) : land->rock[i];
        }
        rows[j] = catmull_rom(four, u);
    }
    double run = catmull_rom(rows, v);
    for (int j = 0; j < 2; j++) {
        const double *at = land->loose + (int64_t)(row + j) * land->side + column;
        cover[j] = at[0] + u * (at[1] - at[0]);
    }
    *loose = cover[0] + v * (cover[1] - cover[0]);
    return (land->strata ? strata_level(land->strata, run) + base : run) + *loose;
}

Landscape *landscape_refined(const Landscape *land, const Run *run, Error *e)
{
    int cells = 2 * (land->side - 1);
    Landscape *finer = landscape_new(cells, land->cell * (land->side - 1), land->strata, e);
    if (!finer) {
        return NULL;
    }
#pragma omp parallel for schedule(dynamic, 4) num_threads(run->threads)
    for (int row = 0; row < finer->side; row++) {
        for (int column = 0; column < finer->side; column++) {
            int64_t i = (int64_t)row * finer->side + column;
            double loose, x = finer->corner + column * finer->cell;
            double height = landscape_at(land, x, finer->corner + row * finer->cell, &loose);
            finer->loose[i] = loose;
            finer->rock[i] = height - loose;
        }
    }
    return finer;
}

double landscape_scale_relief(Landscape *land, double relief)
{
    double high = 0.0;
    for (int64_t i = 0; i < landscape_count(land); i++) {
        high = land->rock[i] > high ? land->rock[i] : high;
    }
    double scale = high > 0.0 ? relief / high : 1.0;
    for (int64_t i = 0; i < landscape_count(land); i++) {
        land->rock[i] *= scale;
        land->loose[i] *= scale;
    }
    land->outflow *= scale;
    land->uplifted *= scale;
    return scale;
}

// Lowers sample i to what the four neighbours that a sweep has passed allow; ahead: 1 or -1, the
// sweep's direction. Samples are walked so that the neighbours are inside.
static void fell_sample(Landscape *land, int row, int column, int ahead, double slope)
{
    static const int from[4][2] = {{0, -1}, {-1, -1}, {-1, 0}, {-1, 1}}; // row, column
    int64_t i = (int64_t)row * land->side + column;
    double most = land->rock[i] + land->loose[i];
    for (int k = 0; k < 4; k++) {
        int r = row + ahead * from[k][0], c = column + ahead * from[k][1];
        if (r < 0 || c < 0 || r >= land->side || c >= land->side) {
            continue;
        }
        int64_t near = (int64_t)r * land->side + c;
        double away = k % 2 == 1 ? sqrt(2.0) : 1.0;
        most = fmin(most, land->rock[near] + land->loose[near] + slope * land->cell * away);
    }
    double fallen = land->rock[i] + land->loose[i] - most;
    if (fallen > 0.0 && !land->base[i]) {
        double loose = fmin(land->loose[i], fallen);
        land->loose[i] -= loose;
        land->rock[i] -= fallen - loose;
        land->outflow += fallen * land->cell * land->cell;
    }
}

// Two sweeps of a chamfer distance transform (Borgefors 1986): one in reading order, one back.
void landscape_fell(Landscape *land, double slope)
{
    int64_t count = landscape_count(land);
    for (int64_t i = 0; i < count; i++) {
        fell_sample(land, (int)(i / land->side), (int)(i % land->side), 1, slope);
    }
    for (int64_t i = count - 1; i >= 0; i--) {
        fell_sample(land, (int)(i / land->side), (int)(i % land->side), -1, slope);
    }
}
