// Creep of all the land, as of ground that turns to soil faster than it creeps away.
#include "base/memory.h"
#include "land/landscape_parts.h"

#include <stdlib.h>

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
