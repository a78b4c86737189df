#include "base/distance_transform.h"

#include "base/memory.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

// The squared distance along a line to the nearest sample, plus that sample's own: the lower
// envelope of parabolas. value: `count` of them, `stride` apart; apex, border and line: scratch of
// `count`.
static void spread_along(double *value, int count, int64_t stride, double cell, int *apex,
                         double *border, double *line)
{
    int last = -1;
    for (int i = 0; i < count; i++) {
        line[i] = value[i * stride];
        double own = line[i] + cell * cell * i * i, meet = -INFINITY;
        while (isfinite(line[i]) && last >= 0) {
            int k = apex[last];
            meet = (own - line[k] - cell * cell * k * k) / (2.0 * cell * cell * (i - k));
            if (meet > border[last]) {
                break;
            }
            last--;
            meet = -INFINITY;
        }
        if (isfinite(line[i])) {
            apex[++last] = i;
            border[last] = meet;
        }
    }
    for (int i = 0, k = 0; i < count && last >= 0; i++) {
        while (k < last && border[k + 1] < i) {
            k++;
        }
        double off = cell * (i - apex[k]);
        value[i * stride] = off * off + line[apex[k]];
    }
}

bool distance_transform(double *squared, int columns, int rows, double across, double along,
                        Error *e)
{
    int longest = columns > rows ? columns : rows;
    int *apex = memory_alloc(longest, sizeof *apex, e);
    double *border = memory_alloc((int64_t)2 * longest, sizeof *border, e);
    bool done = apex && border;
    for (int row = 0; done && row < rows; row++) {
        spread_along(squared + (int64_t)row * columns, columns, 1, across, apex, border,
                     border + longest);
    }
    for (int column = 0; done && column < columns; column++) {
        spread_along(squared + column, rows, columns, along, apex, border, border + longest);
    }
    free(border);
    free(apex);
    return done;
}
