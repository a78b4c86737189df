// Avalanches: what is steeper than the angle of repose slides down its own gradient. And the slow
// creep of the grains that the wind moves.
#include "base/memory.h"
#include "land/dunes_parts.h"

#include <stdlib.h>

typedef struct Slope {
    const Dunes *dunes;
    double repose; // tangent
    double creep;  // units of time; 0 = none
} Slope;

// Sand that crosses from a sample to the next along an axis in one sweep, m. The gradient across is
// the mean of both samples', so that slip faces in any direction have one slope.
static double slip(const Slope *s, int64_t here, int64_t next, const int64_t beside[4])
{
    const double *h = s->dunes->sand;
    double cell = s->dunes->cell, along = (h[here] - h[next]) / cell, part = 0.0;
    if (s->creep > 0.0) {
        part = s->creep * 0.5 * (s->dunes->flux[here] + s->dunes->flux[next]) * along / cell;
    }
    double across = (h[beside[0]] - h[beside[1]] + h[beside[2]] - h[beside[3]]) / (4.0 * cell);
    double square = along * along + across * across;
    if (square > s->repose * s->repose) {
        part += 0.18 * cell * along * (1.0 - s->repose / sqrt(square));
    }
    if (part == 0.0) { // in most samples; the limits are calls
        return 0.0;
    }
    // Not below the plain.
    return fmax(fmin(part, 0.25 * fmax(h[here], 0.0)), -0.25 * fmax(h[next], 0.0));
}

// moved: 2 a sample, what goes to the east and to the south.
static void move_once(Dunes *dunes, const Slope *slope, double *moved, const Run *run)
{
    int side = dunes->side, mask = side - 1;
    double *h = dunes->sand;
#pragma omp parallel for schedule(static) num_threads(dunes_threads(dunes, run))
    for (int row = 0; row < side; row++) {
        int64_t at = (int64_t)row * side, north = (int64_t)((row - 1) & mask) * side;
        int64_t south = (int64_t)((row + 1) & mask) * side;
        for (int x = 0; x < side; x++) {
            int east = (x + 1) & mask, west = (x - 1) & mask;
            const int64_t by_row[4] = {north + x, south + x, north + east, south + east};
            const int64_t by_column[4] = {at + west, at + east, south + west, south + east};
            moved[2 * (at + x)] = slip(slope, at + x, at + east, by_row);
            moved[2 * (at + x) + 1] = slip(slope, at + x, south + x, by_column);
        }
    }
#pragma omp parallel for schedule(static) num_threads(dunes_threads(dunes, run))
    for (int row = 0; row < side; row++) {
        int64_t at = (int64_t)row * side, north = (int64_t)((row - 1) & mask) * side;
        for (int x = 0; x < side; x++) {
            h[at + x] += moved[2 * (at + ((x - 1) & mask))] - moved[2 * (at + x)] +
                         moved[2 * (north + x) + 1] - moved[2 * (at + x) + 1];
        }
    }
}

bool dunes_settle(Dunes *dunes, double creep, double repose, int sweeps, const Run *run, Error *e)
{
    double *moved = memory_alloc(2 * dunes_count(dunes), sizeof *moved, e);
    for (int sweep = 0; moved && sweep < sweeps; sweep++) {
        Slope slope = {.dunes = dunes, .repose = repose, .creep = sweep == 0 ? creep : 0.0};
        move_once(dunes, &slope, moved, run);
    }
    free(moved);
    return moved;
}

bool dunes_slide(Dunes *dunes, double repose, int sweeps, const Run *run, Error *e)
{
    return dunes_settle(dunes, 0.0, repose, sweeps, run, e);
}
