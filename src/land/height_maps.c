#include "land/height_maps.h"

#include "base/distance_transform.h"
#include "base/exact_math.h"
#include "base/memory.h"
#include "land/height_drainage.h"
#include "land/height_measure.h"
#include "land/sun_hours.h"

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

static float altitude_at(const HeightField *field, const Around *a)
{
    (void)field;
    return a->h[4];
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
    for (int64_t i = 0; i < drainage->samples; i++) {
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

// Where a field records its water, that is the river: its edge, not the middle, is at distance 0.
static bool is_river(const HeightField *field, const uint8_t *order, int64_t i)
{
    return field->water ? field->water[i] > field->height[i] : order[i] > 0;
}

static bool fill_river_distance(const HeightField *field, const Drainage *drainage,
                                HeightField *out, Error *e)
{
    int64_t count = drainage->samples;
    uint8_t *order = memory_alloc_zero(count, sizeof *order, e);
    double *squared = memory_alloc(count, sizeof *squared, e);
    bool done =
        order && squared && drainage_orders(drainage, height_field_river_area(field), order, e);
    for (int64_t i = 0; done && i < count; i++) {
        squared[i] = is_river(field, order, i) ? 0.0 : INFINITY;
    }
    done = done && distance_transform(squared, field->columns, field->rows, (double)field->cell.x,
                                      (double)field->cell.y, e);
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

// ---- maps of how the land came to be

typedef bool RecordMap(const HeightField *field, HeightField *out);

// What streams and slopes have laid down is what lies loose where that is known.
static bool fill_deposit(const HeightField *field, HeightField *out)
{
    for (int64_t i = 0; i < height_field_count(field) && (field->loose || field->change); i++) {
        out->height[i] = field->loose ? field->loose[i] : fmaxf(field->change[i], 0.0f);
    }
    return field->loose || field->change;
}

static bool fill_wear(const HeightField *field, HeightField *out)
{
    for (int64_t i = 0; i < height_field_count(field) && field->change; i++) {
        float laid = field->loose ? field->loose[i] : fmaxf(field->change[i], 0.0f);
        out->height[i] = laid - field->change[i];
    }
    return field->change;
}

static bool fill_bedrock(const HeightField *field, HeightField *out)
{
    const float covered = 0.5f; // m that hide all rock
    for (int64_t i = 0; i < height_field_count(field) && field->loose; i++) {
        out->height[i] = fmaxf(1.0f - field->loose[i] / covered, 0.0f);
    }
    return field->loose;
}

// As the pattern alps draws it, without its noise: near the line only gentle slopes hold snow, far
// above it all but walls do.
static bool fill_snow(const HeightField *field, HeightField *out)
{
    for (int64_t i = 0; i < height_field_count(field) && field->climate; i++) {
        Around around = look_around(field, (int)(i % field->columns), (int)(i / field->columns));
        float slope = steepness(gradient(field, &around));
        float upright = 1.0f / sqrtf(1.0f + slope * slope),
              cold = field->climate[i] - HEIGHT_MAP_SNOW_LINE;
        float least = lerpf(0.80f, 0.46f, smoothstepf(-0.04f, 0.22f, cold));
        out->height[i] =
            smoothstepf(-0.015f, 0.02f, cold) * smoothstepf(least - 0.02f, least + 0.05f, upright);
    }
    return field->climate;
}

static bool fill_age(const HeightField *field, HeightField *out)
{
    for (int64_t i = 0; i < height_field_count(field) && field->age; i++) {
        out->height[i] = field->age[i];
    }
    return field->age;
}

static bool fill_water_depth(const HeightField *field, HeightField *out)
{
    for (int64_t i = 0; i < height_field_count(field) && field->water; i++) {
        float depth = field->water[i] - field->height[i];
        out->height[i] = isfinite(depth) ? depth : NAN;
    }
    return field->water;
}

static bool fill_lava(const HeightField *field, HeightField *out)
{
    for (int64_t i = 0; i < height_field_count(field) && field->ground; i++) {
        out->height[i] = fmaxf(field->ground[i], 0.0f);
    }
    return field->ground;
}

static bool fill_scoria(const HeightField *field, HeightField *out)
{
    for (int64_t i = 0; i < height_field_count(field) && field->ground; i++) {
        out->height[i] = fmaxf(-field->ground[i], 0.0f);
    }
    return field->ground;
}

static bool fill_record(const HeightField *field, RecordMap *map, HeightField *out)
{
    bool known = map(field, out);
    for (int64_t i = 0; known && i < height_field_count(field); i++) {
        out->height[i] = isfinite(field->height[i]) ? out->height[i] : NAN;
    }
    return known;
}

// ----

static const struct {
    const char *name;
    LocalMap *local;
    DrainageMap *drained;
    RecordMap *record;
    const char *needs; // of a record: what has it
} maps[] = {
    [HEIGHT_MAP_SLOPE] = {"slope", .local = slope_at},
    [HEIGHT_MAP_ASPECT] = {"aspect", .local = aspect_at},
    [HEIGHT_MAP_CURVATURE] = {"curvature", .local = curvature_at},
    [HEIGHT_MAP_FLOW] = {"flow", .drained = fill_flow},
    [HEIGHT_MAP_WETNESS] = {"wetness", .drained = fill_wetness},
    [HEIGHT_MAP_RIVER_DISTANCE] = {"river-distance", .drained = fill_river_distance},
    [HEIGHT_MAP_DEPOSIT] =
        {"deposit", .record = fill_deposit,
         .needs = "a terrain with erosion, or of form canyon, mesas, alps or volcano"},
    [HEIGHT_MAP_WEAR] = {"wear", .record = fill_wear,
                         .needs = "a terrain with erosion, or of form canyon or mesas"},
    [HEIGHT_MAP_BEDROCK] = {"bedrock", .record = fill_bedrock,
                            .needs = "a terrain of form canyon, mesas, alps or volcano"},
    [HEIGHT_MAP_SNOW] = {"snow", .record = fill_snow, .needs = "a terrain of form alps or volcano"},
    [HEIGHT_MAP_LAVA] = {"lava", .record = fill_lava, .needs = "a terrain of form volcano"},
    [HEIGHT_MAP_SCORIA] = {"scoria", .record = fill_scoria, .needs = "a terrain of form volcano"},
    [HEIGHT_MAP_AGE] = {"age", .record = fill_age, .needs = "a terrain of form braided or meander"},
    [HEIGHT_MAP_WATER_DEPTH] = {"water-depth", .record = fill_water_depth,
                                .needs = "a terrain with water_level or lakes, with rivers wider "
                                         "than 1.2 cells, or of form braided "
                                         "or meander"},
    [HEIGHT_MAP_SUN_HOURS] = {"sun-hours"},
    [HEIGHT_MAP_ALTITUDE] = {"altitude", .local = altitude_at}};

static int find(const char *name, size_t length)
{
    int count = (int)(sizeof maps / sizeof *maps);
    for (int i = 0; i < count; i++) {
        if (strlen(maps[i].name) == length && strncmp(maps[i].name, name, length) == 0) {
            return i;
        }
    }
    return -1;
}

bool height_map_parse(const char *text, HeightMap *map, Error *e)
{
    size_t length = strcspn(text, ":");
    *map = (HeightMap){find(text, length), HEIGHT_MAP_LATITUDE, 0};
    if (map->kind < 0) {
        return error_set(e, ERROR_INPUT, "no map of land is called '%.*s'; known: %s", (int)length,
                         text, HEIGHT_MAP_NAMES);
    }
    if (!text[length]) {
        return true;
    }
    char *end = NULL;
    double latitude = strtod(text + length + 1, &end);
    long day = *end == ':' ? strtol(end + 1, &end, 10) : 0;
    if (map->kind != HEIGHT_MAP_SUN_HOURS || *end || end == text + length + 1 ||
        !(fabs(latitude) <= 90.0) || day < 0 || day > 366) {
        return error_set(e, ERROR_INPUT,
                         "the map '%s'; only sun-hours takes numbers, as sun-hours:LATITUDE:DAY, "
                         "with a latitude from -90 to 90 and a day of the year from 1 to 366, or 0 "
                         "for the year's mean",
                         text);
    }
    map->latitude = (float)latitude;
    map->day = (int)day;
    return true;
}

static bool fill(const HeightField *field, const HeightMap *map, HeightField *out, const Run *run,
                 Error *e)
{
    if (maps[map->kind].local) {
        return fill_local(field, maps[map->kind].local, out, e);
    }
    if (maps[map->kind].drained) {
        return fill_drained(field, maps[map->kind].drained, out, e);
    }
    if (map->kind == HEIGHT_MAP_SUN_HOURS) {
        return sun_hours(field, map->latitude, map->day, out->height, run, e);
    }
    return fill_record(field, maps[map->kind].record, out) ||
           error_set(e, ERROR_INPUT, "the land has no map '%s'; it needs %s", maps[map->kind].name,
                     maps[map->kind].needs);
}

HeightField *height_map(const HeightField *field, const HeightMap *map, const Run *run, Error *e)
{
    HeightField *out = height_field_new(field->columns, field->rows, field->cell, field->origin, e);
    if (out &&
        !(height_field_take_place(out, field, 0.0, 0.0, e) && fill(field, map, out, run, e))) {
        height_field_free(out);
        return NULL;
    }
    return out;
}
