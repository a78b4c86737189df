// Glaciers: flow, volume, threads; and the form alps on several seeds.
#include "land/glacier.h"
#include "land/height_drainage.h"
#include "land/valley_profile.h"
#include "making_terrain.h"
#include "objects/terrain/terrain.h"
#include "testing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CELLS = 64 };
static const double CELL = 60.0;

// A valley of V section that falls to a base at its end; sides of 30 degrees.
static Landscape *valley(void)
{
    Landscape *land = landscape_new(CELLS, CELLS * CELL, NULL, NULL);
    assert_non_null(land);
    for (int64_t i = 0; i < landscape_count(land); i++) {
        double away = fabs((double)(i % land->side) - CELLS / 2) * CELL;
        double up = (double)(i / land->side) * CELL;
        land->rock[i] = 0.577 * away + 0.08 * up;
    }
    for (int column = 0; column < land->side; column++) {
        landscape_set_base(land, column, land->rock[column]);
    }
    return land;
}

static const GlacierParams ICE = {
    .line = 450.0, .gradient = 0.006, .most = 1.2, .steepest = 1.2, .erosion = 1e-4, .till = 0.25};

static void glaciate(Landscape *land, Glacier *glacier, int steps, int threads)
{
    Error e = {0};
    Run run = run_default();
    run.threads = threads;
    LandscapeRates frost = {.retreat = 2.0, .rubble = 0.5, .repose = 0.65};
    for (int i = 0; i < steps; i++) {
        if (!glacier_flow(glacier, land, &ICE, i == 0 ? 400.0 : 40.0, &run, &e) ||
            !glacier_wear(glacier, land, &ICE, 300.0, &e) ||
            !landscape_slopes_only(land, &frost, 1.0, &run, &e)) {
            fail_msg("%s", e.message);
        }
    }
}

static void ice_deepens_its_valley_and_keeps_volume(void **state)
{
    (void)state;
    Landscape *land = valley(), *same = valley();
    Glacier *glacier = glacier_new(land, NULL), *again = glacier_new(same, NULL);
    double volume = landscape_volume(land);
    glaciate(land, glacier, 60, 1);
    glaciate(same, again, 60, 3);
    double deepest = 0.0, worn = 0.0;
    for (int64_t i = 0; i < landscape_count(land); i++) {
        double away = fabs((double)(i % land->side) - CELLS / 2) * CELL;
        double cut = 0.577 * away + 0.08 * (double)(i / land->side) * CELL - land->rock[i];
        deepest = fmax(deepest, cut);
        worn += fabs(cut) * CELL * CELL;
        assert_true(land->loose[i] >= 0.0 && glacier->ice[i] >= 0.0);
    }
    if (!(deepest > 30.0)) {
        fail_msg("%g m worn", deepest);
    }
    assert_true(fabs(landscape_volume(land) - volume) < 1e-6 * worn);
    size_t bytes = sizeof(double) * (size_t)landscape_count(land);
    assert_memory_equal(land->rock, same->rock, bytes);
    assert_memory_equal(glacier->ice, again->ice, bytes);
    glacier_free(glacier);
    glacier_free(again);
    landscape_free(land);
    landscape_free(same);
}

// Ice on a plane of slope S that gains b: in steady state the flux is b x, hence
// b x = (FLOW H^2 + SLIDE) H^3 S^3 with the constants of the source.
static void steady_ice_carries_what_it_gains(void **state)
{
    (void)state;
    Landscape *land = landscape_new(CELLS, CELLS * 200.0, NULL, NULL);
    for (int64_t i = 0; i < landscape_count(land); i++) {
        land->rock[i] = 4000.0 - 0.1 * 200.0 * (double)(i % land->side);
    }
    for (int row = 0; row < land->side; row++) {
        int64_t i = (int64_t)row * land->side + CELLS;
        landscape_set_base(land, i, land->rock[i]);
    }
    // Everywhere above the line: the gain is `most` on ground that holds all snow.
    GlacierParams params = {.line = 0.0, .gradient = 1.0, .most = 0.5, .steepest = 100.0};
    Glacier *glacier = glacier_new(land, NULL);
    Run run = run_default();
    assert_true(glacier_flow(glacier, land, &params, 3000.0, &run, NULL));
    for (int column = 16; column < 48; column += 8) {
        int64_t i = (int64_t)(CELLS / 2) * land->side + column;
        double ice = glacier->ice[i];
        double slope =
            (land->rock[i - 1] + glacier->ice[i - 1] - land->rock[i + 1] - glacier->ice[i + 1]) /
            400.0;
        double flux = (2.2e-5 * ice * ice + 1.5) * ice * ice * ice * slope * slope * slope;
        double wanted = 0.5 * 200.0 * (column + 0.5);
        if (fabs(flux - wanted) > 0.12 * wanted) {
            fail_msg("column %d carries %g m^2/a, gains %g", column, flux, wanted);
        }
    }
    glacier_free(glacier);
    landscape_free(land);
}

static TerrainParams alps(float age, float ice)
{
    TerrainParams params = terrain_params_default();
    params.form = TERRAIN_ALPS;
    params.size = 16000.0f;
    params.relief = 2500.0f;
    params.resolution = 256;
    params.alps.age = age;
    params.alps.ice = ice;
    return params;
}

static HeightField *heights(uint64_t seed, int threads, float age, float ice, MeasureList *list)
{
    TerrainParams params = alps(age, ice);
    return make_heights(&params, seed, threads, list, NULL);
}

typedef struct Alps {
    HeightField *field;
    MeasureList list;
} Alps;

// Alps of seed 1 that one thread has grown, once for several tests.
typedef struct Shared {
    Alps young, old; // of ages 0 and 1: the old ones have gone through what wears alps down, too
} Shared;

static int grow_shared(void **state)
{
    Shared *shared = calloc(1, sizeof *shared);
    assert_non_null(shared);
    shared->young.field = heights(1, 1, 0.0f, 1.0f, &shared->young.list);
    shared->old.field = heights(1, 1, 1.0f, 1.0f, &shared->old.list);
    *state = shared;
    return 0;
}

static int free_shared(void **state)
{
    Shared *shared = *state;
    height_field_free(shared->young.field);
    height_field_free(shared->old.field);
    measures_clear(&shared->young.list);
    measures_clear(&shared->old.list);
    free(shared);
    return 0;
}

static void expect_promises(uint64_t seed, const HeightField *field, const MeasureList *list)
{
    float low, high;
    height_field_range(field, &low, &high);
    assert_true(high - low > 0.75f * 2500.0f && high - low < 1.25f * 2500.0f);
    double sum = 0.0;
    for (int64_t i = 0; i < height_field_count(field); i++) {
        sum += (double)(field->height[i] - low);
        assert_true(isfinite(field->climate[i]));
    }
    double integral = sum / (double)height_field_count(field) / (double)(high - low);
    if (!(integral > 0.25 && integral < 0.6)) {
        fail_msg("seed %d: hypsometric integral %g", (int)seed, integral);
    }
    double exponent = measured(list, "valley_exponent");
    if (!(exponent > 1.6 && exponent < 2.4)) { // Svensson 1959: 1.5 to 2.5 in nature
        fail_msg("seed %d: valleys have an exponent of %g", (int)seed, exponent);
    }
}

static void alps_keep_their_promises(void **state)
{
    const Shared *shared = *state;
    const Alps *young = &shared->young;
    MeasureList other = {0};
    expect_promises(1, young->field, &young->list);
    HeightField *field = heights(2, 1, 0.0f, 1.0f, &other);
    expect_promises(2, field, &other);
    assert_true(measured(&shared->old.list, "cliff_share") <
                0.5 * measured(&young->list, "cliff_share"));
    height_field_free(field);
    measures_clear(&other);
}

static void without_ice_valleys_are_v_shaped(void **state)
{
    (void)state;
    MeasureList list = {0};
    TerrainParams params = alps(0.0f, 0.0f);
    params.evolution.debris = 0.0f; // which fills their floors a little
    height_field_free(make_heights(&params, 1, 1, &list, NULL));
    double exponent = measured(&list, "valley_exponent");
    if (!(exponent > 0.9 && exponent < 1.4)) {
        fail_msg("valleys have an exponent of %g", exponent);
    }
    measures_clear(&list);
}

// The exponent of troughs h = |x|^b that fall along z.
static void the_exponent_of_troughs_is_found(void **state)
{
    (void)state;
    enum { SIDE = 129 };
    for (int k = 0; k < 3; k++) {
        double b = 1.0 + 0.5 * k, found = 0.0;
        HeightField *field = height_field_new(SIDE, SIDE, (Vec2){10, 10}, (Vec2){-640, -640}, NULL);
        for (int64_t i = 0; i < height_field_count(field); i++) {
            double away = fabs((double)(i % SIDE) - SIDE / 2);
            field->height[i] =
                (float)(pow(away, b) * 500.0 / pow(64.0, b) + 0.2 * (double)(i / SIDE));
        }
        Drainage *drainage = drainage_new(field, NULL);
        assert_true(valley_profile_exponent(field, drainage, 3e5, &found, NULL));
        if (!(fabs(found - b) < 0.05)) {
            fail_msg("%g instead of %g", found, b);
        }
        drainage_free(drainage);
        height_field_free(field);
    }
}

static void the_same_bits_for_any_threads(void **state)
{
    const HeightField *one = ((const Shared *)*state)->old.field;
    HeightField *three = heights(1, 3, 1.0f, 1.0f, NULL);
    assert_true(height_field_hash(one) == height_field_hash(three));
    assert_memory_equal(one->climate, three->climate,
                        sizeof(float) * (size_t)height_field_count(three));
    height_field_free(three);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ice_deepens_its_valley_and_keeps_volume),
        cmocka_unit_test(steady_ice_carries_what_it_gains),
        cmocka_unit_test(alps_keep_their_promises),
        cmocka_unit_test(the_exponent_of_troughs_is_found),
        cmocka_unit_test(without_ice_valleys_are_v_shaped),
        cmocka_unit_test(the_same_bits_for_any_threads),
    };
    return cmocka_run_group_tests(tests, grow_shared, free_shared);
}
