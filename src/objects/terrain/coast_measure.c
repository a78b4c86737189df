// Measures of a coast: cliffs, platform, beach, the shore's line, stacks.
#include "base/exact_math.h"
#include "base/memory.h"
#include "objects/terrain/coast.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct CoastSurvey {
    const Landscape *land;
    const HeightField *front; // m to the edge of what waves have reached
    double high;              // m: high water
} CoastSurvey;

static double surface(const Landscape *land, int64_t i)
{
    return land->rock[i] + land->loose[i];
}

static bool reached(const CoastSurvey *s, int64_t i)
{
    return s->front->height[i] <= 0.0f;
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// The middle one; NaN without any. Sorts them.
static double median(double *values, int64_t count)
{
    qsort(values, (size_t)count, sizeof *values, by_value);
    return count > 0 ? values[count / 2] : (double)NAN;
}

static double slope_at(const Landscape *land, int64_t i)
{
    double x = surface(land, i + 1) - surface(land, i - 1);
    double z = surface(land, i + land->side) - surface(land, i - land->side);
    return 0.5 * sqrt(x * x + z * z) / land->cell;
}

static double degrees(double tangent)
{
    return (double)exact_atan2((float)tangent, 1.0f) * 57.29577951308232;
}

// m: the land's height above high water, 30 m behind the shore; only where it is a cliff.
static double cliff_height(const CoastSurvey *s, double *values)
{
    const Landscape *land = s->land;
    int64_t count = 0;
    for (int64_t i = 0; i < landscape_count(land); i++) {
        double behind = (double)s->front->height[i];
        double rise = surface(land, i) - s->high;
        if (fabs(behind - 30.0) < 0.7 * land->cell && rise > 0.5 * behind) {
            values[count++] = rise;
        }
    }
    return median(values, count);
}

typedef enum CoastPart { CLIFF, BEACH } CoastPart;

static bool is_part(const CoastSurvey *s, int64_t i, CoastPart part)
{
    double height = surface(s->land, i), loose = s->land->loose[i];
    if (part == CLIFF) {
        return !reached(s, i) && s->front->height[i] < 40.0f && height > s->high && loose < 0.2;
    }
    return reached(s, i) && loose > 0.4 && fabs(height) < s->high;
}

// So that no slope is one across a part's edge.
static bool is_inside(const CoastSurvey *s, int64_t i, CoastPart part)
{
    int64_t side = s->land->side;
    return is_part(s, i, part) && is_part(s, i - 1, part) && is_part(s, i + 1, part) &&
           is_part(s, i - side, part) && is_part(s, i + side, part);
}

// Median tangent of a part's slopes.
static double part_slope(const CoastSurvey *s, CoastPart part, double *values)
{
    const Landscape *land = s->land;
    int64_t count = 0;
    for (int row = 1; row < land->side - 1; row++) {
        for (int column = 1; column < land->side - 1; column++) {
            int64_t i = (int64_t)row * land->side + column;
            if (is_inside(s, i, part)) {
                values[count++] = slope_at(land, i);
            }
        }
    }
    return median(values, count);
}

// Tangent: by least squares of bare rock's height over its distance from the cliff, up to 80 m.
static double platform_slope(const CoastSurvey *s)
{
    double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
    for (int64_t i = 0; i < landscape_count(s->land); i++) {
        double x = -(double)s->front->height[i], y = s->land->rock[i];
        if (x > s->land->cell && x < 80.0 && s->land->loose[i] < 0.05) {
            n += 1.0;
            sx += x;
            sy += y;
            sxx += x * x;
            sxy += x * y;
        }
    }
    return n > 2.0 ? (sx * sy - n * sxy) / (n * sxx - sx * sx) : (double)NAN;
}

// The share of the shore at high water that has sand.
static double beach_share(const CoastSurvey *s)
{
    const Landscape *land = s->land;
    int64_t all = 0, sandy = 0;
    for (int64_t i = 0; i < landscape_count(land); i++) {
        double off = -(double)s->front->height[i];
        if (off >= 0.0 && off < 1.5 * land->cell) {
            all++;
            sandy += land->loose[i] > 0.4;
        }
    }
    return all > 0 ? (double)sandy / (double)all : (double)NAN;
}

static bool crosses(const CoastSurvey *s, int column, int row, int box)
{
    bool first = reached(s, (int64_t)row * s->land->side + column);
    for (int r = row; r <= row + box; r++) {
        for (int c = column; c <= column + box; c++) {
            if (reached(s, (int64_t)r * s->land->side + c) != first) {
                return true;
            }
        }
    }
    return false;
}

// Box-counting dimension of the shore, over boxes of a share of the side from 1/16 to 1/128.
static double shore_dimension(const CoastSurvey *s)
{
    int cells = s->land->side - 1;
    double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
    for (int box = cells / 16; box >= 1 && box >= cells / 128; box /= 2) {
        int64_t count = 0;
        for (int row = 0; row + box <= cells; row += box) {
            for (int column = 0; column + box <= cells; column += box) {
                count += crosses(s, column, row, box);
            }
        }
        double x = -exact_log((double)box), y = count > 0 ? exact_log((double)count) : 0.0;
        n += 1.0;
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
    }
    return n > 1.0 ? (n * sxy - sx * sy) / (n * sxx - sx * sx) : (double)NAN;
}

// Gives all land that hangs together with `from` the mark; its area, m^2.
static double flood(const CoastSurvey *s, uint8_t *mark, int32_t *stack, int64_t from, bool *rim)
{
    int side = s->land->side;
    int64_t top = 0, count = 0;
    mark[from] = 1;
    stack[top++] = (int32_t)from;
    *rim = false;
    while (top > 0) {
        int64_t i = stack[--top], column = i % side, row = i / side;
        count++;
        *rim = *rim || column == 0 || row == 0 || column == side - 1 || row == side - 1;
        const int64_t near[4] = {column > 0 ? i - 1 : i, column < side - 1 ? i + 1 : i,
                                 row > 0 ? i - side : i, row < side - 1 ? i + side : i};
        for (int k = 0; k < 4; k++) {
            if (!mark[near[k]] && !reached(s, near[k])) {
                mark[near[k]] = 1;
                stack[top++] = (int32_t)near[k];
            }
        }
    }
    return (double)count * s->land->cell * s->land->cell;
}

// Land apart from the rest of at least 20 m^2.
static bool count_stacks(const CoastSurvey *s, double *stacks, Error *e)
{
    int64_t count = landscape_count(s->land);
    uint8_t *mark = memory_alloc_zero(count, 1, e);
    int32_t *stack = memory_alloc(count, sizeof *stack, e);
    bool done = mark && stack, rim;
    *stacks = 0.0;
    for (int64_t i = 0; done && i < count; i++) {
        if (!mark[i] && !reached(s, i)) {
            double area = flood(s, mark, stack, i, &rim);
            *stacks += !rim && area >= 20.0 ? 1.0 : 0.0;
        }
    }
    free(mark);
    free(stack);
    return done;
}

bool terrain_measure_coast(const Terrain *terrain, MeasureList *list, Error *e)
{
    TerrainParams params = terrain_params_resolve(terrain->params);
    CoastSurvey s = {.land = terrain->evolved,
                     .front = terrain->ground,
                     .high = 0.5 * (double)params.coast.tide};
    double nan = (double)NAN, stacks;
    double *values = memory_alloc(landscape_count(s.land), sizeof *values, e);
    bool done = values && count_stacks(&s, &stacks, e) &&
                measures_add(list, "cliff_height", cliff_height(&s, values), "m", nan, nan, e) &&
                measures_add(list, "cliff_slope", degrees(part_slope(&s, CLIFF, values)), "degrees",
                             40, 85, e) &&
                measures_add(list, "platform_slope", platform_slope(&s), "", 0.01, 0.05, e) &&
                measures_add(list, "beach_slope", degrees(part_slope(&s, BEACH, values)), "degrees",
                             2, 12, e) &&
                measures_add(list, "beach_share", beach_share(&s), "", nan, nan, e) &&
                measures_add(list, "shore_dimension", shore_dimension(&s), "", 1.05, 1.4, e) &&
                measures_add(list, "stacks", stacks, "", nan, nan, e);
    free(values);
    return done;
}
