#include "land/delta_measure.h"

#include "base/exact_math.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

// Channels: of the speed and the depth of the river.
static const double FAST = 0.25, DEEP = 0.1;

#define HALF_TURN 3.141592653589793

typedef struct Survey {
    const Delta *d;
    double fall;
} Survey;

static bool is_land(const Survey *s, int64_t i)
{
    const Delta *d = s->d;
    return d->kind[i] == DELTA_OPEN && d->bed[i] > d->level[i] - s->fall;
}

static bool is_channel(const Survey *s, int64_t i)
{
    const Delta *d = s->d;
    return d->kind[i] == DELTA_OPEN && d->speed[i] > FAST &&
           d->level[i] - d->bed[i] > DEEP * d->depth;
}

// ---- area, shores and reach

static void measure_land(const Survey *s, DeltaMeasures *m)
{
    const Delta *d = s->d;
    int64_t land = 0, shores = 0;
    double reach = 0.0;
    for (int64_t i = 0; i < delta_count(d); i++) {
        if (!is_land(s, i)) {
            continue;
        }
        land++;
        double x = (double)delta_column(d, i) - s->d->mouth[0];
        double z = (double)delta_row(d, i) - s->d->mouth[1];
        reach = fmax(reach, x * x + z * z);
        const int64_t sides[] = {-1, 1, -d->columns, d->columns};
        for (int k = 0; k < 4; k++) { // open cells are inside of the border
            int64_t n = i + sides[k];
            shores += d->kind[n] != DELTA_PLAIN && !is_land(s, n);
        }
    }
    m->land = (double)land * d->cell * d->cell;
    m->shoreline = land > 0 ? (double)shores / sqrt((double)land) : (double)NAN;
    m->reach = sqrt(reach) * d->cell;
}

// ---- hull

typedef struct Corner {
    double x, z;
} Corner;

static double turn(Corner a, Corner b, Corner c)
{
    return (b.x - a.x) * (c.z - a.z) - (b.z - a.z) * (c.x - a.x);
}

static int64_t add_corner(Corner *hull, int64_t count, int64_t least, Corner c)
{
    while (count >= least + 2 && turn(hull[count - 2], hull[count - 1], c) <= 0.0) {
        count--;
    }
    hull[count] = c;
    return count + 1;
}

// The first and the last land of a row; false if there is none.
static bool row_ends(const Survey *s, int row, double *first, double *last)
{
    int64_t at = (int64_t)row * s->d->columns;
    int from = 0, to = s->d->columns - 1;
    while (from <= to && !is_land(s, at + from)) {
        from++;
    }
    while (to > from && !is_land(s, at + to)) {
        to--;
    }
    *first = from - 0.5;
    *last = to + 0.5;
    return from <= to;
}

// Area of the convex hull of the land, cells: its left and its right chain (Andrew 1979). The rows'
// order is that of z.
static bool measure_hull(const Survey *s, double *area, Error *e)
{
    int rows = s->d->rows;
    Corner *hull = memory_alloc(4 * (int64_t)rows + 4, sizeof *hull, e);
    if (!hull) {
        return false;
    }
    int64_t count = 0;
    double first, last;
    for (int k = 0; k < 2 * rows; k++) { // corners above and below each cell
        int row = k / 2;
        if (row_ends(s, row, &first, &last)) {
            count = add_corner(hull, count, 0, (Corner){last, row - 0.5 + k % 2});
        }
    }
    int64_t turned = count > 0 ? count - 1 : 0;
    for (int k = 2 * rows - 1; k >= 0; k--) {
        int row = k / 2;
        if (row_ends(s, row, &first, &last)) {
            count = add_corner(hull, count, turned, (Corner){first, row - 0.5 + k % 2});
        }
    }
    *area = 0.0;
    for (int64_t i = 0; i < count; i++) {
        Corner a = hull[i], b = hull[(i + 1) % count];
        *area += 0.5 * (a.x * b.z - b.x * a.z);
    }
    free(hull);
    return true;
}

// ---- channels

// Runs of channel along an arc of that radius, cells.
static int cross_arc(const Survey *s, double radius)
{
    const Delta *d = s->d;
    int steps = (int)(4.0 * HALF_TURN * radius) + 8, runs = 0;
    bool before = false;
    for (int k = 0; k <= steps; k++) {
        double sine, cosine;
        exact_sincos_double(HALF_TURN * k / steps, &sine, &cosine);
        int column = (int)floor(s->d->mouth[0] + radius * cosine + 0.5);
        int row = (int)floor(s->d->mouth[1] + radius * sine + 0.5);
        bool inside = column >= 0 && row >= 0 && column < d->columns && row < d->rows;
        bool now = inside && is_channel(s, (int64_t)row * d->columns + column);
        runs += now && !before;
        before = now;
    }
    return runs;
}

bool delta_measure(const Delta *d, double fall, DeltaMeasures *m, Error *e)
{
    enum { ARCS = 25 };
    Survey s = {.d = d, .fall = fall};
    double hull;
    *m = (DeltaMeasures){0};
    measure_land(&s, m);
    if (!measure_hull(&s, &hull, e)) {
        return false;
    }
    double area = m->land / (d->cell * d->cell);
    m->land_share = hull > 0.0 ? area / hull : (double)NAN;
    for (int k = 0; k < ARCS; k++) {
        int runs = cross_arc(&s, (0.3 + 0.6 * k / (ARCS - 1)) * m->reach / d->cell);
        m->branches += (double)runs / ARCS;
        m->mouths = fmax(m->mouths, runs);
    }
    return true;
}
