// River deltas: what the river brings stays or leaves, sand that the flow can carry, still water,
// threads, a network of channels, land within its hull, resolutions.
#include "land/delta_measure.h"
#include "land/delta_parts.h"
#include "making.h"
#include "making_terrain.h"
#include "objects/terrain/delta.h"
#include "testing.h"

#include <math.h>
#include <string.h>

enum { SIDE = 72, WIDE = 5, SHORE = 8 };
#define DEPTH 5.0 // m

static Run run_with(int threads)
{
    Run run = run_default();
    run.threads = threads;
    return run;
}

// A river between old land enters a sea of its own depth; rows from SHORE on are open.
static Delta *basin(uint64_t seed)
{
    Error e = {0};
    Delta *d = delta_new(SIDE, SIDE, 40.0, &e);
    assert_non_null(d);
    d->depth = DEPTH;
    d->slope = 3e-4;
    d->seed = seed;
    d->mouth[0] = 0.5 * SIDE;
    d->mouth[1] = SHORE;
    for (int64_t i = 0; i < delta_count(d); i++) {
        int column = (int)(i % SIDE), row = (int)(i / SIDE);
        bool river = column >= (SIDE - WIDE) / 2 && column < (SIDE + WIDE) / 2;
        bool rim = column == 0 || column == SIDE - 1 || row == SIDE - 1;
        double uneven = (double)random_range(random_key(seed, (uint64_t)i), -0.1f, 0.1f);
        d->kind[i] =
            row < SHORE ? (river ? DELTA_TRUNK : DELTA_PLAIN) : (rim ? DELTA_EDGE : DELTA_OPEN);
        d->bed[i] = d->kind[i] == DELTA_PLAIN ? 1.0 : -DEPTH + uneven;
    }
    assert_true(delta_begin(d, &e));
    return d;
}

static void build(Delta *d, double sand, int64_t steps, int threads)
{
    Error e = {0};
    Run run = run_with(threads);
    DeltaRates rates = {.sand = sand, .bring = 0.4};
    if (!delta_run(d, &rates, steps, &run, &e)) {
        fail_msg("%s", e.message);
    }
}

// What the river has brought is in the bed or has left, for sand alone, for mud alone, and when the
// delta has reached the borders.
static void no_grain_is_lost(void **state)
{
    (void)state;
    const double sand[] = {0.0, 0.4, 1.0};
    for (int n = 0; n < 3; n++) {
        Delta *d = basin(3);
        double before = delta_volume(d), lost;
        build(d, sand[n], n == 1 ? 220 : 60, 1);
        lost = fabs(delta_volume(d) - before - d->given + d->left) / d->given;
        print_message("%.0f %% sand: %.3g m3 brought, %.3g left, error %.1e\n", 100.0 * sand[n],
                      d->given, d->left, lost);
        assert_true(d->given > 0.0 && lost < 1e-10);
        assert_true(n != 1 || d->left > 0.02 * d->given);
        delta_free(d);
    }
}

// Cut off from what it brings, the river only wears its bed where it flows faster than at first:
// still water far from it stays as it is, and the old land, too.
static void beds_that_nothing_reaches_stay(void **state)
{
    (void)state;
    Delta *d = basin(3);
    double corner = d->bed[(int64_t)(SIDE - 2) * SIDE + 1], plain = d->bed[0];
    double trunk = d->bed[(int64_t)3 * SIDE + SIDE / 2];
    build(d, 0.5, 40, 1);
    assert_true(d->bed[(int64_t)(SIDE - 2) * SIDE + 1] == corner);
    assert_true(d->bed[0] == plain && d->bed[(int64_t)3 * SIDE + SIDE / 2] == trunk);
    assert_true(d->bed[(int64_t)(SHORE + 8) * SIDE + SIDE / 2] > -DEPTH + 0.2);
    delta_free(d);
}

// All water passes each section of the trunk: discharge a cell, summed, is that of the river.
static void the_trunk_carries_all_water(void **state)
{
    (void)state;
    Delta *d = basin(3);
    build(d, 0.5, 40, 1);
    for (int row = 2; row < SHORE - 1; row++) {
        double sum = 0.0;
        for (int column = 0; column < SIDE; column++) {
            int64_t i = (int64_t)row * SIDE + column;
            sum += d->kind[i] == DELTA_TRUNK ? d->flow_z[i] : 0.0;
        }
        // A parcel that steps aside counts more than once in a row.
        if (!(sum > 0.97 * WIDE && sum < 1.6 * WIDE)) {
            fail_msg("row %d carries %g, not %d", row, sum, WIDE);
        }
    }
    delta_free(d);
}

// The surface stands above the sea in channels, and rises toward the river.
static void the_surface_falls_to_the_sea(void **state)
{
    (void)state;
    Delta *d = basin(3);
    build(d, 0.5, 120, 1);
    double up = d->level[(int64_t)2 * SIDE + SIDE / 2];
    double mouth = d->level[(int64_t)SHORE * SIDE + SIDE / 2];
    double sea = d->level[(int64_t)(SIDE - 2) * SIDE + SIDE / 2];
    print_message("level %.2f m in the river, %.2f m at its mouth, %.2f m at sea\n", up, mouth,
                  sea);
    assert_true(up > mouth && mouth > sea && sea >= d->sea && sea < d->sea + 0.05);
    delta_free(d);
}

static void threads_do_not_change_the_bed(void **state)
{
    (void)state;
    Delta *first = basin(5);
    build(first, 0.4, 30, 1);
    size_t bytes = (size_t)delta_count(first) * sizeof(double);
    for (int threads = 2; threads <= 3; threads++) {
        Delta *d = basin(5);
        build(d, 0.4, 30, threads);
        assert_memory_equal(d->bed, first->bed, bytes);
        assert_memory_equal(d->level, first->level, bytes);
        assert_memory_equal(d->mud, first->mud, bytes);
        delta_free(d);
    }
    delta_free(first);
}

// A disc with two channels across it, by hand.
static void measures_are_those_of_a_known_delta(void **state)
{
    (void)state;
    const double radius = 24.0;
    DeltaMeasures m;
    Delta *d = basin(3);
    int64_t land = 0;
    for (int64_t i = 0; i < delta_count(d); i++) {
        double x = (double)(i % SIDE) - d->mouth[0], z = (double)(i / SIDE) - d->mouth[1];
        bool channel = fabs(fabs(x) - 0.4 * z) < 2.0 && z > 5.0;
        bool disc = z >= 0.0 && x * x + z * z < radius * radius;
        d->level[i] = 0.0;
        d->speed[i] = disc && channel ? 1.0 : 0.0;
        if (d->kind[i] == DELTA_OPEN) {
            d->bed[i] = disc && !channel ? 0.5 : -DEPTH;
            land += disc && !channel;
        }
    }
    assert_true(delta_measure(d, 0.0, &m, NULL));
    double area = (double)land * d->cell * d->cell, half = 0.5 * 3.14159265 * radius * radius;
    assert_true(fabs(m.land - area) < 1e-6 * area);
    assert_true(fabs(m.reach / d->cell - radius) < 1.0);
    assert_true(fabs(m.branches - 2.0) < 0.1 && m.mouths == 2.0);
    assert_true(fabs(m.land_share / ((double)land / half) - 1.0) < 0.06);
    // Each side of a slanting channel counts its steps along both axes.
    double shores = m.shoreline * sqrt((double)land);
    assert_true(shores > 3.14159265 * radius && shores < 9.0 * radius + 4.0 * 1.5 * radius);
    delta_free(d);
}

static TerrainParams small_delta(void)
{
    TerrainParams params = terrain_params_default();
    params.form = TERRAIN_DELTA;
    params.size = 4096.0f;
    params.resolution = 128;
    params.delta.width = 128.0f; // 160 cells of the model
    params.delta.age = 0.6f;
    return params;
}

// Channels part into a network, whose land and water alternate in its hull.
static void the_river_parts_into_many(void **state)
{
    (void)state;
    TerrainParams params = small_delta();
    MeasureList list = {0};
    Grown grown;
    HeightField *field = make_heights(&params, 5, 0, &list, &grown);
    double branches = measured(&list, "branches"), mouths = measured(&list, "mouths");
    double share = measured(&list, "land_share"), shores = measured(&list, "shoreline_ratio");
    const Delta *d = ((const Terrain *)grown.state)->delta->model;
    print_message("%.1f branches, %.0f at most, land on %.0f %% of the hull, shoreline %.1f, "
                  "%.1f %% lost\n",
                  branches, mouths, 100.0 * share, shores, 100.0 * d->left / d->given);
    assert_true(branches >= 5.0 && mouths >= 8.0);
    assert_true(share > 0.25 && share < 0.85);
    assert_true(shores > 10.0); // a half disc has 4.1
    assert_true(d->left < 0.1 * d->given);
    measures_clear(&list);
    height_field_free(field);
    grown_clear(&grown);
}

// Mean and most of the mud on a ring about the river's mouth, in cells, off the grid's rim.
static void ring(const DeltaLand *land, double from, double to, double *mean, double *most)
{
    const Delta *d = land->model;
    int64_t count = 0;
    *mean = *most = 0.0;
    for (int64_t i = 0; i < delta_count(d); i++) {
        double x = (double)(i % d->columns) - d->mouth[0],
               z = (double)(i / d->columns) - d->mouth[1];
        double far = sqrt(x * x + z * z), load = (double)land->load[i];
        if (d->kind[i] == DELTA_OPEN && far >= from && far < to) {
            *mean += load;
            *most = fmax(*most, load);
            count++;
        }
    }
    assert_true(count > 100);
    *mean /= (double)count;
}

// Beyond the last channels mud goes on in plumes: less of it the farther out, and unevenly.
static void mud_runs_out_in_plumes(void **state)
{
    (void)state;
    TerrainParams params = small_delta();
    params.delta.age = 0.3f;
    MeasureList list = {0};
    Grown grown;
    HeightField *field = make_heights(&params, 5, 0, &list, &grown);
    const DeltaLand *land = ((const Terrain *)grown.state)->delta;
    const Delta *d = land->model;
    double reach = 0.0;
    for (int64_t i = 0; i < delta_count(d); i++) {
        double x = (double)(i % d->columns) - d->mouth[0],
               z = (double)(i / d->columns) - d->mouth[1];
        bool channel = d->kind[i] == DELTA_OPEN && d->speed[i] > 0.3;
        reach = channel ? fmax(reach, sqrt(x * x + z * z)) : reach;
        assert_true(land->load[i] >= 0.0f && land->load[i] <= 1.2f);
    }
    double last = 1.0;
    for (int k = 0; k < 3; k++) {
        double mean, most, from = reach + 4.0 + 10.0 * k;
        ring(land, from, from + 4.0, &mean, &most);
        print_message("%.0f to %.0f cells: mud %.3f, up to %.3f\n", from, from + 4.0, mean, most);
        assert_true(mean < last && mean > 0.005 && most > 1.4 * mean);
        last = mean;
    }
    measures_clear(&list);
    height_field_free(field);
    grown_clear(&grown);
}

// The model does not know the terrain's grid: samples that two grids share are the same.
static void a_finer_grid_shows_the_same_land(void **state)
{
    (void)state;
    enum { CELLS = 64 };
    TerrainParams params = small_delta();
    params.delta.width = 256.0f;
    HeightField *field[2];
    for (int k = 0; k < 2; k++) {
        params.resolution = CELLS << k;
        field[k] = make_heights(&params, 5, 1 + k, NULL, NULL);
    }
    for (int64_t row = 0; row <= CELLS; row++) {
        for (int64_t column = 0; column <= CELLS; column++) {
            int64_t coarse = row * (CELLS + 1) + column;
            int64_t fine = 2 * row * (2 * CELLS + 1) + 2 * column;
            assert_true(field[0]->height[coarse] == field[1]->height[fine]);
            assert_true(field[0]->water[coarse] == field[1]->water[fine]);
            assert_true(field[0]->age[coarse] == field[1]->age[fine]);
        }
    }
    height_field_free(field[0]);
    height_field_free(field[1]);
}

// Rivers of different widths, on grids of different cells, that bring as much build deltas of about
// the same area above shoals: half of the depth.
static double shoal_area(float width)
{
    TerrainParams params = small_delta();
    Grown grown;
    int64_t cells = 0;
    params.delta.width = width;
    params.delta.depth = 4.0f;
    HeightField *field = make_heights(&params, 5, 0, NULL, &grown);
    const Delta *d = ((const Terrain *)grown.state)->delta->model;
    for (int64_t i = 0; i < delta_count(d); i++) {
        cells += d->kind[i] == DELTA_OPEN && d->bed[i] > -0.5 * d->depth;
    }
    double area = (double)cells * d->cell * d->cell;
    height_field_free(field);
    grown_clear(&grown);
    return area;
}

static void grids_agree_on_the_area(void **state)
{
    (void)state;
    double coarse = shoal_area(256.0f), fine = shoal_area(160.0f); // 80 and 128 cells
    print_message("%.3f and %.3f km2\n", 1e-6 * coarse, 1e-6 * fine);
    assert_true(fabs(coarse / fine - 1.0) < 0.15);
}

static void a_river_must_enter(void **state)
{
    (void)state;
    Error e = {0};
    Delta *d = delta_new(SIDE, SIDE, 40.0, &e);
    assert_false(delta_begin(d, &e));
    assert_non_null(strstr(e.message, "no river enters"));
    delta_free(d);
    assert_null(delta_new(8, SIDE, 40.0, &e));
    assert_int_equal(e.code, ERROR_INPUT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_grain_is_lost),
        cmocka_unit_test(beds_that_nothing_reaches_stay),
        cmocka_unit_test(the_trunk_carries_all_water),
        cmocka_unit_test(the_surface_falls_to_the_sea),
        cmocka_unit_test(threads_do_not_change_the_bed),
        cmocka_unit_test(measures_are_those_of_a_known_delta),
        cmocka_unit_test(the_river_parts_into_many),
        cmocka_unit_test(mud_runs_out_in_plumes),
        cmocka_unit_test(a_finer_grid_shows_the_same_land),
        cmocka_unit_test(grids_agree_on_the_area),
        cmocka_unit_test(a_river_must_enter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
