#include "land/dunes.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "land/dunes_parts.h"

#include <stdlib.h>

#define CREEP 0.2 // m^2 of flux down a slope of 1, by the flux of the wind
#define SEED \
    0.03 // share of the saturated flux that the wind lifts without grains that eject others
#define THIN 0.01 // cells: less sand than this does not soften the ground
#define STEP 0.12 // time a cell and a saturation length: waves travel less than half a cell in it

Dunes *dunes_new(int side, double size, Error *e)
{
    Dunes *dunes = memory_alloc_zero(1, sizeof *dunes, e);
    if (!dunes) {
        return NULL;
    }
    int64_t count = (int64_t)side * side;
    dunes->side = side;
    dunes->cell = size / side;
    dunes->sand = memory_alloc_zero(count, sizeof *dunes->sand, e);
    dunes->envelope = memory_alloc_zero(count, sizeof *dunes->envelope, e);
    dunes->shear = memory_alloc_zero(2 * count, sizeof *dunes->shear, e);
    dunes->flux = memory_alloc_zero(count, sizeof *dunes->flux, e);
    dunes->wave = memory_alloc_zero(count, sizeof *dunes->wave, e);
    dunes->seam = memory_alloc_zero(side, sizeof *dunes->seam, e);
    dunes->root = fft_roots(side, e);
    if (!dunes->sand || !dunes->envelope || !dunes->shear || !dunes->flux || !dunes->wave ||
        !dunes->seam || !dunes->root) {
        dunes_free(dunes);
        return NULL;
    }
    return dunes;
}

void dunes_free(Dunes *dunes)
{
    if (dunes) {
        free(dunes->sand);
        free(dunes->envelope);
        free(dunes->shear);
        free(dunes->flux);
        free(dunes->wave);
        free(dunes->seam);
        free(dunes->root);
        free(dunes);
    }
}

double dunes_volume(const Dunes *dunes)
{
    double sum = 0.0;
    for (int64_t i = 0; i < dunes_count(dunes); i++) {
        sum += dunes->sand[i];
    }
    return sum * dunes->cell * dunes->cell;
}

// ---- sand in the wind

// The saturated flux, m^2, through 1 m across the wind; 1 over a plain (Iversen and Rasmussen 1999
// in the form of Duran and Herrmann 2006: sqrt(shear) * (shear - threshold)).
static double saturated(const double shear[2], double threshold)
{
    double stress = sqrt(shear[0] * shear[0] + shear[1] * shear[1]);
    return stress > threshold ? sqrt(stress) * (stress - threshold) / (1.0 - threshold) : 0.0;
}

typedef struct Sweep {
    Dunes *dunes;
    Crossing crossing;
    double threshold;
    double approach; // share of the way to saturation that the flux goes from line to line
    double lift;     // m^2 of flux that carries off 1 m of sand in the step
    bool settles;    // the sand changes, else only the flux is found
} Sweep;

// What arrives at a sample goes on with more sand or less, and what it carries to the next line
// falls on two neighbours there.
static void carry(const Sweep *s, int line, int place, double *next)
{
    const Crossing *c = &s->crossing;
    int64_t i = crossing_index(c, line, place), mask = c->side - 1;
    const double *shear = &s->dunes->shear[2 * i];
    double arrives = s->dunes->flux[i];
    double full = saturated(shear, s->threshold) * c->along;
    double leaves = 0.0;
    if (arrives < full) { // grains that fly eject others; the wind itself lifts a few
        double q = fmax(arrives, SEED * full);
        leaves = full * q / (q + (full - q) * (1.0 - s->approach));
    } else {
        leaves = arrives + (full - arrives) * s->approach;
    }
    double sand = s->dunes->sand[i], most = arrives + sand * s->lift;
    leaves = fmax(fmin(leaves, most), 0.0);
    if (s->settles) {
        s->dunes->sand[i] += (arrives - leaves) / s->lift;
    }
    double drift = c->drift;
    if (shear[0] > 0.2) { // the air goes around hills
        double turn = fmin(fmax(shear[1] / shear[0], -0.7), 0.7);
        turn = c->by_column == c->backward ? -turn : turn;
        drift += turn * (1.0 + drift * drift) / fmax(1.0 - turn * drift, 0.3);
    }
    double low = floor(drift), t = drift - low;
    int64_t to = place + (int64_t)low;
    double wide = sand < THIN * s->dunes->cell ? leaves / 6.0 : 0.0;
    leaves -= 4.0 * wide;
    next[to & mask] += (1.0 - t) * leaves;
    next[(to + 1) & mask] += t * leaves;
    for (int side = -2; wide > 0.0 && side <= 2; side++) { // grains bounce aside on hard ground
        if (side != 0) {
            next[(to + side) & mask] += (1.0 - t) * wide;
            next[(to + side + 1) & mask] += t * wide;
        }
    }
}

// Once over the square. What arrives at the first line is the seam's flux, what leaves the last
// becomes the seam's. next: side numbers of work.
static void sweep(const Sweep *s, double *next)
{
    const Crossing *c = &s->crossing;
    Dunes *dunes = s->dunes;
    for (int place = 0; place < c->side; place++) {
        dunes->flux[crossing_index(c, 0, place)] = dunes->seam[place];
    }
    for (int line = 0; line < c->side; line++) {
        for (int place = 0; place < c->side; place++) {
            next[place] = 0.0;
        }
        for (int place = 0; place < c->side; place++) {
            carry(s, line, place, next);
        }
        for (int place = 0; line + 1 < c->side && place < c->side; place++) {
            dunes->flux[crossing_index(c, line + 1, place)] = next[place];
        }
    }
    for (int place = 0; place < c->side; place++) {
        if (s->settles) { // but for bare rows all around, next to nothing
            dunes->sand[crossing_index(c, 0, place)] +=
                (next[place] - dunes->seam[place]) / s->lift;
        }
        dunes->seam[place] = next[place];
    }
}

double dunes_step_limit(const Dunes *dunes, const DuneWind *wind)
{
    double length = fmax(wind->saturation, dunes->cell);
    return STEP * dunes->cell * length;
}

static bool blow_once(Dunes *dunes, const DuneWind *wind, double time, double *next, const Run *run,
                      Error *e)
{
    if (!dunes_find_shear(dunes, wind, run, e)) {
        return false;
    }
    Sweep s = {.dunes = dunes,
               .crossing = crossing_of(dunes, wind),
               .threshold = wind->threshold,
               .lift = dunes->cell / time};
    s.approach = 1.0 - exact_exp(-s.crossing.length / wind->saturation);
    if (dunes->blown[0] != wind->x || dunes->blown[1] != wind->z) {
        dunes->blown[0] = wind->x;
        dunes->blown[1] = wind->z;
        sweep(&s, next);
    }
    sweep(&s, next); // what arrives at the border
    s.settles = true;
    sweep(&s, next);
    return true;
}

bool dunes_blow(Dunes *dunes, const DuneWind *wind, double time, double repose, const Run *run,
                Error *e)
{
    enum { SWEEPS = 4 };
    int steps = 1 + (int)(time / dunes_step_limit(dunes, wind));
    double *next = memory_alloc(dunes->side, sizeof *next, e);
    bool done = next;
    for (int i = 0; done && i < steps; i++) {
        done = !run_is_cancelled(run) || run_cancel_error(e);
        done = done && blow_once(dunes, wind, time / steps, next, run, e) &&
               dunes_settle(dunes, CREEP * time / steps, repose, SWEEPS, run, e);
    }
    free(next);
    return done;
}

// ---- other grids

static double cubic(double a, double b, double c, double d, double t) // Catmull and Rom
{
    return b +
           0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)));
}

double dunes_at(const Dunes *dunes, double x, double z)
{
    double u = x / dunes->cell, v = z / dunes->cell, row[4];
    int64_t mask = dunes->side - 1, i = (int64_t)floor(u), j = (int64_t)floor(v);
    double s = u - floor(u), t = v - floor(v);
    for (int k = 0; k < 4; k++) {
        const double *h = dunes->sand + ((j + k - 1) & mask) * dunes->side;
        row[k] = cubic(h[(i - 1) & mask], h[i & mask], h[(i + 1) & mask], h[(i + 2) & mask], s);
    }
    return cubic(row[0], row[1], row[2], row[3], t);
}

// Cubics keep the mean of all: their weights at the middles add up to 1 for every sample.
Dunes *dunes_refined(const Dunes *dunes, Error *e)
{
    Dunes *finer = dunes_new(2 * dunes->side, dunes->cell * dunes->side, e);
    for (int64_t i = 0; finer && i < dunes_count(finer); i++) {
        int64_t column = i % finer->side, row = i / finer->side;
        finer->sand[i] = dunes_at(dunes, (double)column * finer->cell, (double)row * finer->cell);
    }
    return finer;
}
