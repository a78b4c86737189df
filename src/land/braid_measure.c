#include "land/braid_measure.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

enum { NARROWEST = 2 }; // cells: a thread or a bar

static bool is_wet(const BraidLevel *level, int64_t i)
{
    return level->ring[i] == 0;
}

// The threads of water across a row.
typedef struct Section {
    int threads, active;  // active: in which gravel moves
    int64_t wide, widest; // cells: of all threads; of the widest
    double flow, trunk;   // m^2/s, cells' sum: of all threads; of the widest
} Section;

static void add_thread(Section *s, int64_t wide, double flow, bool moves)
{
    if (wide < NARROWEST) {
        return;
    }
    s->threads++;
    s->active += moves;
    s->wide += wide;
    s->flow += flow;
    if (wide > s->widest) {
        s->widest = wide;
        s->trunk = flow;
    }
}

static Section section_of(const Braid *b, const BraidLevel *level, int row)
{
    Section s = {0};
    int64_t run = 0;
    double flow = 0.0;
    bool moves = false;
    for (int column = 0; column <= b->side; column++) {
        int64_t i = (int64_t)row * b->side + column;
        if (column < b->side && is_wet(level, i)) {
            run++;
            flow += (double)b->flow_z[i];
            moves = moves || b->shear[i] > (float)BRAID_THRESHOLD;
            continue;
        }
        add_thread(&s, run, flow, moves);
        run = 0;
        flow = 0.0;
        moves = false;
    }
    return s;
}

// The extent of a dry piece of ground.
typedef struct Bar {
    int64_t cells;
    double length, width; // m: standard deviations along its axis and across it, times 4
    bool open;            // it reaches the sides of the square
} Bar;

static void find_shape(Bar *bar, double cell, const double *s)
{
    double n = (double)bar->cells, xx = s[2] / n - s[0] * s[0] / (n * n);
    double zz = s[3] / n - s[1] * s[1] / (n * n), xz = s[4] / n - s[0] * s[1] / (n * n);
    double middle = 0.5 * (xx + zz), root = sqrt(0.25 * (xx - zz) * (xx - zz) + xz * xz);
    bar->length = 4.0 * cell * sqrt(middle + root);
    bar->width = 4.0 * cell * sqrt(fmax(middle - root, 0.0) + 1.0 / 12.0);
}

// The dry ground that hangs together with a cell. stack holds pairs (cell, row beyond the square).
static Bar bar_of(const Braid *b, const BraidLevel *level, uint8_t *seen, int64_t *stack,
                  int64_t first)
{
    static const int step[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    Bar bar = {0};
    double sum[5] = {0};
    int side = b->side;
    stack[0] = first;
    stack[1] = first / side;
    seen[first] = 1;
    for (int64_t n = 0, count = 1; n < count; n++) {
        int64_t column = stack[2 * n] % side, row = stack[2 * n + 1]; // rows go on beyond the rim
        double x = (double)column, z = (double)row;
        sum[0] += x;
        sum[1] += z;
        sum[2] += x * x;
        sum[3] += z * z;
        sum[4] += x * z;
        bar.cells++;
        for (int k = 0; k < 4; k++) {
            int64_t c = column + step[k][0], r = row + step[k][1];
            if (c < 0 || c >= side || r < -side || r >= 2 * (int64_t)side) {
                bar.open = true;
                continue;
            }
            int64_t next = (r + side) % side * side + c;
            if (!seen[next] && !is_wet(level, next)) {
                seen[next] = 1;
                stack[2 * count] = next;
                stack[2 * count++ + 1] = r;
            }
        }
    }
    find_shape(&bar, b->cell, sum);
    return bar;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static bool measure_bars(const Braid *b, const BraidLevel *level, double *ratio, Error *e)
{
    int64_t cells = braid_count(b), count = 0;
    // A bar is at least a quarter of the length over which the flow answers to its bed.
    double least = 0.25 * b->mean / b->slope;
    uint8_t *seen = memory_alloc_zero(cells, 1, e);
    int64_t *stack = seen ? memory_alloc(2 * cells, sizeof *stack, e) : NULL;
    double *ratios = stack ? memory_alloc(cells, sizeof *ratios, e) : NULL;
    for (int64_t i = 0; ratios && i < cells; i++) {
        if (seen[i] || is_wet(level, i)) {
            continue;
        }
        Bar bar = bar_of(b, level, seen, stack, i);
        if (!bar.open && bar.length > least && bar.width > NARROWEST * b->cell) {
            ratios[count++] = bar.length / bar.width;
        }
    }
    if (ratios) {
        qsort(ratios, (size_t)count, sizeof *ratios, ascending);
        *ratio = count > 0 ? ratios[count / 2] : (double)NAN;
    }
    bool done = ratios;
    free(seen);
    free(stack);
    free(ratios);
    return done;
}

// Least squares of the mean level of each row, plane included.
static double fall_of(const Braid *b, const BraidLevel *level)
{
    double n = 0.0, z = 0.0, zz = 0.0, h = 0.0, zh = 0.0;
    for (int64_t i = 0; i < braid_count(b); i++) {
        if (is_wet(level, i)) {
            int64_t row = i / b->side;
            double at = (double)row * b->cell, height = level->level[i] - b->slope * at;
            n += 1.0;
            z += at;
            zz += at * at;
            h += height;
            zh += at * height;
        }
    }
    return n > 1.0 ? -(zh - z * h / n) / (zz - z * z / n) : (double)NAN;
}

// Means of all sections, and of those with water.
static BraidMeasures measure_sections(const Braid *b, const BraidLevel *level)
{
    BraidMeasures m = {0};
    int wet = 0;
    for (int row = 0; row < b->side; row++) {
        Section s = section_of(b, level, row);
        m.threads += s.threads;
        m.active += s.active;
        if (s.threads > 0 && s.flow > 0.0) {
            m.trunk_share += s.trunk / s.flow;
            m.trunk_width += (double)s.widest * s.threads / (double)s.wide;
            wet++;
        }
    }
    m.threads /= b->side;
    m.active /= b->side;
    m.trunk_share = wet > 0 ? m.trunk_share / wet : (double)NAN;
    m.trunk_width = wet > 0 ? m.trunk_width / wet : (double)NAN;
    return m;
}

bool braid_measure(const Braid *b, const BraidLevel *level, BraidMeasures *m, Error *e)
{
    int64_t wet = 0;
    for (int64_t i = 0; i < braid_count(b); i++) {
        wet += is_wet(level, i);
    }
    *m = measure_sections(b, level);
    m->wet = (double)wet * b->cell / (b->width * b->side);
    m->fall = fall_of(b, level);
    return measure_bars(b, level, &m->bar_ratio, e);
}
