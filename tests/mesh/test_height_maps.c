// Maps of height fields against closed forms and brute force.
#include "testing.h"

#include "base/memory.h"
#include "base/random.h"
#include "land/height_drainage.h"
#include "land/height_maps.h"
#include "land/height_measure.h"
#include "land/height_raster.h"
#include "mesh/ball.h"

#include <string.h>

enum { COLUMNS = 40, ROWS = 30 };
static const Vec2 CELL = {5.0f, 5.0f};

typedef float Surface(float x, float z);

static HeightField *make(Surface *surface)
{
    HeightField *field = height_field_new(COLUMNS, ROWS, CELL, (Vec2){-100.0f, -75.0f}, NULL);
    assert_non_null(field);
    for (int i = 0; i < COLUMNS * ROWS; i++) {
        int column = i % COLUMNS, row = i / COLUMNS;
        float x = field->origin.x + CELL.x * (float)column;
        float z = field->origin.y + CELL.y * (float)row;
        field->height[i] = surface(x, z);
    }
    return field;
}

static HeightField *map_of(const HeightField *field, const char *name)
{
    Run run = run_default();
    HeightMap kind;
    assert_true(height_map_parse(name, &kind, NULL));
    HeightField *map = height_map(field, &kind, &run, NULL);
    assert_non_null(map);
    assert_true(map->columns == field->columns && map->rows == field->rows);
    return map;
}

static void assert_all(const HeightField *map, float wanted, float tolerance)
{
    for (int i = 0; i < COLUMNS * ROWS; i++) {
        if (!(fabsf(map->height[i] - wanted) <= tolerance)) {
            fail_msg("sample %d: %g, not %g", i, (double)map->height[i], (double)wanted);
        }
    }
}

// ---- planes: the same everywhere, also at the rim

static float level(float x, float z)
{
    (void)x;
    (void)z;
    return 12.0f;
}

static float falls_east(float x, float z)
{
    (void)z;
    return 200.0f - 0.5f * x;
}

static float falls_north_west(float x, float z)
{
    return 200.0f + x + z;
}

static float falls_south(float x, float z)
{
    (void)x;
    return 200.0f - 0.25f * z;
}

static void planes_have_one_slope_and_aspect(void **state)
{
    (void)state;
    const struct {
        Surface *surface;
        float slope, aspect;
    } cases[] = {{level, 0.0f, -1.0f},
                 {falls_east, 26.565f, 90.0f},
                 {falls_north_west, 54.736f, 315.0f},
                 {falls_south, 14.036f, 180.0f}};
    for (int i = 0; i < 4; i++) {
        HeightField *field = make(cases[i].surface);
        HeightField *slope = map_of(field, "slope"), *aspect = map_of(field, "aspect");
        HeightField *curvature = map_of(field, "curvature");
        assert_all(slope, cases[i].slope, 2e-3f);
        assert_all(aspect, cases[i].aspect, 2e-3f);
        assert_all(curvature, 0.0f, 1e-5f);
        height_field_free(curvature);
        height_field_free(aspect);
        height_field_free(slope);
        height_field_free(field);
    }
}

// ---- a bowl of radius 500 m: the Laplacian of (x^2 + z^2) / 2 R is 2 / R

static float bowl(float x, float z)
{
    return (x * x + z * z) / 1000.0f;
}

static void a_bowl_is_hollow(void **state)
{
    (void)state;
    HeightField *field = make(bowl), *map = map_of(field, "curvature");
    HeightField *altitude = map_of(field, "altitude");
    size_t bytes = sizeof *field->height * (size_t)height_field_count(field);
    assert_memory_equal(altitude->height, field->height, bytes);
    height_field_free(altitude);
    for (int row = 1; row < ROWS - 1; row++) {
        for (int column = 1; column < COLUMNS - 1; column++) {
            float c = map->height[row * COLUMNS + column];
            assert_true(fabsf(c - 2.0f / 500.0f) < 1e-5f);
        }
    }
    height_field_free(map);
    height_field_free(field);
}

// ---- a plane that falls south drains row by row: a known catchment at each

static void a_slope_gets_wetter_downward(void **state)
{
    (void)state;
    HeightField *field = make(falls_south);
    HeightField *flow = map_of(field, "flow"), *wetness = map_of(field, "wetness");
    for (int row = 1; row < ROWS - 1; row++) {
        int middle = row * COLUMNS + COLUMNS / 2;
        float area = 25.0f * (float)row; // the first row is rim and drains by itself
        assert_true(fabsf(flow->height[middle] - area) < 0.01f);
        assert_true(fabsf(wetness->height[middle] - logf(area / 5.0f / 0.25f)) < 1e-4f);
    }
    height_field_free(wetness);
    height_field_free(flow);
    height_field_free(field);
}

// ---- rough land

static float rough(float x, float z)
{
    uint64_t key = random_key((uint64_t)(int64_t)(x + 500.0f), (uint64_t)(int64_t)(z + 500.0f));
    return 40.0f + 0.2f * x + 0.02f * z * z / 10.0f + 1.5f * random_unit(key);
}

static float nearest(const uint8_t *order, int at)
{
    float best = INFINITY;
    for (int i = 0; i < COLUMNS * ROWS; i++) {
        int columns = i % COLUMNS - at % COLUMNS, rows = i / COLUMNS - at / COLUMNS;
        float x = CELL.x * (float)columns, z = CELL.y * (float)rows;
        best = order[i] > 0 ? fminf(best, sqrtf(x * x + z * z)) : best;
    }
    return best;
}

static void rivers_are_as_far_as_brute_force_finds(void **state)
{
    (void)state;
    HeightField *field = make(rough), *map = map_of(field, "river-distance");
    Drainage *drainage = drainage_new(field, NULL);
    uint8_t order[COLUMNS * ROWS] = {0};
    assert_true(drainage_orders(drainage, height_field_river_area(field), order, NULL));
    int rivers = 0;
    for (int i = 0; i < COLUMNS * ROWS; i++) {
        rivers += order[i] > 0;
        assert_true(fabsf(map->height[i] - nearest(order, i)) < 1e-3f);
    }
    assert_in_range(rivers, 10, COLUMNS * ROWS / 2);
    drainage_free(drainage);
    height_field_free(map);
    height_field_free(field);
}

static void missing_land_is_missing_in_maps(void **state)
{
    (void)state;
    HeightField *field = make(rough);
    int hole = 12 * COLUMNS + 17;
    field->height[hole] = NAN;
    field->change = memory_alloc_zero(COLUMNS * ROWS, sizeof(float), NULL);
    field->loose = memory_alloc_zero(COLUMNS * ROWS, sizeof(float), NULL);
    field->climate = memory_alloc_zero(COLUMNS * ROWS, sizeof(float), NULL);
    field->ground = memory_alloc_zero(COLUMNS * ROWS, sizeof(float), NULL);
    field->age = memory_alloc_zero(COLUMNS * ROWS, sizeof(float), NULL);
    field->water = memory_alloc_zero(COLUMNS * ROWS, sizeof(float), NULL);
    field->water[COLUMNS * ROWS - 1] = 1e6f; // else river-distance is infinite
    char names[] = HEIGHT_MAP_NAMES;
    for (char *name = strtok(names, " "); name; name = strtok(NULL, " ")) {
        HeightField *map = map_of(field, name);
        for (int i = 0; i < COLUMNS * ROWS; i++) {
            assert_true(isfinite(map->height[i]) == (i != hole));
        }
        height_field_free(map);
    }
    height_field_free(field);
}

static void only_maps_have_names(void **state)
{
    (void)state;
    const char *const wrong[] = {
        "beauty",         "", "slop", "slope:3", "sun-hours:", "sun-hours:91", "sun-hours:3:367",
        "sun-hours:3:4:5"};
    Error e = {0};
    HeightMap map;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        e = (Error){0};
        assert_false(height_map_parse(wrong[i], &map, &e));
        assert_int_equal(e.code, ERROR_INPUT);
        assert_non_null(strstr(e.message, i < 3 ? "known: slope aspect" : "LATITUDE:DAY"));
    }
    assert_true(height_map_parse("sun-hours:-33.5:172", &map, &e));
    assert_true(map.kind == HEIGHT_MAP_SUN_HOURS && map.latitude == -33.5f && map.day == 172);
}

// ---- records of erosion

static void what_is_laid_less_what_is_worn_is_the_change(void **state)
{
    (void)state;
    HeightField *field = make(rough);
    field->change = memory_alloc_zero(COLUMNS * ROWS, sizeof(float), NULL);
    for (int loose = 0; loose < 2; loose++) {
        for (int i = 0; i < COLUMNS * ROWS; i++) {
            field->change[i] = 0.1f * (float)(i % 41 - 25);
        }
        if (loose) { // what lies loose, also where rock was worn below it
            field->loose = memory_alloc_zero(COLUMNS * ROWS, sizeof(float), NULL);
            for (int i = 0; i < COLUMNS * ROWS; i++) {
                field->loose[i] = fmaxf(field->change[i], 0.0f) + 0.125f * (float)(i % 7);
            }
        }
        HeightField *deposit = map_of(field, "deposit"), *wear = map_of(field, "wear");
        for (int i = 0; i < COLUMNS * ROWS; i++) {
            float laid = deposit->height[i], worn = wear->height[i];
            assert_true(laid >= 0.0f && worn >= 0.0f);
            assert_true(fabsf(laid - worn - field->change[i]) < 1e-6f);
            assert_true(loose || laid * worn == 0.0f);
        }
        height_field_free(deposit);
        height_field_free(wear);
    }
    HeightField *bedrock = map_of(field, "bedrock");
    for (int i = 0; i < COLUMNS * ROWS; i++) {
        float wanted = fmaxf(1.0f - 2.0f * field->loose[i], 0.0f);
        assert_true(fabsf(bedrock->height[i] - wanted) < 1e-6f);
    }
    height_field_free(bedrock);
    height_field_free(field);
}

// Level land that ever higher snow feels: none below the line, all above it.
static void snow_lies_above_its_line(void **state)
{
    (void)state;
    HeightField *field = make(level);
    field->climate = memory_alloc_zero(COLUMNS * ROWS, sizeof(float), NULL);
    for (int i = 0; i < COLUMNS * ROWS; i++) {
        field->climate[i] = (float)i / (float)(COLUMNS * ROWS);
    }
    HeightField *map = map_of(field, "snow");
    for (int i = 0; i < COLUMNS * ROWS; i++) {
        float above = field->climate[i] - HEIGHT_MAP_SNOW_LINE, share = map->height[i];
        assert_true(share >= 0.0f && share <= 1.0f);
        assert_true(above > -0.016f || share == 0.0f);
        assert_true(above < 0.021f || share == 1.0f);
    }
    height_field_free(map);
    height_field_free(field);
}

static void land_without_records_has_no_maps_of_them(void **state)
{
    (void)state;
    const char *const names[] = {"deposit", "wear", "bedrock", "snow", "water-depth"};
    HeightField *field = make(rough);
    Run run = run_default();
    for (int i = 0; i < 5; i++) {
        Error e = {0};
        HeightMap map;
        assert_true(height_map_parse(names[i], &map, &e));
        assert_null(height_map(field, &map, &run, &e));
        assert_int_equal(e.code, ERROR_INPUT);
        assert_non_null(strstr(e.message, names[i]));
        assert_non_null(strstr(e.message, "it needs a terrain"));
    }
    height_field_free(field);
}

// A ball seen from above is its upper half.
static void a_mesh_is_seen_from_above(void **state)
{
    (void)state;
    enum { SIDE = 101 };
    Mesh *ball = ball_mesh(60, NULL);
    assert_non_null(ball);
    HeightField *field = height_field_of_mesh(ball, SIDE, NULL);
    assert_non_null(field);
    for (int i = 0; i < SIDE * SIDE; i++) {
        float x = field->origin.x + field->cell.x * (float)(i % SIDE);
        float z = field->origin.y + field->cell.y * (float)(i / SIDE);
        float r = hypotf(x, z);
        if (r < 0.95f) {
            float wanted = sqrtf(1.0f - r * r), off = field->height[i] - wanted;
            assert_true(off < 1e-4f && off > -0.01f); // facets lie below the ball
        } else if (r > 1.001f) {
            assert_true(isnan(field->height[i]));
        }
    }
    height_field_free(field);
    mesh_free(ball);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(planes_have_one_slope_and_aspect),
        cmocka_unit_test(a_bowl_is_hollow),
        cmocka_unit_test(a_slope_gets_wetter_downward),
        cmocka_unit_test(rivers_are_as_far_as_brute_force_finds),
        cmocka_unit_test(missing_land_is_missing_in_maps),
        cmocka_unit_test(only_maps_have_names),
        cmocka_unit_test(what_is_laid_less_what_is_worn_is_the_change),
        cmocka_unit_test(snow_lies_above_its_line),
        cmocka_unit_test(land_without_records_has_no_maps_of_them),
        cmocka_unit_test(a_mesh_is_seen_from_above),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
