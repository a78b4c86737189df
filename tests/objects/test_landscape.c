// Landscape evolution against closed forms, and beds of rock.
#include "base/random.h"
#include "base/strata.h"
#include "land/landscape.h"
#include "testing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static StrataBed section[] = {{40.0f, 0.9f, 76.0f, {0.5f, 0.5f, 0.5f}, 2.0f, 0.0f},
                              {60.0f, 0.1f, 33.0f, {0.4f, 0.2f, 0.1f}, 2.0f, 0.0f},
                              {50.0f, 0.8f, 70.0f, {0.5f, 0.3f, 0.1f}, 2.0f, 0.0f},
                              {30.0f, 0.4f, 45.0f, {0.3f, 0.3f, 0.3f}, 2.0f, 0.0f}};

static Strata *stack(float dip, float azimuth, Vec3 origin)
{
    StrataParams params = {.beds = section, .bed_count = 4, .dip = dip, .dip_azimuth = azimuth};
    Error e = {0};
    Strata *strata = strata_new(&params, origin, 1000.0f, &e);
    assert_non_null(strata);
    return strata;
}

static Landscape *land_of(int cells, double size, const Strata *strata)
{
    Error e = {0};
    Landscape *land = landscape_new(cells, size, strata, &e);
    assert_non_null(land);
    return land;
}

static void step_on(Landscape *land, const LandscapeRates *rates, double time, bool reroute,
                    int threads)
{
    Error e = {0};
    Run run = run_default();
    run.threads = threads;
    if (!landscape_step(land, rates, time, reroute, &run, &e)) {
        fail_msg("%s", e.message);
    }
}

static void step(Landscape *land, const LandscapeRates *rates, double time, int threads)
{
    step_on(land, rates, time, true, threads);
}

// ---- beds

static void bed_at_a_place(void **state)
{
    (void)state;
    // Dips 30 degrees to the east: 100 m east, every bed lies 57.735 m lower.
    Strata *strata = stack(30.0f, 90.0f, vec3(0, 200, 0));
    assert_float_equal(strata_base(strata, 0, 0), 200.0f, 1e-4f);
    assert_float_equal(strata_base(strata, 100, 0), 142.265f, 1e-2f);
    assert_float_equal(strata_base(strata, 0, 300), 200.0f, 1e-2f);
    const float level[] = {5.0f, -39.9f, -40.1f, -99.0f, -101.0f, -149.0f, -151.0f, -900.0f};
    const int bed[] = {0, 0, 1, 1, 2, 2, 3, 3};
    for (int i = 0; i < 8; i++) {
        assert_int_equal(strata_bed(strata, level[i]), bed[i]);
    }
    strata_free(strata);
    // A fault that strikes north drops the east by 70 m; folds of 400 m raise a crest by 12.
    StrataFault fault = {.at = {0.1f, 0.0f}, .drop = 70.0f};
    StrataParams params = {.beds = section,
                           .bed_count = 4,
                           .faults = &fault,
                           .fault_count = 1,
                           .folds = {.wavelength = 400.0f, .amplitude = 12.0f}};
    strata = strata_new(&params, vec3(0, 0, 0), 1000.0f, NULL);
    assert_float_equal(strata_base(strata, 99.0f, 0.0f), 0.0f, 1e-3f);
    assert_float_equal(strata_base(strata, 101.0f, 0.0f), -70.0f, 1e-3f);
    assert_float_equal(strata_base(strata, 0.0f, -100.0f), 12.0f, 1e-3f);
    assert_float_equal(strata_base(strata, 0.0f, -300.0f), -12.0f, 1e-3f);
    strata_free(strata);
}

static void runs_and_levels_are_inverse(void **state)
{
    (void)state;
    Strata *strata = stack(0.0f, 0.0f, vec3(0, 0, 0));
    for (int i = 0; i < 400; i++) {
        double level = 30.0 - (double)i;
        assert_true(fabs(strata_level(strata, strata_run(strata, level)) - level) < 1e-9);
    }
    // 40 m at 76 degrees and 60 m at 33 degrees.
    double run = 40.0 / tan(76.0 * M_PI / 180.0) + 60.0 / tan(33.0 * M_PI / 180.0);
    assert_true(fabs(strata_run(strata, -100.0) + run) < 1e-3);
    strata_free(strata);
}

// ---- slopes

// A plateau beside a line that has been cut deep stands, bed by bed, at the slopes of its beds.
static void faces_stand_at_the_slopes_of_their_beds(void **state)
{
    (void)state;
    enum { CELLS = 64 };
    Strata *strata = stack(0.0f, 0.0f, vec3(0, 150, 0));
    Landscape *land = land_of(CELLS, 320.0, strata);
    for (int64_t i = 0; i < landscape_count(land); i++) {
        land->rock[i] = 150.0;
    }
    for (int row = 0; row < land->side; row++) {
        landscape_set_base(land, (int64_t)row * land->side, 0.0);
    }
    LandscapeRates rates = {.repose = 0.6};
    for (int i = 0; i < 2 * CELLS; i++) {
        step(land, &rates, 1.0, 1);
    }
    for (int column = 0; column < land->side; column++) {
        double run = strata_run(strata, -150.0) + 5.0 * column;
        double wanted = 150.0 + strata_level(strata, run);
        wanted = wanted < 150.0 ? wanted : 150.0;
        int64_t i = (int64_t)(CELLS / 2) * land->side + column;
        assert_true(fabs(land->rock[i] - wanted) < 1e-6);
    }
    landscape_free(land);
    strata_free(strata);
}

// Weathering moves a face of one rock back at its own speed: 0.03 + 0.97 (1 - hardness)^2.
static void faces_retreat_at_their_speed(void **state)
{
    (void)state;
    enum { CELLS = 256, STEPS = 200 };
    StrataBed one = {.thickness = 1000.0f, .hardness = 0.4f, .slope = 60.0f};
    StrataParams params = {.beds = &one, .bed_count = 1};
    Strata *strata = strata_new(&params, vec3(0, 100, 0), 1.0f, NULL);
    Landscape *land = land_of(CELLS, 1024.0, strata);
    double steep = tan(60.0 * M_PI / 180.0);
    for (int64_t i = 0; i < landscape_count(land); i++) {
        double x = 4.0 * (double)(i % land->side);
        land->rock[i] = fmin(100.0, steep * x);
    }
    for (int row = 0; row < land->side; row++) {
        landscape_set_base(land, (int64_t)row * land->side, 0.0);
    }
    LandscapeRates rates = {.repose = 0.6, .retreat = 1000.0};
    for (int i = 0; i < STEPS; i++) {
        step(land, &rates, 1.0 / STEPS, 1);
    }
    double moved = 1000.0 * (0.03 + 0.97 * 0.36); // m, of the face
    int64_t middle = (int64_t)(CELLS / 2) * land->side;
    double face = 0.0; // x at half the height
    for (int column = 0; column < land->side; column++) {
        face = land->rock[middle + column] < 50.0 ? 4.0 * column : face;
    }
    double wanted = moved + 50.0 / steep;
    assert_in_range((int)face, (int)(wanted - 20.0), (int)(wanted + 20.0));
    landscape_free(land);
    strata_free(strata);
}

static void rubble_rests_at_its_angle(void **state)
{
    (void)state;
    enum { CELLS = 64 };
    Landscape *land = land_of(CELLS, 64.0, NULL);
    int64_t middle = landscape_count(land) / 2;
    land->loose[middle] = 3000.0;
    double volume = landscape_volume(land), repose = tan(34.0 * M_PI / 180.0);
    LandscapeRates rates = {.repose = repose};
    // Without a base there is no water: only slopes act.
    land->base[0] = 1;
    for (int i = 0; i < 3000; i++) {
        step(land, &rates, 1.0, 1);
    }
    double steepest = 0.0, highest = 0.0;
    for (int row = 1; row < CELLS; row++) {
        for (int column = 1; column < CELLS; column++) {
            int64_t i = (int64_t)row * land->side + column;
            double dx = 0.5 * (land->loose[i + 1] - land->loose[i - 1]);
            double dz = 0.5 * (land->loose[i + land->side] - land->loose[i - land->side]);
            steepest = fmax(steepest, sqrt(dx * dx + dz * dz));
            highest = fmax(highest, land->loose[i]);
        }
    }
    assert_true(steepest < 1.09 * repose); // an octagon's corners
    // A cone of this volume and slope: h = (3 V tan^2 / pi)^(1/3).
    double cone = cbrt(3.0 * 3000.0 * repose * repose / M_PI);
    assert_true(fabs(highest - cone) < 0.06 * cone);
    assert_true(fabs(landscape_volume(land) - volume) < 1e-9 * volume);
    landscape_free(land);
}

// ---- streams

static void rim_is_base(Landscape *land)
{
    for (int64_t i = 0; i < landscape_count(land); i++) {
        int64_t row = i / land->side, column = i % land->side;
        if (row == 0 || column == 0 || row == land->side - 1 || column == land->side - 1) {
            landscape_set_base(land, i, 0.0);
        }
    }
}

// Steady state: what streams cut is what rises and what they drop: K sqrt(A) S = U + G U (A - a) /
// A with a the sample's own area (Yuan et al. 2019; G = 0: Flint's law).
static void steady_streams_keep_the_slope_area_law(double deposition)
{
    enum { CELLS = 48 };
    const double cell = 100.0, uplift = 1e-3, k = 2e-4;
    Landscape *land = land_of(CELLS, CELLS * cell, NULL);
    for (int64_t i = 0; i < landscape_count(land); i++) {
        land->rock[i] = 1.0 + (double)random_unit(random_key(5, (uint64_t)i));
    }
    rim_is_base(land);
    LandscapeRates rates = {.uplift = uplift,
                            .incision = k,
                            .loose = k * landscape_erodibility(0.5),
                            .deposition = deposition,
                            .repose = 100.0};
    // At last the ways of the water stay, as some would go on switching between two equal ones.
    for (int i = 0; i < 6000; i++) {
        step_on(land, &rates, 2e3, i < 4000, 1);
    }
    // The load that reaches a sample is the uplift of the area above it; the slope to one of its
    // neighbours must be that of the law.
    int64_t kept = 0, all = 0;
    for (int64_t i = 0; i < landscape_count(land); i++) {
        if (land->base[i]) {
            continue;
        }
        double above = land->load[i] / (uplift * 2e3), own = cell * cell, area = above + own;
        double wanted = uplift * (1.0 + deposition * above / area) /
                        (k * landscape_erodibility(0.5) * sqrt(area));
        bool found = false;
        for (int n = 0; n < 9 && !found; n++) {
            int64_t to = i + (n % 3 - 1) + (int64_t)(n / 3 - 1) * land->side;
            double length = cell * (n % 2 == 0 ? sqrt(2.0) : 1.0);
            double slope =
                (land->rock[i] + land->loose[i] - land->rock[to] - land->loose[to]) / length;
            found = n != 4 && fabs(slope - wanted) < 1e-4 * wanted;
        }
        kept += found;
        all++;
    }
    if (kept != all) {
        fail_msg("%d of %d samples keep the law at G = %g", (int)kept, (int)all, deposition);
    }
    landscape_free(land);
}

static void slope_area_law(void **state)
{
    (void)state;
    steady_streams_keep_the_slope_area_law(0.0);
    steady_streams_keep_the_slope_area_law(0.7);
}

// ---- all together

static const LandscapeRates EVERYTHING = {.incision = 6.0,
                                          .uplift = 20.0,
                                          .loose = 20.0,
                                          .least_area = 400.0,
                                          .deposition = 1.0,
                                          .retreat = 200.0,
                                          .rubble = 0.4,
                                          .repose = 0.65,
                                          .wash = 2.0,
                                          .soil = 3.0,
                                          .creep = 200.0,
                                          .seed = 9};

static Landscape *worn_land(const Strata *strata, int threads, double *volume)
{
    Landscape *land = land_of(96, 960.0, strata);
    for (int64_t i = 0; i < landscape_count(land); i++) {
        land->rock[i] = 150.0 + 3.0 * (double)random_unit(random_key(3, (uint64_t)i));
        land->weakness[i] = 0.5f + random_unit(random_key(4, (uint64_t)i));
    }
    *volume = landscape_volume(land);
    for (int i = 0; i < 60; i++) {
        memset(land->base, 0, (size_t)landscape_count(land));
        for (int row = 0; row < land->side; row++) { // a river that cuts down and wanders
            int64_t at = (int64_t)row * land->side + 40 + i / 10;
            landscape_set_base(land, at, 150.0 - 2.4 * i);
        }
        step(land, &EVERYTHING, 1.0 / 60, threads);
    }
    return land;
}

static void volume_is_conserved_and_threads_do_not_matter(void **state)
{
    (void)state;
    Strata *strata = stack(4.0f, 60.0f, vec3(0, 150, 0));
    double volume, again;
    Landscape *one = worn_land(strata, 1, &volume), *three = worn_land(strata, 3, &again);
    size_t bytes = sizeof(double) * (size_t)landscape_count(one);
    assert_memory_equal(one->rock, three->rock, bytes);
    assert_memory_equal(one->loose, three->loose, bytes);
    assert_true(one->outflow == three->outflow);
    double sediment = 0.0;
    for (int64_t i = 0; i < landscape_count(one); i++) {
        assert_true(one->loose[i] >= 0.0);
        sediment += one->loose[i] * one->cell * one->cell;
    }
    assert_true(one->outflow > 0.02 * volume && sediment > 1e-3 * volume);
    assert_true(fabs(landscape_volume(one) - volume) < 1e-6 * sediment);
    // A finer grid holds the same land.
    Run run = run_default();
    Landscape *finer = landscape_refined(one, &run, NULL);
    for (int row = 0; row < one->side; row++) {
        for (int column = 0; column < one->side; column++) {
            int64_t i = (int64_t)row * one->side + column;
            int64_t j = 2 * (int64_t)row * finer->side + 2 * column;
            assert_true(fabs(one->rock[i] - finer->rock[j]) < 1e-3);
        }
    }
    landscape_free(finer);
    landscape_free(one);
    landscape_free(three);
    strata_free(strata);
}

// Fallen rock against the lowest of the cones that stand on all samples.
static void steep_rock_falls(void **state)
{
    (void)state;
    enum { CELLS = 24 };
    const double slope = 1.4;
    Landscape *land = landscape_new(CELLS, 48.0, NULL, NULL);
    int side = land->side;
    double *before = malloc(sizeof *before * (size_t)landscape_count(land));
    for (int64_t i = 0; i < landscape_count(land); i++) {
        land->rock[i] = 20.0 * (double)random_unit(random_key(7, (uint64_t)i));
        land->loose[i] = i % 3 == 0 ? 0.5 : 0.0;
        before[i] = land->rock[i] + land->loose[i];
    }
    double volume = landscape_volume(land);
    landscape_fell(land, slope);
    for (int i = 0; i < side * side; i++) {
        double most = before[i];
        for (int j = 0; j < side * side; j++) {
            int across = abs(i % side - j % side), down = abs(i / side - j / side);
            int diagonal = across < down ? across : down;
            double away = across + down - 2 * diagonal + sqrt(2.0) * diagonal;
            most = fmin(most, before[j] + slope * land->cell * away);
        }
        assert_true(fabs(land->rock[i] + land->loose[i] - most) < 1e-9);
        assert_true(land->loose[i] >= 0.0);
    }
    assert_true(fabs(landscape_volume(land) - volume) < 1e-9 * volume);
    free(before);
    landscape_free(land);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bed_at_a_place),
        cmocka_unit_test(runs_and_levels_are_inverse),
        cmocka_unit_test(faces_stand_at_the_slopes_of_their_beds),
        cmocka_unit_test(faces_retreat_at_their_speed),
        cmocka_unit_test(rubble_rests_at_its_angle),
        cmocka_unit_test(slope_area_law),
        cmocka_unit_test(steep_rock_falls),
        cmocka_unit_test(volume_is_conserved_and_threads_do_not_matter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
