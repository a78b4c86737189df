// The form karst and the dissolution that makes it: closed forms, volume, grids, shapes.
#include "base/random.h"
#include "land/karst.h"
#include "making_terrain.h"
#include "objects/terrain/karst.h"
#include "testing.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static Landscape *slab(int cells, double height, double *reached)
{
    Error e = {0};
    Landscape *land = landscape_new(cells, 800.0, NULL, &e);
    assert_non_null(land);
    for (int64_t i = 0; i < landscape_count(land); i++) {
        land->rock[i] = height;
        reached[i] = (double)INFINITY;
    }
    return land;
}

static double *times(int cells)
{
    double *reached = calloc((size_t)(cells + 1) * (size_t)(cells + 1), sizeof *reached);
    assert_non_null(reached);
    return reached;
}

static void dissolve(Landscape *land, const KarstRates *rates, double time, double *reached)
{
    Error e = {0};
    Run run = run_default();
    if (!karst_dissolve(land, rates, time, 40, reached, &run, &e)) {
        fail_msg("%s", e.message);
    }
}

// Level rock has no hollows: it sinks at `lowering` times its weakness, and comes to the water
// table when all of it is dissolved.
static void level_rock_sinks_evenly(void **state)
{
    (void)state;
    double *reached = times(64);
    Landscape *land = slab(64, 100.0, reached);
    KarstRates rates = {.lowering = 80.0, .focus = 2.0, .reach = 50.0, .corrosion = 30.0};
    for (int64_t i = 0; i < landscape_count(land); i++) {
        land->weakness[i] = 0.5f;
    }
    dissolve(land, &rates, 1.0, reached);
    for (int64_t i = 0; i < landscape_count(land); i++) {
        assert_true(fabs(land->rock[i] - 60.0) < 1e-6 && reached[i] > 1.0);
        reached[i] = (double)INFINITY;
    }
    dissolve(land, &rates, 2.0, reached); // 60 m at 40 m
    for (int64_t i = 0; i < landscape_count(land); i++) {
        assert_true(land->rock[i] == 0.0 && fabs(reached[i] - 1.5) < 1e-6);
    }
    landscape_free(land);
    free(reached);
}

// The foot of a straight face retreats at the speed of corrosion; from a point the plain widens to
// a disc.
static void the_plain_widens_at_its_speed(void **state)
{
    (void)state;
    for (int cells = 128; cells <= 256; cells *= 2) {
        double *reached = times(cells);
        Landscape *land = slab(cells, 100.0, reached);
        KarstRates rates = {.reach = 50.0, .corrosion = 150.0};
        for (int i = 0; i <= cells; i++) {
            reached[i * (cells + 1)] = 0.0; // the west rim
        }
        dissolve(land, &rates, 2.0, reached);
        int64_t row = (int64_t)(cells / 2) * (cells + 1), wide = 0;
        while (land->rock[row + wide] == 0.0) {
            wide++;
        }
        double foot = ((double)wide - 0.5) * land->cell;
        landscape_free(land);
        land = slab(cells, 100.0, reached);
        reached[row + cells / 2] = 0.0;
        dissolve(land, &rates, 2.0, reached);
        double area = 0.0;
        for (int64_t i = 0; i < landscape_count(land); i++) {
            area += land->rock[i] == 0.0 ? land->cell * land->cell : 0.0;
        }
        double radius = sqrt(area / 3.14159265358979);
        printf("  %d cells: face %g m, disc %g m, by theory 300\n", cells, foot, radius);
        assert_true(fabs(foot - 300.0) <= 0.5 * land->cell + 1e-6);
        assert_true(fabs(radius - 300.0) < (cells == 128 ? 9.0 : 6.0));
        landscape_free(land);
        free(reached);
    }
}

// A hollow deepens faster than its rim, so that it becomes a pit.
static void hollows_deepen(void **state)
{
    (void)state;
    double *reached = times(64);
    Landscape *land = slab(64, 100.0, reached);
    int64_t middle = landscape_count(land) / 2;
    for (int64_t i = 0; i < landscape_count(land); i++) {
        double x = (double)(i % land->side - 32), z = (double)(i / land->side - 32);
        land->rock[i] -= x * x + z * z < 9.0 ? 4.0 : 0.0;
    }
    KarstRates rates = {.lowering = 40.0, .focus = 2.0, .reach = 60.0};
    dissolve(land, &rates, 1.0, reached);
    double pit = land->rock[land->side * 2 + 2] - land->rock[middle];
    printf("  a hollow of 4 m is %g m deep\n", pit);
    assert_true(pit > 8.0);
    landscape_free(land);
    free(reached);
}

// What is dissolved, rounded, worn at the foot and fallen, and what is left, are what there was.
static void no_rock_is_lost(void **state)
{
    (void)state;
    Error e = {0};
    Run run = run_default();
    StrataBed bed = {.thickness = 100.0f, .hardness = 0.9f, .slope = 60.0f};
    StrataParams beds = {.beds = &bed, .bed_count = 1, .top = 100.0f};
    double *reached = times(128), *steepness = times(128);
    Landscape *land = slab(128, 100.0, reached);
    land->strata = strata_new(&beds, vec3(0.0f, 100.0f, 0.0f), 800.0f, &e);
    landscape_lay_stack(land);
    for (int64_t i = 0; i < landscape_count(land); i++) {
        land->weakness[i] = 0.5f + random_unit(random_key(9, (uint64_t)(i / 7)));
        steepness[i] = 1.0;
    }
    double before = landscape_volume(land);
    KarstRates rates = {.lowering = 50.0,
                        .focus = 2.0,
                        .reach = 40.0,
                        .rounding = 5.0,
                        .edge = 15.0,
                        .corrosion = 20.0};
    dissolve(land, &rates, 1.0, reached);
    assert_true(karst_fell(land, steepness, &e) && karst_round(land, 10.0, 3, &run, &e));
    double left = landscape_volume(land) - land->outflow, after = landscape_volume(land);
    printf("  of %g m^3, %g are left, %g lost\n", before, left, before - after);
    assert_true(left > 0.05 * before && left < 0.8 * before);
    assert_true(fabs(after - before) < 1e-6 * before);
    Strata *strata = (Strata *)land->strata;
    landscape_free(land);
    strata_free(strata);
    free(reached);
    free(steepness);
}

// A vertical face of rock that bears 60 degrees falls back to them.
static void faces_fall_to_their_slope(void **state)
{
    (void)state;
    Error e = {0};
    StrataBed bed = {.thickness = 100.0f, .hardness = 0.9f, .slope = 60.0f};
    StrataParams beds = {.beds = &bed, .bed_count = 1, .top = 100.0f};
    Strata *strata = strata_new(&beds, vec3(0.0f, 100.0f, 0.0f), 800.0f, &e);
    double *steepness = times(128);
    Landscape *land = slab(128, 100.0, steepness);
    land->strata = strata;
    landscape_lay_stack(land);
    for (int64_t i = 0; i < landscape_count(land); i++) {
        land->rock[i] = i % land->side < 64 ? 0.0 : 100.0;
        steepness[i] = 1.0;
    }
    assert_true(karst_fell(land, steepness, &e));
    for (int k = 0; k < 20; k++) {
        double theory = fmin(100.0, (k + 1) * land->cell * sqrt(3.0));
        assert_true(fabs(land->rock[64 * land->side + 64 + k] - theory) < 0.01);
    }
    landscape_free(land);
    strata_free(strata);
    free(steepness);
}

// ---- the form

typedef struct Grew {
    TerrainParams params;
    Grown grown;
    HeightField *field;
    MeasureList list;
} Grew;

static void grow(Grew *grew, int resolution, uint64_t seed, float stage, int threads)
{
    *grew = (Grew){.params = terrain_params_default()};
    grew->params.form = TERRAIN_KARST;
    grew->params.size = 4000.0f;
    grew->params.relief = 215.0f;
    grew->params.resolution = resolution;
    grew->params.karst.stage = stage;
    grew->params.karst.spacing = 330.0f;
    grew->params.karst.river = 130.0f;
    grew->field = make_heights(&grew->params, seed, threads, &grew->list, &grew->grown);
}

static void forget(Grew *grew)
{
    height_field_free(grew->field);
    grown_clear(&grew->grown);
    measures_clear(&grew->list);
}

// What several tests look at, grown once: seed 4 at stage 0.8 and two resolutions.
typedef struct Shared {
    Grew coarse, fine; // 256 and 512
} Shared;

static int grow_shared(void **state)
{
    static Shared shared;
    grow(&shared.coarse, 256, 4, 0.8f, 0);
    grow(&shared.fine, 512, 4, 0.8f, 0);
    *state = &shared;
    return 0;
}

static int forget_shared(void **state)
{
    Shared *shared = *state;
    forget(&shared->coarse);
    forget(&shared->fine);
    return 0;
}

static double value(const Grew *grew, const char *name)
{
    return measured(&grew->list, name);
}

// Discs on a lattice of 10 x 10 in a square, those of the first column and row cut by the border:
// Clark and Evans' index is their spacing over Donnelly's expectation, and only whole ones have a
// height and a ratio.
static void the_index_of_a_lattice(void **state)
{
    (void)state;
    Error e = {0};
    double *reached = times(800);
    Landscape *land = slab(800, 0.0, reached); // cells of 1 m
    for (int64_t i = 0; i < landscape_count(land); i++) {
        int64_t column = i % land->side, row = i / land->side;
        double x = (double)((column + 26) % 80 - 40); // m from a disc's middle
        double z = (double)((row + 26) % 80 - 40);
        land->rock[i] = x * x + z * z < 400.0 ? 60.0 : 0.0;
    }
    TerrainParams params = terrain_params_default();
    params.form = TERRAIN_KARST;
    params.size = 800.0f;
    params.relief = 60.0f;
    params.karst.spacing = 80.0f;
    Terrain terrain = {.params = &params, .evolved = land};
    MeasureList list = {0};
    assert_true(terrain_measure_karst(&terrain, &list, &e));
    double random = 0.5 * 800.0 / 10.0 + (0.0514 + 0.041 / 10.0) * 4.0 * 800.0 / 100.0;
    assert_float_equal(measured(&list, "towers"), 81.0, 0.0);
    assert_float_equal(measured(&list, "tower_ratio"), 40.0f / 60.0f, 0.01f);
    // The middles of cut discs lie up to 2 m nearer to the next ones.
    assert_float_equal(measured(&list, "nearest_neighbour_index"), (float)(80.0 / random), 0.015f);
    measures_clear(&list);
    landscape_free(land);
    free(reached);
}

// Guilin: ratios of diameter to height of 0.7 to 1.5 of steep towers, flanks of 60 degrees and
// more, towers at random or more regular: Clark and Evans' index is 1.1 to 1.6.
static void it_measures_as_tower_karst_does(void **state)
{
    const Shared *shared = *state;
    Grew other;
    grow(&other, 512, 5, 0.8f, 0);
    for (int k = 0; k < 2; k++) {
        const Grew *grew = k == 0 ? &shared->fine : &other;
        double ratio = value(grew, "tower_ratio"), slope = value(grew, "flank_slope");
        double index = value(grew, "nearest_neighbour_index");
        printf("  %g towers of %g m, ratio %g, flanks %g degrees, index %g, plain %g\n",
               value(grew, "towers"), value(grew, "tower_height"), ratio, slope, index,
               value(grew, "plain_share"));
        assert_true(value(grew, "towers") >= 20.0);
        assert_true(ratio > 0.7 && ratio < 1.5);
        assert_true(slope > 60.0 && slope < 85.0);
        assert_true(index > 1.1 && index < 1.6);
    }
    forget(&other);
}

// Cones first, then towers, then a plain.
static void the_plain_grows_with_the_stage(void **state)
{
    const Shared *shared = *state;
    double last = -1.0;
    for (int k = 0; k < 4; k++) {
        Grew grew;
        if (k != 2) { // which is shared
            grow(&grew, 256, 4, 0.1f + 0.35f * (float)k, 0);
        }
        double plain = value(k == 2 ? &shared->coarse : &grew, "plain_share");
        printf("  stage %g: plain %g\n", 0.1 + 0.35 * k, plain);
        assert_true(plain > last);
        assert_true(k > 0 || plain < 0.2);
        last = plain;
        if (k != 2) {
            forget(&grew);
        }
    }
    assert_true(last > 0.7);
}

static void the_resolution_keeps_the_towers(void **state)
{
    const Shared *shared = *state;
    const Grew *coarse = &shared->coarse, *fine = &shared->fine;
    double same = 0.0, all = 0.0;
    for (int row = 0; row <= 256; row++) {
        for (int column = 0; column <= 256; column++) {
            bool a = coarse->field->height[row * 257 + column] > 30.0f;
            bool b = fine->field->height[2 * row * 513 + 2 * column] > 30.0f;
            same += a == b;
            all += 1.0;
        }
    }
    double plain = value(coarse, "plain_share") - value(fine, "plain_share");
    printf("  %g of the samples are towers, or plain, in both; the plain differs by %g\n",
           same / all, plain);
    assert_true(same > 0.9 * all);
    assert_true(fabs(plain) < 0.06);
}

static void threads_change_nothing(void **state)
{
    (void)state;
    Grew one, other;
    grow(&one, 128, 4, 0.8f, 1);
    for (int threads = 2; threads <= 3; threads++) {
        grow(&other, 128, 4, 0.8f, threads);
        size_t bytes = sizeof(float) * (size_t)height_field_count(one.field);
        assert_memory_equal(one.field->height, other.field->height, bytes);
        assert_memory_equal(one.field->wetness, other.field->wetness, bytes);
        forget(&other);
    }
    forget(&one);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(level_rock_sinks_evenly),
        cmocka_unit_test(the_plain_widens_at_its_speed),
        cmocka_unit_test(hollows_deepen),
        cmocka_unit_test(no_rock_is_lost),
        cmocka_unit_test(faces_fall_to_their_slope),
        cmocka_unit_test(the_index_of_a_lattice),
        cmocka_unit_test(it_measures_as_tower_karst_does),
        cmocka_unit_test(the_plain_grows_with_the_stage),
        cmocka_unit_test(the_resolution_keeps_the_towers),
        cmocka_unit_test(threads_change_nothing),
    };
    return cmocka_run_group_tests(tests, grow_shared, forget_shared);
}
