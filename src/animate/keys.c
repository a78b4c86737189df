#include "animate/keys.h"

#include <math.h>
#include <string.h>

// Keys as an infinite sequence if they loop: number i is key i mod period, i div period periods
// later.
typedef struct Row {
    const Keys *keys;
    bool endless;
    int period;
} Row;

static Row make_row(const Keys *keys)
{
    Row row = {keys, keys->loop && keys->count > 1, keys->count};
    if (row.endless && keys->at[keys->count - 1] - keys->at[0] >= 1.0) {
        const double *last = keys->value + (size_t)(keys->count - 1) * (size_t)keys->width;
        row.endless = memcmp(keys->value, last, sizeof(double) * (size_t)keys->width) == 0;
        row.period = keys->count - 1; // the last key equals the first
    }
    return row;
}

static int wrapped(const Row *row, int i, int *turns)
{
    *turns = i < 0 ? -1 : i / row->period; // i >= -period
    return i - *turns * row->period;
}

static double row_time(const Row *row, int i)
{
    if (!row->endless) {
        return row->keys->at[i];
    }
    int turns, k = wrapped(row, i, &turns);
    return row->keys->at[k] + (double)turns;
}

static double row_value(const Row *row, int i, int component)
{
    int turns, k = row->endless ? wrapped(row, i, &turns) : i;
    return row->keys->value[(size_t)k * (size_t)row->keys->width + (size_t)component];
}

static bool row_has(const Row *row, int i)
{
    return row->endless || (i >= 0 && i < row->keys->count);
}

double ease_between(Ease ease, double a, double b, double u)
{
    double s = ease == EASE_STEP ? 0.0 : (ease == EASE_SMOOTH ? u * u * (3.0 - 2.0 * u) : u);
    return u >= 1.0 ? b : a + (b - a) * s;
}

static double slope(const Row *row, int i, int component)
{
    double rise = row_value(row, i + 1, component) - row_value(row, i, component);
    return rise / (row_time(row, i + 1) - row_time(row, i));
}

// Slope of the curve at key i.
static double tangent(const Row *row, int i, int component)
{
    if (!row_has(row, i - 1)) {
        return slope(row, i, component);
    }
    if (!row_has(row, i + 1)) {
        return slope(row, i - 1, component);
    }
    double before = slope(row, i - 1, component), after = slope(row, i, component);
    if (before * after <= 0.0) {
        return 0.0;
    }
    double h0 = row_time(row, i) - row_time(row, i - 1),
           h1 = row_time(row, i + 1) - row_time(row, i);
    double w0 = 2.0 * h1 + h0, w1 = h1 + 2.0 * h0;
    return (w0 + w1) / (w0 / before + w1 / after);
}

// Cubic Hermite interpolation from key i to the next.
static double spline(const Row *row, int i, int component, double u)
{
    double h = row_time(row, i + 1) - row_time(row, i);
    double a = row_value(row, i, component), b = row_value(row, i + 1, component);
    double from = h * tangent(row, i, component), to = h * tangent(row, i + 1, component);
    double u2 = u * u, u3 = u2 * u;
    return (2.0 * u3 - 3.0 * u2 + 1.0) * a + (u3 - 2.0 * u2 + u) * from +
           (3.0 * u2 - 2.0 * u3) * b + (u3 - u2) * to;
}

// Number of the key in effect at *time, which looping reduces to 0..1 (or slightly more); -1 =
// before the first.
static int find_key(const Row *row, double *time)
{
    const Keys *keys = row->keys;
    if (keys->loop) {
        *time -= floor(*time);
    }
    int i = keys->count - 1;
    while (i >= 0 && keys->at[i] > *time) {
        i--;
    }
    if (i < 0 && row->endless) {
        *time += 1.0;
        i = row->period - 1;
    }
    return i;
}

void keys_at(const Keys *keys, double time, double *value)
{
    Row row = make_row(keys);
    int i = find_key(&row, &time);
    bool between = i >= 0 && row_has(&row, i + 1);
    double u =
        between ? (time - row_time(&row, i)) / (row_time(&row, i + 1) - row_time(&row, i)) : 0.0;
    for (int c = 0; c < keys->width; c++) {
        if (!between) {
            value[c] = row_value(&row, i < 0 ? 0 : i, c);
        } else if (keys->ease == EASE_SPLINE) {
            value[c] = spline(&row, i, c, u);
        } else {
            value[c] =
                ease_between(keys->ease, row_value(&row, i, c), row_value(&row, i + 1, c), u);
        }
    }
}

int keys_step(const Keys *keys, double time)
{
    int i;
    if (keys->loop) {
        time -= floor(time);
    }
    for (i = keys->count - 1; i > 0 && keys->at[i] > time; i--) {
    }
    return keys->loop && keys->at[0] > time ? keys->count - 1 : i;
}
