// Debris flows and rockfall (land/landscape.h): what they scour is kept, comes to rest at its
// angle, and leaves couloirs between ribs.
#include "base/random.h"
#include "land/landscape.h"
#include "making_terrain.h"
#include "objects/terrain/terrain.h"
#include "testing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CELLS = 64, FOOT = 24 };
static const double CELL = 15.0, REPOSE = 0.7;

// Level ground, on which water leaves in the west, and a steep wall in the east with small
// bumps. Rock is weak here and there, but no joints let it fall.
static Landscape *wall(double steep)
{
    Landscape *land = landscape_new(CELLS, CELLS * CELL, NULL, NULL);
    assert_non_null(land);
    for (int64_t i = 0; i < landscape_count(land); i++) {
        double up = (double)(i % land->side) - FOOT;
        float bump = random_range(random_key(3, (uint64_t)i), 0.0f, 1.0f);
        land->rock[i] = (up > 0.0 ? steep * CELL * up : 0.0) + (double)bump;
        land->weakness[i] = 0.7f + 0.6f * bump;
    }
    for (int row = 0; row < land->side; row++) {
        landscape_set_base(land, (int64_t)row * land->side, 0.0);
    }
    return land;
}

// Debris alone: neither streams nor weathering.
static LandscapeRates rates_of(double debris)
{
    return (LandscapeRates){
        .debris = debris, .least_debris = 3e3, .rubble = 0.6, .repose = REPOSE, .seed = 5};
}

static void run_on(Landscape *land, double debris, int steps, int threads)
{
    Error e = {0};
    Run run = run_default();
    run.threads = threads;
    LandscapeRates rates = rates_of(debris);
    for (int i = 0; i < steps; i++) {
        rates.seed = random_key(5, (uint64_t)i);
        if (!landscape_step(land, &rates, 0.02, true, &run, &e)) {
            fail_msg("%s", e.message);
        }
    }
}

static void volume_is_kept_by_any_threads(void **state)
{
    (void)state;
    Landscape *land = wall(0.95), *same = wall(0.95);
    double before = landscape_volume(land), moved = 0.0;
    run_on(land, 20.0, 30, 1);
    run_on(same, 20.0, 30, 3);
    for (int64_t i = 0; i < landscape_count(land); i++) {
        assert_true(land->loose[i] >= 0.0);
        moved += land->loose[i] * CELL * CELL;
    }
    assert_true(moved > 1e5 && land->outflow > 1e5);
    assert_true(fabs(landscape_volume(land) - before) < 1e-9 * before);
    size_t bytes = sizeof(double) * (size_t)landscape_count(land);
    assert_memory_equal(land->rock, same->rock, bytes);
    assert_memory_equal(land->loose, same->loose, bytes);
    landscape_free(land);
    landscape_free(same);
}

// Debris of a small catchment comes to rest on ground less steep than its angle of repose.
static void ground_below_the_angle_is_not_scoured(void **state)
{
    (void)state;
    enum { SMALL = 12 }; // 12 * 12 * 15^2 m^2 < 4e4 m^2
    Landscape *land = landscape_new(SMALL, SMALL * CELL, NULL, NULL);
    double rock[(SMALL + 1) * (SMALL + 1)];
    for (int64_t i = 0; i < landscape_count(land); i++) {
        rock[i] = land->rock[i] = 0.9 * REPOSE * CELL * (double)(i % land->side);
    }
    for (int row = 0; row < land->side; row++) {
        landscape_set_base(land, (int64_t)row * land->side, 0.0);
    }
    run_on(land, 100.0, 10, 1);
    assert_memory_equal(land->rock, rock, sizeof rock);
    landscape_free(land);
}

// At the foot of the wall lies scree, nowhere steeper than its angle by more than slides leave.
static void scree_lies_at_its_angle(void **state)
{
    (void)state;
    Landscape *land = wall(0.95);
    run_on(land, 20.0, 60, 1);
    double highest = 0.0, steepest = 0.0;
    for (int row = 1; row < CELLS; row++) {
        for (int column = 1; column <= FOOT; column++) {
            int64_t i = (int64_t)row * land->side + column;
            double fall = land->rock[i] + land->loose[i] - land->rock[i - 1] - land->loose[i - 1];
            highest = fmax(highest, land->loose[i]);
            steepest = land->loose[i] > 2.0 ? fmax(steepest, fall / CELL) : steepest;
        }
    }
    if (!(highest > 15.0 && steepest > 0.6 * REPOSE && steepest < 1.25 * REPOSE)) {
        fail_msg("%g m of scree, as steep as %g", highest, steepest);
    }
    landscape_free(land);
}

// m: the standard deviation of heights along the wall, half way up.
static double relief_along(const Landscape *land)
{
    double sum = 0.0, squares = 0.0, count = 0.0;
    for (int row = 8; row <= CELLS - 8; row++) {
        double h = land->rock[(int64_t)row * land->side + (FOOT + CELLS) / 2];
        sum += h;
        squares += h * h;
        count += 1.0;
    }
    return sqrt(fmax(squares / count - sum * sum / (count * count), 0.0));
}

static void couloirs_part_a_wall_into_ribs(void **state)
{
    (void)state;
    Landscape *land = wall(0.95), *still = wall(0.95);
    run_on(land, 20.0, 60, 1);
    run_on(still, 0.0, 60, 1);
    double ribs = relief_along(land), before = relief_along(still);
    if (!(ribs > 2.0 && ribs > 6.0 * before)) {
        fail_msg("%g m, %g m without debris", ribs, before);
    }
    landscape_free(land);
    landscape_free(still);
}

// Ridges of noise, steep enough for couloirs, carved by `debris`.
static HeightField *carved(int resolution, float debris)
{
    TerrainParams params = terrain_params_default();
    params.form = TERRAIN_NOISE;
    params.size = 6000.0f;
    params.resolution = resolution;
    params.noise.amplitude = 0.45f;
    params.noise.wavelength = 0.4f;
    params.noise.iterations = 3;
    params.erosion.debris = debris;
    return make_heights(&params, 4, 1, NULL, NULL);
}

// erosion.debris: the same couloirs at twice the resolution, where samples coincide.
static void more_resolution_shows_the_same_couloirs(void **state)
{
    (void)state;
    HeightField *coarse = carved(256, 1.0f), *fine = carved(512, 1.0f);
    HeightField *coarse_before = carved(256, 0.0f), *fine_before = carved(512, 0.0f);
    double both = 0.0, first = 0.0, second = 0.0;
    for (int64_t i = 0; i < height_field_count(coarse); i++) {
        int64_t k = 2 * (i / 257) * 513 + 2 * (i % 257);
        double a = (double)(coarse->height[i] - coarse_before->height[i]);
        double b = (double)(fine->height[k] - fine_before->height[k]);
        both += a * b;
        first += a * a;
        second += b * b;
    }
    double alike = both / sqrt(first * second);
    double depth = sqrt(second / (double)height_field_count(coarse));
    if (!(depth > 3.0 && alike > 0.9)) {
        fail_msg("changes of %g m, alike by %g", depth, alike);
    }
    height_field_free(coarse);
    height_field_free(fine);
    height_field_free(coarse_before);
    height_field_free(fine_before);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(volume_is_kept_by_any_threads),
        cmocka_unit_test(ground_below_the_angle_is_not_scoured),
        cmocka_unit_test(scree_lies_at_its_angle),
        cmocka_unit_test(couloirs_part_a_wall_into_ribs),
        cmocka_unit_test(more_resolution_shows_the_same_couloirs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
