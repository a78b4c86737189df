// Braided rivers: even flow, still water, volume, how a bump of gravel moves and bends turn it,
// narrow and wide rivers, the widest thread, threads, resolutions, streamlines.
#include "land/braid_lines.h"
#include "land/braid_measure.h"
#include "land/braid_parts.h"
#include "making.h"
#include "objects/terrain/internal.h"
#include "testing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SLOPE 0.006
#define MEAN 0.5 // m

static Run run_with(int threads)
{
    Run run = run_default();
    run.threads = threads;
    return run;
}

// A plain `wide` cells wide, bed uneven by that share of the mean depth, between walls that nothing
// moves. The flow answers to its bed over `cells` cells.
static Braid *flume(int side, int wide, double cells, double uneven)
{
    double cell = MEAN / SLOPE / cells;
    Braid *b = braid_new(side, side * cell, wide * cell, SLOPE, MEAN, NULL);
    for (int64_t i = 0; i < braid_count(b); i++) {
        bool inside = abs(2 * (int)(i % side) + 1 - side) < wide;
        double u = (double)random_range(random_key(7, (uint64_t)i), -1.0f, 1.0f);
        b->bed[i] = inside ? uneven * MEAN * u : 20.0 * MEAN;
        b->depth[i] = inside ? (float)MEAN : 0.0f;
        b->erodible[i] = inside ? 1.0f : 0.0f;
    }
    return b;
}

static void flow(Braid *b, double discharge, double turnovers, bool moves, int threads)
{
    Error e = {0};
    Run run = run_with(threads);
    BraidRates rates = {.discharge = discharge, .turnovers = turnovers, .moves = moves};
    if (!braid_run(b, &rates, &run, &e)) {
        fail_msg("%s", e.message);
    }
}

// Chezy: discharge in proportion to depth^1.5, at the Froude number of the friction.
static void even_flow_has_its_normal_depth(void **state)
{
    (void)state;
    const double discharge[] = {0.5, 1.0, 2.0};
    for (int n = 0; n < 3; n++) {
        Braid *b = flume(32, 32, 6.0, 0.0);
        flow(b, discharge[n], 6.0, false, 1);
        double wanted = MEAN * pow(discharge[n], 2.0 / 3.0), depth = (double)b->depth[500];
        if (fabs(depth - wanted) > 0.01 * wanted) {
            fail_msg("depth %g m, not %g", depth, wanted);
        }
        assert_true(fabs((double)b->depth[20] - depth) < 1e-4 * depth);
        braid_free(b);
    }
}

static void still_water_stays_level(void **state)
{
    (void)state;
    Braid *b = flume(32, 32, 6.0, 1.5);
    b->slope = 0.0;
    for (int64_t i = 0; i < braid_count(b); i++) {
        b->depth[i] = (float)fmax(0.3 - b->bed[i], 0.0); // islands stand out of it
    }
    braid_begin(b);
    for (int n = 0; n < 200; n++) {
        braid_flow(b, braid_step_limit(b), 1);
    }
    int islands = 0;
    for (int64_t i = 0; i < braid_count(b); i++) {
        islands += b->bed[i] > 0.3;
        assert_true(fabs((double)b->depth[i] - fmax(0.3 - b->bed[i], 0.0)) < 1e-4);
    }
    assert_true(islands > 50);
    braid_free(b);
}

static void volumes_stay_and_threads_do_not_matter(void **state)
{
    (void)state;
    Braid *b = flume(64, 40, 5.0, 0.5), *four = flume(64, 40, 5.0, 0.5),
          *old = flume(64, 40, 5.0, 0.5);
    double gravel = braid_volume(b);
    flow(b, 1.0, 15.0, true, 1);
    flow(four, 1.0, 15.0, true, 4);
    assert_memory_equal(b->bed, four->bed, sizeof *b->bed * (size_t)braid_count(b));
    assert_memory_equal(b->depth, four->depth, sizeof *b->depth * (size_t)braid_count(b));
    assert_true(memcmp(b->bed, old->bed, sizeof *b->bed * (size_t)braid_count(b)) != 0);
    double lost = fabs(braid_volume(b) - gravel) / gravel;
    if (!(lost < 1e-12)) {
        fail_msg("%g of the gravel is lost", lost);
    }
    double water = braid_water(b);
    for (int n = 0; n < 400; n++) {
        braid_flow(b, braid_step_limit(b), 1);
    }
    lost = fabs(braid_water(b) - water) / water; // sums of floats
    if (!(lost < 1e-5)) {
        fail_msg("%g of the water is lost", lost);
    }
    Braid *finer = braid_refined(b, NULL);
    assert_true(fabs(braid_volume(finer) - braid_volume(b)) < 1e-12 * gravel);
    braid_free(b);
    braid_free(four);
    braid_free(old);
    braid_free(finer);
}

// Work is left out only where nothing would happen.
static void dry_columns_need_no_work(void **state)
{
    (void)state;
    Braid *b = flume(64, 20, 5.0, 0.5), *all = flume(64, 20, 5.0, 0.5);
    for (int row = 0; row < all->side; row++) {
        all->span[row] = (BraidSpan){0, all->side};
    }
    flow(b, 1.0, 8.0, true, 1);
    flow(all, 1.0, 8.0, true, 1);
    size_t count = (size_t)braid_count(b);
    assert_memory_equal(b->bed, all->bed, sizeof *b->bed * count);
    assert_memory_equal(b->depth, all->depth, sizeof *b->depth * count);
    assert_memory_equal(b->shear, all->shear, sizeof *b->shear * count);
    assert_memory_equal(b->age, all->age, sizeof *b->age * count);
    for (int row = 0; row < b->side; row++) {
        assert_true(b->span[row].begin > 16 && b->span[row].end < 48);
    }
    braid_free(b);
    braid_free(all);
}

// The crest of a bump along the rows, in cells: of a parabola through the highest place.
static double place_of(const Braid *b)
{
    int top = 1;
    for (int row = 1; row < b->side - 1; row++) {
        top = b->bed[(int64_t)row * b->side] > b->bed[(int64_t)top * b->side] ? row : top;
    }
    const double *h = b->bed + (int64_t)top * b->side;
    double before = h[-b->side], after = h[b->side];
    return top + 0.5 * (after - before) / (2.0 * h[0] - before - after);
}

// Over a bump much shorter than the backwater the level hardly changes, so speed is in inverse
// proportion to depth, and the bump moves at d(load) / d(bed).
static void a_bump_moves_as_its_load_tells(void **state)
{
    (void)state;
    enum { SIDE = 128 };
    Braid *b = flume(SIDE, SIDE, 300.0, 0.0);
    for (int64_t i = 0; i < braid_count(b); i++) {
        int64_t row = i / SIDE;
        double away = (double)row - 40.0;
        b->bed[i] = 0.004 * MEAN * exp(-away * away / 32.0);
    }
    flow(b, 1.0, 0.005, false, 1);
    double from = place_of(b), turnovers = 0.03;
    flow(b, 1.0, turnovers, true, 1);
    double excess = sqrt(1.0 - BRAID_THRESHOLD);
    double growth = 1.5 * excess * 2.0 / MEAN; // of the load with the bed
    int updates = 1 + (int)(turnovers / braid_update_turnovers(b));
    double wanted =
        updates * braid_change(b) * MEAN * growth / (double)braid_load_of((float)BRAID_REFERENCE);
    double moved = place_of(b) - from;
    if (!(fabs(moved - wanted) < 0.1 * wanted)) {
        fail_msg("the bump has moved by %g cells, not %g", moved, wanted);
    }
    braid_free(b);
}

static BraidMeasures measured(const Braid *b)
{
    BraidMeasures m = {0};
    BraidLevel *level = braid_level_new(b, 4, NULL);
    assert_true(braid_measure(b, level, &m, NULL));
    braid_level_free(level);
    return m;
}

// Bars in the middle of a river need room: what is narrow stays one thread, what is wide braids.
static void narrow_rivers_stay_single_and_wide_ones_braid(void **state)
{
    (void)state;
    Braid *narrow = flume(64, 6, 6.0, 0.3), *wide = flume(64, 56, 6.0, 0.3);
    Braid *rivers[] = {narrow, wide};
    for (int n = 0; n < 2; n++) {
        flow(rivers[n], 1.0, 90.0, true, 1);
        flow(rivers[n], 0.4, 3.0, false, 1);
    }
    BraidMeasures one = measured(narrow), many = measured(wide);
    // Bars at the sides of the narrow one cut off a little water here and there.
    if (!(one.threads > 0.95 && one.threads < 1.1 && many.threads > 2.5)) {
        fail_msg("%g threads in a narrow river, %g in a wide one", one.threads, many.threads);
    }
    assert_true(many.wet < 0.9 && fabs(many.fall - SLOPE) < 0.1 * SLOPE);
    braid_free(narrow);
    braid_free(wide);
}

// Three threads of 2, 8 and 4 cells; the flow of a cell is 1, 3 and 1 m^2/s. A single cell of water
// is no thread.
static void the_trunk_is_the_widest_thread(void **state)
{
    (void)state;
    const int first[] = {3, 8, 20, 28}, wide[] = {2, 8, 4, 1};
    const float each[] = {1.0f, 3.0f, 1.0f, 5.0f};
    Braid *b = braid_new(32, 32.0, 32.0, SLOPE, MEAN, NULL);
    for (int n = 0; n < 4; n++) {
        for (int64_t k = 0; k < 32 * (int64_t)wide[n]; k++) {
            int64_t i = k / wide[n] * 32 + first[n] + k % wide[n];
            b->depth[i] = (float)MEAN;
            b->flow_z[i] = each[n];
        }
    }
    BraidMeasures m = measured(b);
    assert_true(m.threads == 3.0 && m.active == 0.0);
    assert_true(fabs(m.trunk_share - 24.0 / 30.0) < 1e-9);
    assert_true(fabs(m.trunk_width - 8.0 / (14.0 / 3.0)) < 1e-9);
    braid_free(b);
}

// On a ring of flow the load heads inward by BRAID_SPIRAL * depth / radius, whichever way it turns;
// straight flow carries it along itself.
static void bends_turn_the_load_inward(void **state)
{
    (void)state;
    enum { SIDE = 64 };
    for (int way = -1; way <= 1; way++) {
        Braid *b = braid_new(SIDE, SIDE * 20.0, SIDE * 20.0, SLOPE, MEAN, NULL);
        for (int64_t i = 0; i < braid_count(b); i++) {
            int64_t row = i / SIDE;
            double x = (double)(i % SIDE) - 31.5, z = (double)row - 31.5;
            b->depth[i] = (float)MEAN;
            b->flow_x[i] = i % SIDE > 0 && way != 0 ? (float)(-way * 0.1 * z) : 0.0f;
            b->flow_z[i] = way != 0 ? (float)(way * 0.1 * x) : 2.0f;
        }
        braid_begin(b);
        braid_find_load(b, 1);
        const float *along = b->load, *down = along + braid_count(b);
        const int64_t place[] = {32 * SIDE + 52, 32 * SIDE + 14, 50 * SIDE + 32, 45 * SIDE + 45};
        for (int n = 0; n < 4; n++) {
            int64_t row = place[n] / SIDE;
            double x = (double)(place[n] % SIDE) - 31.5, z = (double)row - 31.5;
            double radius = sqrt(x * x + z * z), lx = (double)along[place[n]],
                   lz = (double)down[place[n]];
            double inward = -(lx * x + lz * z) / radius, round = way * (lz * x - lx * z) / radius;
            double wanted = BRAID_SPIRAL * MEAN / (radius * b->cell);
            assert_true(way == 0 ? lx == 0.0 && lz > 0.0
                                 : fabs(inward / round - wanted) < 0.05 * wanted);
        }
        braid_free(b);
    }
}

// ---- the form

// The river has as many cells across as the land has samples.
static HeightField *heights(uint64_t seed, int resolution, int threads, MeasureList *list)
{
    Error e = {0};
    Run run = run_with(threads);
    TerrainParams params = terrain_params_default();
    params.form = TERRAIN_BRAIDED;
    params.size = 3000.0f;
    params.resolution = resolution;
    params.evolution.cells = resolution;
    params.braided.threads = 4.0f;
    Recipe recipe = {.seed = seed, .label = "land", .run = &run};
    Grown grown;
    HeightField *field = NULL;
    if (kind_grow(&kind_terrain, &params, &recipe, 1.0f, NULL, &grown, &e)) {
        field = terrain_heights(&params, &grown, &run, &e);
    }
    if (!field || (list && !terrain_measure(&params, &grown, &recipe, list, &e))) {
        fail_msg("%s", e.message);
    }
    grown_clear(&grown);
    return field;
}

static double value(const MeasureList *list, const char *name)
{
    const Measure *measure = measures_find(list, name);
    assert_non_null(measure);
    return measure->value;
}

static void rivers_are_like_natural_ones_at_any_resolution(void **state)
{
    (void)state;
    double threads[2] = {0}, wet[2] = {0};
    for (int n = 0; n < 2; n++) {
        for (uint64_t seed = 1; seed <= 2; seed++) {
            MeasureList list = {0};
            height_field_free(heights(seed, 128 << n, 1, &list));
            double total = value(&list, "threads"), active = value(&list, "active_threads");
            double bars = value(&list, "bar_ratio");
            if (!(total > 3.0 && total < 10.0 && active < total && bars > 2.5 && bars < 6.0)) {
                fail_msg("%g threads, %g active, bars %g times as long as wide", total, active,
                         bars);
            }
            threads[n] += total / 2.0;
            wet[n] += value(&list, "wet_share") / 2.0;
            measures_clear(&list);
        }
    }
    print_message("threads %g and %g, wet %g and %g\n", threads[0], threads[1], wet[0], wet[1]);
    assert_true(fabs(threads[0] / threads[1] - 1.0) < 0.35);
    assert_true(fabs(wet[0] / wet[1] - 1.0) < 0.35);
}

static void the_form_has_the_same_bits_for_any_threads(void **state)
{
    (void)state;
    HeightField *one = heights(4, 128, 1, NULL), *four = heights(4, 128, 4, NULL);
    assert_true(height_field_hash(one) == height_field_hash(four));
    int64_t wet = 0;
    for (int64_t i = 0; i < height_field_count(one); i++) {
        assert_true(one->water[i] == four->water[i] && one->age[i] == four->age[i]);
        wet += one->water[i] > one->height[i];
    }
    assert_true(wet > height_field_count(one) / 20);
    height_field_free(one);
    height_field_free(four);
}

// In even flow over the middle half they lie a metre a metre apart there, and none beside it.
static void streamlines_share_the_discharge(void **state)
{
    (void)state;
    const int side = 32, wide = 16;
    Braid *b = flume(side, wide, 6.0, 0.0);
    flow(b, 1.0, 6.0, false, 1);
    Error e = {0};
    float *lines = braid_lines_new(b, &e);
    assert_non_null(lines);
    for (int n = 0; n <= 2 * side; n++) {
        double u = 0.5 * n, across = (u - 0.25 * side) * b->cell;
        double wanted = fmin(fmax(across, 0.0), b->width);
        float line = braid_line_at(b, lines, u, 7.3);
        if (fabs((double)line - wanted) > 0.02 * b->width) {
            fail_msg("line %g m at column %g, not %g", (double)line, u, wanted);
        }
    }
    free(lines);
    braid_free(b);
}

// Of a river that bends around a bar, too: what flows across a streamline is next to nothing.
static void streamlines_follow_the_flow(void **state)
{
    (void)state;
    const int side = 48, wide = 32;
    Braid *b = flume(side, wide, 6.0, 0.0);
    for (int64_t i = 0; i < braid_count(b); i++) {
        double x = (double)(i % side) - 20.0, z = (double)(i / side) - 24.0;
        b->bed[i] += b->erodible[i] > 0.0f ? 3.0 * MEAN * exp(-(x * x + 0.3 * z * z) / 12.0) : 0.0;
    }
    flow(b, 1.0, 20.0, false, 1);
    Error e = {0};
    float *lines = braid_lines_new(b, &e);
    assert_non_null(lines);
    double across = 0.0, along = 0.0; // of the flow, in lines a second
    for (int row = 1; row + 1 < side; row++) {
        for (int c = side / 4; c < side - side / 4; c++) {
            int64_t i = (int64_t)row * side + c;
            double u = c + 0.5, v = row + 0.5;
            double dx =
                (double)(braid_line_at(b, lines, u + 0.5, v) - braid_line_at(b, lines, u - 0.5, v));
            double dz =
                (double)(braid_line_at(b, lines, u, v + 0.5) - braid_line_at(b, lines, u, v - 0.5));
            double qx = 0.5 * (double)(b->flow_x[i] + b->flow_x[i + 1]);
            double qz = 0.5 * (double)(b->flow_z[i] + b->flow_z[i + side]);
            across += fabs(qx * dx + qz * dz);
            along += fabs(qx * dx) + fabs(qz * dz);
        }
    }
    assert_true(along > 0.0);
    if (across > 0.1 * along) {
        fail_msg("%g of the flow crosses the lines", across / along);
    }
    free(lines);
    braid_free(b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(even_flow_has_its_normal_depth),
        cmocka_unit_test(still_water_stays_level),
        cmocka_unit_test(volumes_stay_and_threads_do_not_matter),
        cmocka_unit_test(dry_columns_need_no_work),
        cmocka_unit_test(a_bump_moves_as_its_load_tells),
        cmocka_unit_test(narrow_rivers_stay_single_and_wide_ones_braid),
        cmocka_unit_test(the_trunk_is_the_widest_thread),
        cmocka_unit_test(bends_turn_the_load_inward),
        cmocka_unit_test(rivers_are_like_natural_ones_at_any_resolution),
        cmocka_unit_test(the_form_has_the_same_bits_for_any_threads),
        cmocka_unit_test(streamlines_share_the_discharge),
        cmocka_unit_test(streamlines_follow_the_flow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
