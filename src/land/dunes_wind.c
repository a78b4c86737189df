// The wind over dunes: bubbles of separated air behind brinks, and the shear stress over hills of
// gentle slope (Jackson and Hunt 1975; Weng et al. 1991) in the simple form of Kroy, Sauermann and
// Herrmann 2002, Phys. Rev. E 66, 031305.
#include "base/memory.h"
#include "land/dunes_parts.h"

#include <stdlib.h>

#define LEE_SLOPE 0.364   // tan 20 degrees: air does not follow a steeper fall
#define ASIDE 0.2         // stress across the wind, relative to that of a flow without friction
#define FINEST 0.6        // waves of this many radians a cell are half lost on the grid
#define BUBBLE_SLOPE 0.25 // tan 14 degrees: the steepest fall of a bubble's back

// ---- bubbles

// A cubic from a brink with its height and slope down to the ground, where it is level.
typedef struct Bubble {
    double height, slope; // at the brink
    double ground;        // m: height of its end
    double length;        // m along the wind
} Bubble;

// So long that the back is nowhere steeper than BUBBLE_SLOPE (Duran and Herrmann 2006, eq. 12).
static void measure_bubble(Bubble *b)
{
    double s = b->slope / (4.0 * BUBBLE_SLOPE);
    b->length = 1.5 * (b->height - b->ground) / BUBBLE_SLOPE * (1.0 + s + 2.0 * s * s);
}

static double bubble_at(const Bubble *b, double x)
{
    double t = x / b->length, fall = b->height - b->ground, rise = b->slope * b->length;
    return b->height + t * (rise + t * (-(3.0 * fall + 2.0 * rise) + t * (2.0 * fall + rise)));
}

// Raises the envelope along the bubble behind a brink, until the ground comes out of it.
static void blow_bubble(Dunes *dunes, const Crossing *c, int line, int place)
{
    const double *sand = dunes->sand;
    double at = place, before = crossing_at(c, sand, line - 1, at - c->drift);
    Bubble b = {.height = sand[crossing_index(c, line, place)]};
    b.slope = fmax((b.height - before) / c->length, -0.2);
    b.ground = b.height;
    int n = 1;
    for (; n < c->side; n++) { // down to the foot
        double h = crossing_at(c, sand, line + n, at + n * c->drift);
        if (h >= b.ground) {
            break;
        }
        b.ground = h;
    }
    measure_bubble(&b);
    int end = (int)(b.length / c->length);
    for (int k = n; k <= end && k < c->side; k++) { // and on to lower ground within its reach
        double h = crossing_at(c, sand, line + k, at + k * c->drift);
        if (h > bubble_at(&b, k * c->length)) {
            break;
        }
        b.ground = fmin(b.ground, h);
    }
    measure_bubble(&b);
    for (int k = 1; k * c->length < b.length && k < c->side; k++) {
        double way = at + k * c->drift, s = bubble_at(&b, k * c->length);
        if (k > n && s < crossing_at(c, sand, line + k, way)) {
            break;
        }
        int64_t low = (int64_t)floor(way), high = (int64_t)ceil(way);
        for (int64_t j = low; j <= high; j++) {
            double *e = &dunes->envelope[crossing_index(c, line + k, j)];
            *e = s > *e ? s : *e;
        }
    }
}

static void find_envelope(Dunes *dunes, const Crossing *c)
{
    const double *sand = dunes->sand;
    for (int64_t i = 0; i < dunes_count(dunes); i++) {
        dunes->envelope[i] = sand[i];
    }
    for (int line = 0; line < c->side; line++) {
        for (int place = 0; place < c->side; place++) {
            double here = sand[crossing_index(c, line, place)];
            double fall = here - crossing_at(c, sand, line + 1, place + c->drift);
            double rise = here - crossing_at(c, sand, line - 1, place - c->drift);
            if (fall > LEE_SLOPE * c->length && rise > -LEE_SLOPE * c->length) {
                blow_bubble(dunes, c, line, place);
            }
        }
    }
}

// ---- shear

// Transforms all rows, then all columns.
static bool transform_plane(Dunes *dunes, const Run *run, Error *e)
{
    int side = dunes->side;
    bool done = true;
#pragma omp parallel num_threads(dunes_threads(dunes, run)) reduction(&& : done)
    {
        Complex *line = memory_alloc(side, sizeof *line, e);
        done = line;
#pragma omp for schedule(static)
        for (int row = 0; row < side; row++) {
            fft_transform(dunes->wave + (int64_t)row * side, side, dunes->root);
        }
#pragma omp for schedule(static)
        for (int column = 0; column < side; column++) {
            for (int row = 0; line && row < side; row++) {
                line[row] = dunes->wave[(int64_t)row * side + column];
            }
            if (line) {
                fft_transform(line, side, dunes->root);
            }
            for (int row = 0; line && row < side; row++) {
                dunes->wave[(int64_t)row * side + column] = line[row];
            }
        }
        free(line);
    }
    return done;
}

// Response to the wave (u, v), in turns of the square: the spectrum of along + i across, both real.
static Complex respond(const Dunes *dunes, const DuneWind *wind, int u, int v, Complex h)
{
    int half = dunes->side / 2;
    u -= u > half ? dunes->side : 0;
    v -= v > half ? dunes->side : 0;
    if ((u == 0 && v == 0) || u == half || v == half) { // no response to what has no phase
        return (Complex){0.0, 0.0};
    }
    double turn = 6.28318530717958647692 / (dunes->cell * dunes->side);
    double along = turn * (u * wind->x + v * wind->z), across = turn * (v * wind->x - u * wind->z);
    double k = sqrt(along * along + across * across);
    // Waves that the grid hardly resolves fade.
    double fine = k * k * dunes->cell * dunes->cell / (FINEST * FINEST),
           low = 1.0 / (1.0 + fine * fine);
    h = (Complex){low * h.re, low * h.im};
    double re = DUNES_SHEAR_GAIN * along * along / k;
    double im = DUNES_SHEAR_GAIN * DUNES_SHEAR_SHIFT * along * fabs(along) / k;
    double side = ASIDE * DUNES_SHEAR_GAIN * along * across / k;
    Complex x = {re * h.re - im * h.im, re * h.im + im * h.re};
    return (Complex){x.re - side * h.im, x.im + side * h.re};
}

bool dunes_find_shear(Dunes *dunes, const DuneWind *wind, const Run *run, Error *e)
{
    Crossing crossing = crossing_of(dunes, wind);
    int64_t count = dunes_count(dunes);
    find_envelope(dunes, &crossing);
    for (int64_t i = 0; i < count; i++) {
        dunes->wave[i] = (Complex){dunes->envelope[i], 0.0};
    }
    if (!transform_plane(dunes, run, e)) {
        return false;
    }
    for (int64_t i = 0; i < count; i++) { // the inverse is the conjugate's transform's conjugate
        Complex z =
            respond(dunes, wind, (int)(i % dunes->side), (int)(i / dunes->side), dunes->wave[i]);
        dunes->wave[i] = (Complex){z.re, -z.im};
    }
    if (!transform_plane(dunes, run, e)) {
        return false;
    }
    for (int64_t i = 0; i < count; i++) {
        bool inside = dunes->envelope[i] > dunes->sand[i] + 1e-9;
        double along = 1.0 + dunes->wave[i].re / (double)count;
        dunes->shear[2 * i] = inside || along < 0.0 ? 0.0 : along;
        dunes->shear[2 * i + 1] = inside ? 0.0 : -dunes->wave[i].im / (double)count;
    }
    return true;
}
