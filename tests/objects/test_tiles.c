// Tiles of a world: made alone, they match the world made whole, bit for bit.
#include "base/noise.h"
#include "land/height_drainage.h"
#include "land/tiles.h"
#include "testing.h"

#include <math.h>
#include <string.h>

enum { WORLD = 64, TILES = 4, CELLS = 64 };

static const TileGrid GRID = {.count = TILES, .cells = CELLS, .detail = 1.0f, .seed = 11};

static Run run_with(int threads)
{
    Run run = run_default();
    run.threads = threads;
    return run;
}

static HeightField *make_world(bool periodic)
{
    HeightField *world =
        height_field_new(WORLD + 1, WORLD + 1, (Vec2){16, 16}, (Vec2){-512, -512}, NULL);
    world->loose = malloc(sizeof(float) * (size_t)height_field_count(world));
    world->periodic = periodic;
    for (int i = 0; i < height_field_count(world); i++) {
        float x = (float)(i % (WORLD + 1)) / 17.0f, z = (float)(i / (WORLD + 1)) / 17.0f;
        world->height[i] = 120.0f * noise_plane_fractal(x, z, 4, 5) + 0.4f * x;
        world->loose[i] = (float)(i % 7);
    }
    return world;
}

static HeightField *cut(const HeightField *world, const TileGrid *grid, int column, int row,
                        int threads)
{
    Error e = {0};
    Run run = run_with(threads);
    HeightField *tile = tile_land(world, grid, column, row, &run, &e);
    if (!tile) {
        fail_msg("%s", e.message);
    }
    return tile;
}

static void check_tiles(bool periodic)
{
    HeightField *world = make_world(periodic);
    TileGrid one = GRID;
    one.count = 1;
    one.cells = TILES * CELLS;
    HeightField *whole = cut(world, &one, 0, 0, 2);
    for (int t = 0; t < TILES * TILES; t++) {
        int column = t % TILES, row = t / TILES;
        HeightField *tile = cut(world, &GRID, column, row, 1 + t % 3);
        assert_int_equal(tile->columns, CELLS + 1);
        for (int r = 0; r <= CELLS; r++) {
            int64_t from = (int64_t)(row * CELLS + r) * whole->columns + column * CELLS;
            assert_memory_equal(whole->height + from, tile->height + r * (CELLS + 1),
                                sizeof(float) * (CELLS + 1));
            assert_memory_equal(whole->loose + from, tile->loose + r * (CELLS + 1),
                                sizeof(float) * (CELLS + 1));
        }
        assert_true(tile->origin.x == whole->origin.x + (float)(column * CELLS) * whole->cell.x);
        height_field_free(tile);
    }
    height_field_free(whole);
    height_field_free(world);
}

static void tiles_are_the_world_made_whole(void **state)
{
    (void)state;
    check_tiles(false);
    check_tiles(true);
}

static void without_detail_samples_stay(void **state)
{
    (void)state;
    HeightField *world = make_world(false);
    TileGrid plain = GRID;
    plain.detail = 0.0f;
    HeightField *tile = cut(world, &plain, 1, 2, 2);
    for (int r = 0; r <= CELLS; r += 4) {
        for (int c = 0; c <= CELLS; c += 4) {
            int64_t i = (int64_t)(2 * CELLS + r) / 4 * world->columns + (CELLS + c) / 4;
            assert_true(tile->height[r * (CELLS + 1) + c] == world->height[i]);
        }
    }
    height_field_free(tile);
    height_field_free(world);
}

// Maps: those that look at neighbours are those of the world made whole, those that reach far are
// the world's own.
static void maps_match(void **state)
{
    (void)state;
    Run run = run_with(2);
    HeightField *world = make_world(false);
    TileGrid one = GRID;
    one.count = 1;
    one.cells = TILES * CELLS;
    HeightMap slope = {.kind = HEIGHT_MAP_SLOPE}, flow = {.kind = HEIGHT_MAP_FLOW};
    HeightField *whole = tile_map(world, &one, 0, 0, &slope, &run, NULL);
    HeightField *tile = tile_map(world, &GRID, 2, 1, &slope, &run, NULL);
    HeightField *far = height_map(world, &flow, &run, NULL);
    HeightField *gathered = tile_map(world, &GRID, 2, 1, &flow, &run, NULL);
    for (int r = 0; r <= CELLS; r++) {
        int64_t from = (int64_t)(CELLS + r) * whole->columns + 2 * CELLS;
        assert_memory_equal(whole->height + from, tile->height + r * (CELLS + 1),
                            sizeof(float) * (CELLS + 1));
    }
    assert_true(gathered->height[0] == far->height[16 * far->columns + 32]);
    height_field_free(gathered);
    height_field_free(far);
    height_field_free(tile);
    height_field_free(whole);
    height_field_free(world);
}

// Detail stays near the world's land, is rough where that is steep, and drains.
static void detail_is_land(void **state)
{
    (void)state;
    HeightField *world = make_world(false);
    TileGrid one = GRID, plain = GRID;
    one.count = plain.count = 1;
    one.cells = plain.cells = TILES * CELLS;
    plain.detail = 0.0f;
    HeightField *rough = cut(world, &one, 0, 0, 2), *smooth = cut(world, &plain, 0, 0, 2);
    double square = 0.0, mean = 0.0, count = (double)height_field_count(rough);
    for (int64_t i = 0; i < height_field_count(rough); i++) {
        double d = (double)rough->height[i] - (double)smooth->height[i];
        square += d * d / count;
        mean += d / count;
    }
    double share = (double)height_field_pits(rough) / count;
    print_message("detail: %.2f m rms, mean %.2f m, cells of 4 m; pits %.5f of the samples\n",
                  sqrt(square), mean, share);
    assert_true(sqrt(square) > 0.2 && sqrt(square) < 4.0 && fabs(mean) < 1.0);
    assert_true(share < 0.004);
    height_field_free(rough);
    height_field_free(smooth);
    height_field_free(world);
}

static void flat_land_stays_flat(void **state)
{
    (void)state;
    HeightField *world = make_world(false);
    memset(world->height, 0, sizeof(float) * (size_t)height_field_count(world));
    HeightField *tile = cut(world, &GRID, 0, 3, 2);
    for (int64_t i = 0; i < height_field_count(tile); i++) {
        assert_true(tile->height[i] == 0.0f);
    }
    height_field_free(tile);
    height_field_free(world);
}

static void wrong_tiles_are_refused(void **state)
{
    (void)state;
    HeightField *world = make_world(false);
    Run run = run_with(1);
    Error e = {0};
    assert_null(tile_land(world, &GRID, TILES, 0, &run, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    TileGrid coarse = {.count = 2, .cells = 16};
    assert_null(tile_land(world, &coarse, 0, 0, &run, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    height_field_free(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tiles_are_the_world_made_whole),
        cmocka_unit_test(without_detail_samples_stay),
        cmocka_unit_test(maps_match),
        cmocka_unit_test(detail_is_land),
        cmocka_unit_test(flat_land_stays_flat),
        cmocka_unit_test(wrong_tiles_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
