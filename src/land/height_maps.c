#include "land/height_maps.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "land/height_drainage.h"
#include "land/height_measure.h"

#include <stdlib.h>
#include <string.h>

// The heights around a sample, row by row. Neighbours that are missing or beyond the rim continue
// the slope of those opposite; without these, sides are level and corners continue both sides.
typedef struct Around {
    float h[9];
} Around;

static float height_or_missing(const HeightField *field, int column, int row)
{
    bool inside = column >= 0 && row >= 0 && column < field->columns && row < field->rows;
    return inside ? field->height[(int64_t)row * field->columns + column] : NAN;
}

static Around look_around(const HeightField *field, int column, int row)
{
    Around a;
    for (int k = 0; k < 9; k++) {
        a.h[k] = height_or_missing(field, column + k % 3 - 1, row + k / 3 - 1);
    }
    static const int order[8] = {1, 3, 5, 7, 0, 2, 6, 8}; // sides before corners
    Around known = a;
    for (int n = 0; n < 8; n++) {
        int k = order[n];
        if (isfinite(known.h[k])) {
            continue;
        }
        float opposite = known.h[8 - k];
        if (isfinite(opposite)) {
            a.h[k] = 2.0f * a.h[4] - opposite;
        } else {
            a.h[k] = k % 2 == 1 ? a.h[4] : a.h[k / 3 * 3 + 1] + a.h[3 + k % 3] - a.h[4];
        }
    }
    return a;
}

// Horn, "Hill Shading and the Reflectance Map", Proc. IEEE 69(1), 1981.
static Vec2 gradient(const HeightField *field, const Around *a)
{
    const float *h = a->h;
    float x = (h[2] + 2.0f * h[5] + h[8]) - (h[0] + 2.0f * h[3] + h[6]);
    float z = (h[6] + 2.0f * h[7] + h[8]) - (h[0] + 2.0f * h[1] + h[2]);
    return (Vec2){x / (8.0f * field->cell.x), z / (8.0f * field->cell.y)};
}

static float steepness(Vec2 g)
{
    return sqrtf(g.x * g.x + g.y * g.y);
}

typedef float LocalMap(const HeightField *field, const Around *around);

static float slope_at(const HeightField *field, const Around *a)
{
    return exact_atan2(steepness(gradient(field, a)), 1.0f) / RADIANS_PER_DEGREE;
}

static float aspect_at(const HeightField *field, const Around *a)
{
    Vec2 g = gradient(field, a);
    if (g.x == 0.0f && g.y == 0.0f) {
        return -1.0f;
    }
    float degrees = exact_atan2(-g.x, g.y) / RADIANS_PER_DEGREE;
    return degrees < 0.0f ? degrees + 360.0f : degrees;
}

static float curvature_at(const HeightField *field, const Around *a)
{
    const float *h = a->h;
    return (h[3] + h[5] - 2.0f * h[4]) / (field->cell.x * field->cell.x) +
           (h[1] + h[7] - 2.0f * h[4]) / (field->cell.y * field->cell.y);
}

static bool fill_local(const HeightField *field, LocalMap *map, HeightField *out, Error *e)
{
    (void)e;
    for (int row = 0; row < field->rows; row++) {
        for (int column = 0; column < field->columns; column++) {
            int64_t i = (int64_t)row * field->columns + column;
            Around around = look_around(field, column, row);
            out->height[i] = isfinite(field->height[i]) ? map(field, &around) : NAN;
        }
    }
    return true;
}

// ---- maps of the drainage ----

typedef bool DrainageMap(const HeightField *field, const Drainage *drainage, HeightField *out,
                         Error *e);

static bool fill_flow(const HeightField *field, const Drainage *drainage, HeightField *out,
                      Error *e)
{
    (void)e;
    for (int64_t i = 0; i < drainage->count; i++) {
        out->height[i] = isfinite(field->height[i]) ? (float)drainage->area[i] : NAN;
    }
    return true;
}

static bool fill_wetness(const HeightField *field, const Drainage *drainage, HeightField *out,
                         Error *e)
{
    const float least_slope = 1e-3f; // level land would be wet without end
    float width = sqrtf(field->cell.x * field->cell.y);
    for (int row = 0; row < field->rows; row++) {
        for (int column = 0; column < field->columns; column++) {
            int64_t i = (int64_t)row * field->columns + column;
            Around around = look_around(field, column, row);
            float slope = fmaxf(steepness(gradient(field, &around)), least_slope);
            float contour = (float)drainage->area[i] / width;
            out->height[i] =
                isfinite(field->height[i]) ? (float)exact_log((double)(contour / slope)) : NAN;
        }
    }
    (void)e;
    return true;
}

// The squared distance along a line to the nearest sample, plus that sample's own: the lower
// envelope of parabolas (Felzenszwalb and Huttenlocher, "Distance Transforms of Sampled Functions",
// Theory of Computing 8, 2012). value: `count` of them, `stride` apart; apex, border and
// line: scratch of `count`.
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

static bool spread(const HeightField *field, double *squared, Error *e)
{
    int longest = field->columns > field->rows ? field->columns : field->rows;
    int *apex = memory_alloc(longest, sizeof *apex, e);
    double *border = memory_alloc((int64_t)2 * longest, sizeof *border, e);
    bool done = apex && border;
    for (int row = 0; done && row < field->rows; row++) {
        spread_along(squared + (int64_t)row * field->columns, field->columns, 1,
                     (double)field->cell.x, apex, border, border + longest);
    }
    for (int column = 0; done && column < field->columns; column++) {
        spread_along(squared + column, field->rows, field->columns, (double)field->cell.y, apex,
                     border, border + longest);
    }
    free(border);
    free(apex);
    return done;
}

static bool fill_river_distance(const HeightField *field, const Drainage *drainage,
                                HeightField *out, Error *e)
{
    int64_t count = drainage->count;
    uint8_t *order = memory_alloc_zero(count, sizeof *order, e);
    double *squared = memory_alloc(count, sizeof *squared, e);
    bool done =
        order && squared && drainage_orders(drainage, height_field_river_area(field), order, e);
    for (int64_t i = 0; done && i < count; i++) {
        squared[i] = order[i] > 0 ? 0.0 : INFINITY;
    }
    done = done && spread(field, squared, e);
    for (int64_t i = 0; done && i < count; i++) {
        out->height[i] = isfinite(field->height[i]) ? (float)sqrt(squared[i]) : NAN;
    }
    free(squared);
    free(order);
    return done;
}

static bool fill_drained(const HeightField *field, DrainageMap *map, HeightField *out, Error *e)
{
    Drainage *drainage = drainage_new(field, e);
    bool done = drainage && map(field, drainage, out, e);
    drainage_free(drainage);
    return done;
}

// ----

static const struct {
    const char *name;
    LocalMap *local;
    DrainageMap *drained;
} maps[] = {{"slope", slope_at, NULL},         {"aspect", aspect_at, NULL},
            {"curvature", curvature_at, NULL}, {"flow", NULL, fill_flow},
            {"wetness", NULL, fill_wetness},   {"river-distance", NULL, fill_river_distance}};

static int find(const char *name)
{
    int count = (int)(sizeof maps / sizeof *maps);
    for (int i = 0; i < count; i++) {
        if (strcmp(maps[i].name, name) == 0) {
            return i;
        }
    }
    return -1;
}

HeightField *height_map(const HeightField *field, const char *name, Error *e)
{
    int k = find(name);
    if (k < 0) {
        error_set(e, ERROR_INPUT, "no map of land is called '%s'; known: %s", name,
                  HEIGHT_MAP_NAMES);
        return NULL;
    }
    HeightField *out = height_field_new(field->columns, field->rows, field->cell, field->origin, e);
    if (!out) {
        return NULL;
    }
    bool done = maps[k].local ? fill_local(field, maps[k].local, out, e)
                              : fill_drained(field, maps[k].drained, out, e);
    if (!done) {
        height_field_free(out);
        return NULL;
    }
    return out;
}
