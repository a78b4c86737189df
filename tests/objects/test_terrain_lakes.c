// Lakes of terrains: level to the bit at the height of their outlets, shores that slope, basins of
// the wanted size, rivers that run through, water that meets the land.
#include "land/height_drainage.h"
#include "making_terrain.h"
#include "objects/terrain/lakes.h"

#include <math.h>
#include <string.h>

enum { SEED = 5 };

static TerrainParams land_of(TerrainForm form, int resolution)
{
    TerrainParams params = terrain_params_default();
    params.form = form;
    params.resolution = resolution;
    params.size = 3000.0f;
    params.lakes.count = 1000;
    return params;
}

// Mountains between so many rivers, whose water is this wide (share), with basins dug into them.
static TerrainParams land_of_rivers(int resolution, int count, float water, int basins)
{
    TerrainParams params = land_of(TERRAIN_RIVERS, resolution);
    params.rivers.count = count;
    params.rivers.water = water;
    params.lakes.basins = basins;
    return params;
}

static const Lakes *lakes_of(const Grown *kept)
{
    return ((const Terrain *)kept->state)->lakes;
}

// The land has been shaped since, but every lake still stands at its spill level, found anew.
static void lakes_stand_at_the_spill_level_of_the_finished_land(void **state)
{
    (void)state;
    TerrainParams params = land_of(TERRAIN_NOISE, 128);
    Grown kept = {0};
    HeightField *field = make_heights(&params, SEED, 1, NULL, &kept);
    const Lakes *lakes = lakes_of(&kept);
    assert_true(lakes->count > 8);
    Error e = {0};
    Drainage *flooded = drainage_spill(field, &e);
    assert_non_null(flooded);
    int64_t wet = 0;
    for (int64_t i = 0; i < height_field_count(field); i++) {
        int32_t label = lakes->label[i];
        if (label >= 0) {
            assert_true(flooded->filled[i] == lakes->lake[label].level);
            assert_true(field->water[i] == lakes->lake[label].level);
            assert_true(field->height[i] < field->water[i]);
            wet++;
        } else {
            assert_true(!(field->water[i] > field->height[i]));
        }
    }
    assert_true(wet > 300);
    drainage_free(flooded);
    height_field_free(field);
    grown_clear(&kept);
}

// The mean slope of the land over the edges that the shoreline crosses.
static double shore_slope(const HeightField *field, const Lakes *lakes)
{
    double sum = 0.0, edges = 0.0;
    for (int64_t i = 0; i + field->columns < height_field_count(field); i++) {
        int64_t next[2] = {i + 1, i + field->columns};
        for (int k = 0; k < 2; k++) {
            if ((lakes->label[i] < 0) != (lakes->label[next[k]] < 0)) {
                sum += fabs((double)(field->height[i] - field->height[next[k]]) /
                            (double)field->cell.x);
                edges += 1.0;
            }
        }
    }
    assert_true(edges > 100.0);
    return sum / edges;
}

// Are all samples around this one, so many cells away, on the same side of the shore?
static bool is_far(const HeightField *field, const Lakes *lakes, int64_t i, int cells)
{
    int column = (int)(i % field->columns), row = (int)(i / field->columns);
    for (int r = row - cells; r <= row + cells; r++) {
        for (int c = column - cells; c <= column + cells; c++) {
            bool within = c >= 0 && r >= 0 && c < field->columns && r < field->rows;
            if (within && lakes->label[(int64_t)r * field->columns + c] != lakes->label[i]) {
                return false;
            }
        }
    }
    return true;
}

static void shores_are_beaches(void **state)
{
    (void)state;
    TerrainParams params = land_of(TERRAIN_NOISE, 128);
    params.noise.amplitude = 0.4f;
    params.lakes.area = 3e4f;
    Grown kept = {0};
    HeightField *field = make_heights(&params, SEED, 1, NULL, &kept);
    TerrainParams bare = params;
    bare.lakes.count = 0;
    HeightField *before = make_heights(&bare, SEED, 0, NULL, NULL);
    assert_null(before->water);
    double steep = shore_slope(before, lakes_of(&kept)), now = shore_slope(field, lakes_of(&kept));
    assert_true(steep > 0.3 && now < 0.6 * steep);
    // Beyond the beaches nothing has changed.
    int64_t same = 0;
    for (int64_t i = 0; i < height_field_count(field); i++) {
        if (is_far(field, lakes_of(&kept), i, 9)) {
            assert_true(field->height[i] == before->height[i]);
            same++;
        }
    }
    assert_true(same > 200);
    height_field_free(before);
    height_field_free(field);
    grown_clear(&kept);
}

static void the_same_bits_for_any_number_of_threads(void **state)
{
    (void)state;
    TerrainParams params = land_of_rivers(128, 300, 0.02f, 3);
    uint64_t hash[2];
    for (int k = 0; k < 2; k++) {
        Grown kept = {0};
        HeightField *field = make_heights(&params, SEED, k == 0 ? 1 : 4, NULL, &kept);
        hash[k] = height_field_hash(field);
        height_field_free(field);
        grown_clear(&kept);
    }
    assert_true(hash[0] == hash[1]);
}

// Their areas fall by rank, their mean depths follow 0.104 m (area / m^2)^0.42.
static void basins_have_the_size_and_depth_of_mountain_lakes(void **state)
{
    (void)state;
    TerrainParams params = land_of_rivers(512, 300, 0.0f, 4);
    Grown kept = {0};
    HeightField *field = make_heights(&params, SEED, 1, NULL, &kept);
    const Lakes *lakes = lakes_of(&kept);
    double cell = (double)(field->cell.x * field->cell.y);
    assert_true(lakes->count >= 3 && lakes->count <= 12);
    double largest = (double)terrain_lake_params(&params).basin_area;
    for (int k = 0; k < 3; k++) {
        double area = (double)lakes->lake[k].samples * cell, wanted = largest / (k + 1);
        double mean = lakes->lake[k].volume / area, nature = 0.104 * pow(area, 0.42);
        print_message("lake %d: %.0f m2 of %.0f, mean depth %.1f m of %.1f\n", k, area, wanted,
                      mean, nature);
        assert_true(area > 0.5 * wanted && area < 2.0 * wanted);
        assert_true(mean > 0.5 * nature && mean < 2.0 * nature);
    }
    height_field_free(field);
    grown_clear(&kept);
}

// The longest row of samples of the second land, along the grid, that lie this far (m) below the
// first, beside a row of samples that are the same in both: a straight wall.
static int longest_straight_wall(const HeightField *whole, const HeightField *dug, float height)
{
    int longest = 0, columns = dug->columns;
    for (int way = 0; way < 4; way++) { // a wall beyond the next sample east, south, west or north
        int64_t beside = (way < 2 ? 1 : -1) * (way % 2 ? columns : 1);
        int64_t along = way % 2 ? 1 : columns, across = way % 2 ? columns : 1;
        for (int line = 1; line < columns - 1; line++) {
            int run = 0;
            for (int k = 1; k < columns - 1; k++) {
                int64_t i = line * across + k * along, n = i + beside;
                bool step = whole->height[i] - dug->height[i] > height &&
                            fabsf(whole->height[n] - dug->height[n]) < 0.5f;
                run = step ? run + 1 : 0;
                longest = run > longest ? run : longest;
            }
        }
    }
    return longest;
}

// Basins lie in the land by banks of their own form, not by the sides of the box that is dug.
static void basins_have_no_straight_walls(void **state)
{
    (void)state;
    HeightField *field[2];
    for (int k = 0; k < 2; k++) {
        TerrainParams params = land_of_rivers(512, 300, 0.0f, 3 * k);
        params.relief = 900.0f;
        Grown kept = {0};
        field[k] = make_heights(&params, SEED, 1, NULL, &kept);
        grown_clear(&kept);
    }
    int wall = longest_straight_wall(field[0], field[1], 4.0f);
    print_message("longest straight wall: %d samples\n", wall);
    assert_true(wall < 10); // 43 without an end of the banks
    height_field_free(field[0]);
    height_field_free(field[1]);
}

// A river that enters a lake leaves it at the lake's level, and falls everywhere else.
static void rivers_run_through_lakes(void **state)
{
    (void)state;
    TerrainParams params = land_of_rivers(256, 200, 0.03f, 3);
    params.lakes.basin_area = 60000.0f;
    Grown kept = {0};
    HeightField *field = make_heights(&params, SEED, 1, NULL, &kept);
    const Terrain *terrain = kept.state;
    const OutTree *water = terrain->water;
    int64_t resting = 0;
    for (int64_t i = 0; i < water->count; i++) {
        Vec3 p = water->position[i];
        float lake = terrain_lake_at(terrain, field, p.x, p.z);
        if (lake > -INFINITY) {
            assert_true(p.y == lake);
            resting++;
        }
    }
    assert_true(resting > 10);
    height_field_free(field);
    grown_clear(&kept);
}

// Silt fills what the ice has dug.
static void silt_takes_the_lakes_volume(void **state)
{
    (void)state;
    double volume[3];
    for (int k = 0; k < 3; k++) {
        TerrainParams params = land_of(TERRAIN_ALPS, 128);
        params.size = 8000.0f;
        params.evolution.cells = 128;
        params.lakes.silt = 0.5f * (float)k;
        Grown kept = {0};
        HeightField *field = make_heights(&params, SEED, 1, NULL, &kept);
        volume[k] = 0.0;
        for (int i = 0; i < lakes_of(&kept)->count; i++) {
            volume[k] += lakes_of(&kept)->lake[i].volume;
        }
        height_field_free(field);
        grown_clear(&kept);
    }
    print_message("volumes: %g, %g, %g m3\n", volume[0], volume[1], volume[2]);
    assert_true(volume[0] > 1.2 * volume[1] && volume[1] > 3.0 * volume[2]);
}

static void no_lakes_change_nothing(void **state)
{
    (void)state;
    TerrainParams params = land_of(TERRAIN_NOISE, 64);
    params.lakes = (TerrainLakeParams){0};
    Grown kept = {0};
    HeightField *field = make_heights(&params, SEED, 1, NULL, &kept);
    assert_null(lakes_of(&kept));
    assert_null(field->water);
    height_field_free(field);
    grown_clear(&kept);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lakes_stand_at_the_spill_level_of_the_finished_land),
        cmocka_unit_test(shores_are_beaches),
        cmocka_unit_test(the_same_bits_for_any_number_of_threads),
        cmocka_unit_test(basins_have_the_size_and_depth_of_mountain_lakes),
        cmocka_unit_test(basins_have_no_straight_walls),
        cmocka_unit_test(rivers_run_through_lakes),
        cmocka_unit_test(silt_takes_the_lakes_volume),
        cmocka_unit_test(no_lakes_change_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
