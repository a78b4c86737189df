#include "land/valley_profile.h"

#include "base/exact_math.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

enum { ALONG = 6, FARTHEST = 60, LEAST_POINTS = 5 }; // cells, cells, points of a fit

typedef struct Survey {
    const HeightField *field;
    float floor, shoulder; // m over the river: the fit begins above the one, ends below the other
    float wall;            // m: what a side rises by at least
} Survey;

// Bilinear; NAN outside.
static float height_at(const HeightField *field, float column, float row)
{
    int i = (int)floorf(column), k = (int)floorf(row);
    if (i < 0 || k < 0 || i + 1 >= field->columns || k + 1 >= field->rows) {
        return NAN;
    }
    const float *h = field->height + (int64_t)k * field->columns + i;
    float u = column - (float)i, v = row - (float)k;
    return lerpf(lerpf(h[0], h[1], u), lerpf(h[field->columns], h[field->columns + 1], u), v);
}

// The exponent of one side: the slope of the line through (log x, log h). NAN if the side has no
// wall.
static double side_exponent(const Survey *s, Vec2 at, Vec2 across)
{
    float river = height_at(s->field, at.x, at.y), top = river;
    double x = 0.0, h = 0.0, xx = 0.0, xh = 0.0, n = 0.0;
    for (int k = 1; k < FARTHEST; k++) {
        float here = height_at(s->field, at.x + (float)k * across.x, at.y + (float)k * across.y);
        if (!(here > top - 0.0125f * s->wall)) {
            break; // beyond the crest
        }
        top = fmaxf(top, here);
        float rise = here - river;
        if (rise > s->floor && rise < s->shoulder) {
            double log_x = exact_log((double)k), log_h = exact_log((double)rise);
            x += log_x;
            h += log_h;
            xx += log_x * log_x;
            xh += log_x * log_h;
            n += 1.0;
        }
    }
    bool fits = top - river > s->wall && n >= LEAST_POINTS;
    return fits ? (n * xh - x * h) / (n * xx - x * x) : (double)NAN;
}

// Unit vector across the river's course, in cells; of length 0 where it turns back on itself.
static Vec2 across_river(const HeightField *field, const Drainage *drainage, int64_t sample)
{
    int64_t end = sample;
    for (int k = 0; k < ALONG; k++) {
        end = drainage->receiver[end];
    }
    int64_t columns = end % field->columns - sample % field->columns;
    int64_t rows = end / field->columns - sample / field->columns;
    float dx = (float)columns, dz = (float)rows;
    float length = sqrtf(dx * dx + dz * dz);
    return length >= 0.5f * ALONG ? (Vec2){-dz / length, dx / length} : (Vec2){0, 0};
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

bool valley_profile_exponent(const HeightField *field, const Drainage *drainage, double least_area,
                             double *exponent, Error *e)
{
    float low, high;
    height_field_range(field, &low, &high);
    Survey s = {.field = field,
                .floor = 0.0012f * (high - low),
                .shoulder = 0.2f * (high - low),
                .wall = (high - low) / 6.0f};
    double *found = memory_alloc(2 * drainage->samples, sizeof *found, e);
    int64_t count = 0;
    for (int64_t i = 0; found && i < drainage->samples; i++) {
        if (drainage->area[i] < least_area) {
            continue;
        }
        int64_t column = i % field->columns, row = i / field->columns;
        Vec2 at = {(float)column, (float)row};
        Vec2 across = across_river(field, drainage, i), back = {-across.x, -across.y};
        double sides[2] = {side_exponent(&s, at, across), side_exponent(&s, at, back)};
        for (int k = 0; k < 2; k++) {
            if (isfinite(sides[k])) {
                found[count++] = sides[k];
            }
        }
    }
    if (found) {
        qsort(found, (size_t)count, sizeof *found, ascending);
        *exponent = count > 0 ? found[count / 2] : (double)NAN;
    }
    free(found);
    return found;
}
