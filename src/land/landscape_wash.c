// What water leaves on the floors of valleys, and what mud and gravity do to walls of rills.
#include "base/memory.h"
#include "land/landscape_parts.h"

#include <math.h>
#include <stdlib.h>

// ---- creep of all the land

// One explicit step of dh/dt = D laplace(h): r = D t / cell^2 <= 1/4. Nothing crosses the border.
static void round_once(const Landscape *land, double *next, double r, int threads)
{
    int side = land->side;
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int row = 0; row < side; row++) {
        const double *h = land->rock + (int64_t)row * side;
        const double *north = row > 0 ? h - side : h, *south = row < side - 1 ? h + side : h;
        for (int column = 0; column < side; column++) {
            double west = h[column > 0 ? column - 1 : column];
            double east = h[column < side - 1 ? column + 1 : column];
            double around = north[column] + south[column] + west + east;
            int64_t i = (int64_t)row * side + column;
            next[i] = land->base[i] ? h[column] : h[column] + r * (around - 4.0 * h[column]);
        }
    }
}

static double rock_sum(const Landscape *land)
{
    double sum = 0.0;
    for (int64_t i = 0; i < landscape_count(land); i++) {
        sum += land->rock[i];
    }
    return sum;
}

bool landscape_round(Landscape *land, double diffusion, const Run *run, Error *e)
{
    double *next = memory_alloc(landscape_count(land), sizeof *next, e);
    if (!next) {
        return false;
    }
    double whole = diffusion / (land->cell * land->cell), before = rock_sum(land);
    int steps = 1 + (int)(whole / 0.2);
    for (int i = 0; i < steps; i++) {
        round_once(land, next, whole / steps, run->threads);
        double *old = land->rock;
        land->rock = next;
        next = old;
    }
    land->outflow += (before - rock_sum(land)) * land->cell * land->cell;
    free(next);
    return true;
}

// ---- washes

bool landscape_lay_wash(Landscape *land, const LandscapeWash *wash, const Run *run, Error *e)
{
    const double hectare = 1e4;
    if (!landscape_find_route(land, wash->seed, run, e)) {
        return false;
    }
    const Routing *route = land->route;
    double own = land->cell * land->cell;
    for (int64_t k = 0; k < route->count; k++) {
        int32_t i = route->order[k], to = route->receiver[i];
        if (to == i) {
            continue;
        }
        int32_t step = to > i ? to - i : i - to;
        double length = step == 1 || step == land->side ? land->cell : sqrt(2.0) * land->cell;
        double area = route->area[i];
        double slope =
            area > wash->least_area ? wash->slope * sqrt(sqrt(hectare / area)) : wash->across;
        double level = land->rock[to] + land->loose[to] + slope * length;
        double laid = level - (land->rock[i] + land->loose[i]);
        if (laid > 0.0) {
            land->loose[i] += laid;
            land->outflow -= laid * own;
        }
    }
    return true;
}
