// The form badlands: gullies and rills, walls, washes; and the processes that make them.
#include "land/height_drainage.h"
#include "land/height_measure.h"
#include "making_terrain.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// ---- processes

static Landscape *land_of(int cells, double size)
{
    Error e = {0};
    Landscape *land = landscape_new(cells, size, NULL, &e);
    assert_non_null(land);
    return land;
}

// A plateau with one hole becomes a cone, as steep along the grid as across it. Nothing rises, and
// what falls has left.
static void walls_around_a_hole_are_a_cone(void **state)
{
    (void)state;
    const double slope = 0.8, high = 30.0;
    Error e = {0};
    Landscape *land = land_of(64, 64.0);
    int64_t middle = (int64_t)32 * land->side + 32;
    for (int64_t i = 0; i < landscape_count(land); i++) {
        land->rock[i] = high;
    }
    double before = landscape_volume(land), worst = 0.0;
    landscape_set_base(land, middle, 0.0);
    assert_true(landscape_limit_slopes(land, slope, &e));
    for (int64_t i = 0; i < landscape_count(land); i++) {
        double x = (double)(i % land->side) - 32.0, z = (double)(i / land->side) - 32.0;
        double away = sqrt(x * x + z * z), cone = fmin(high, slope * away);
        assert_true(land->rock[i] <= high);
        if (away > 10.0) {
            worst = fmax(worst, fabs(land->rock[i] - cone) / cone);
        }
    }
    printf("  largest error %g\n", worst);
    assert_true(worst < 0.08); // of first order: most near the hole, on the diagonals
    assert_true(fabs(landscape_volume(land) - before) < 1e-9 * before);
    landscape_free(land);
}

// Where no wall is too steep nothing falls.
static void gentle_slopes_stay(void **state)
{
    (void)state;
    Error e = {0};
    Landscape *land = land_of(16, 16.0);
    for (int64_t i = 0; i < landscape_count(land); i++) {
        land->rock[i] = 0.5 * (double)(i % land->side);
    }
    assert_true(landscape_limit_slopes(land, 0.6, &e));
    for (int64_t i = 0; i < landscape_count(land); i++) {
        assert_true(land->rock[i] == 0.5 * (double)(i % land->side));
    }
    landscape_free(land);
}

// A wave of creeping ground decays by exp(-D t k^2).
static void creep_flattens_waves(void **state)
{
    (void)state;
    const double diffusion = 20.0;
    Error e = {0};
    Run run = run_default();
    Landscape *land = land_of(63, 63.0);
    double k = 3.141592653589793 * 2.0 / 64.0; // per sample; mirrored half a sample beyond the rim
    for (int64_t i = 0; i < landscape_count(land); i++) {
        land->rock[i] = 10.0 + cos(k * ((double)(i % land->side) + 0.5));
    }
    double before = landscape_volume(land), decay = exp(-diffusion * k * k);
    assert_true(landscape_round(land, diffusion, &run, &e));
    for (int64_t i = 0; i < landscape_count(land); i++) {
        double wave = decay * cos(k * ((double)(i % land->side) + 0.5));
        assert_true(fabs(land->rock[i] - 10.0 - wave) < 2e-3);
    }
    assert_true(fabs(landscape_volume(land) - before) < 1e-9 * before);
    landscape_free(land);
}

// A gorge that falls less than its wash would is filled until it falls as much; its walls stay.
static void a_wash_fills_the_gorge(void **state)
{
    (void)state;
    const LandscapeWash wash = {.slope = 0.04, .least_area = 200.0, .across = 0.01, .seed = 3};
    Error e = {0};
    Run run = run_default();
    Landscape *land = land_of(64, 64.0);
    for (int64_t i = 0; i < landscape_count(land); i++) {
        double column = (double)(i % land->side), row = (double)(i / land->side);
        land->rock[i] = fabs(column - 32.0) + 0.001 * (64.0 - row);
    }
    landscape_set_base(land, (int64_t)64 * land->side + 32, 0.0);
    double before = landscape_volume(land), level = 0.0;
    assert_true(landscape_lay_wash(land, &wash, &run, &e));
    for (int row = 63; row > 8; row--) {
        // Each row of 65 m^2 drains to the middle.
        double area = 65.0 * (row + 1.0), least = wash.slope * pow(1e4 / area, 0.25);
        int64_t i = (int64_t)row * land->side + 32;
        double height = land->rock[i] + land->loose[i];
        assert_true(height - level > 0.7 * least && height - level < 1.3 * least);
        level = height;
        assert_true(land->loose[i] > 0.0 && land->loose[i + 20] == 0.0);
    }
    assert_true(fabs(landscape_volume(land) - before) < 1e-9 * before);
    HeightField *field = landscape_heights(land, &e);
    assert_int_equal(height_field_pits(field), 0);
    height_field_free(field);
    landscape_free(land);
}

// ---- the form

typedef struct Made {
    Grown grown;
    HeightField *field;
    MeasureList list;
} Made;

static TerrainParams small(void)
{
    TerrainParams params = terrain_params_default();
    params.form = TERRAIN_BADLANDS;
    params.size = 150.0f;
    params.relief = 18.0f;
    params.resolution = 256;
    return params;
}

static Made make(const TerrainParams *params, int threads)
{
    Made made = {.field = NULL};
    made.field = make_heights(params, 5, threads, &made.list, &made.grown);
    return made;
}

static void clear(Made *made)
{
    measures_clear(&made->list);
    height_field_free(made->field);
    grown_clear(&made->grown);
}

static void land_is_cut_as_badlands_are(void **state)
{
    (void)state;
    TerrainParams params = small();
    Made made = make(&params, 0);
    Error e = {0};
    float low, high;
    height_field_range(made.field, &low, &high);
    double density = measured(&made.list, "drainage_density");
    double slope = measured(&made.list, "wall_slope"), wash = measured(&made.list, "wash_share");
    printf("  relief %g m, %g km/km2, walls %g degrees, wash %g\n", (double)(high - low), density,
           slope, wash);
    assert_true(fabsf(high - low - 18.0f) < 0.2f * 18.0f);
    // Of clay badlands 100 to 700 (Schumm 1956, Smith 1958).
    assert_true(density > 80.0 && density < 700.0);
    assert_true(slope > 30.0 && slope < 45.0);
    assert_true(wash > 0.01 && wash < 0.4);
    assert_int_equal(height_field_pits(made.field), 0);
    MeasureList list = {0};
    assert_true(height_field_measure(made.field, 0.0, &list, &e));
    double integral = measured(&list, "hypsometric_integral");
    printf("  hypsometric integral %g\n", integral);
    assert_true(integral > 0.35 && integral < 0.6);
    measures_clear(&list);
    clear(&made);
}

static double slope_at(const HeightField *field, int row, int column)
{
    const float *h = field->height + (int64_t)row * field->columns + column;
    double x = (double)(h[1] - h[-1]), z = (double)(h[field->columns] - h[-field->columns]);
    return 0.5 * sqrt(x * x + z * z) / (double)field->cell.x;
}

// m: by how much places of steep walls that drain between two areas, m^2, lie lower in `cut` than
// in `even`.
static double deeper(const Made *even, const Made *cut, double least, double most)
{
    Error e = {0};
    double sum = 0.0, count = 0.0;
    Drainage *drainage = drainage_new(cut->field, &e);
    assert_non_null(drainage);
    for (int row = 1; row < cut->field->rows - 1; row++) {
        for (int column = 1; column < cut->field->columns - 1; column++) {
            int64_t i = (int64_t)row * cut->field->columns + column;
            double area = drainage->area[i];
            if (area >= least && area <= most && slope_at(even->field, row, column) > 0.8) {
                sum += (double)(even->field->height[i] - cut->field->height[i]);
                count += 1.0;
            }
        }
    }
    drainage_free(drainage);
    assert_true(count > 100.0);
    return sum / count;
}

// Storms cut in proportion to the root of the catchment: rills, and hardly the edges between.
static void storms_cut_rills(void **state)
{
    (void)state;
    const double depth = 1.0;
    TerrainParams params = small();
    params.badlands.wash = 0.0f;
    params.badlands.depth = 0.0f;
    Made even = make(&params, 0);
    params.badlands.depth = (float)depth;
    Made cut = make(&params, 0);
    double rill = deeper(&even, &cut, 15.0, 25.0), edge = deeper(&even, &cut, 0.0, 0.5);
    double wanted = depth * sqrt(20.0 / 50.0);
    printf("  rills %g m deeper, %g wanted; edges %g m\n", rill, wanted, edge);
    assert_true(rill > 0.4 * wanted && rill < 1.3 * wanted);
    assert_true(edge < 0.4 * rill);
    assert_true(measured(&even.list, "wash_share") == 0.0);
    clear(&even);
    clear(&cut);
}

// m: mean height of a square about a place, in shares of the size, a tenth of the size wide.
static double height_about(const HeightField *field, double u, double v)
{
    int half = field->columns / 20, count = 0;
    int column = (int)((u + 0.5) * field->columns), row = (int)((v + 0.5) * field->rows);
    double sum = 0.0;
    for (int r = row - half; r <= row + half; r++) {
        for (int c = column - half; c <= column + half; c++, count++) {
            sum += (double)field->height[(int64_t)r * field->columns + c];
        }
    }
    return sum / count;
}

// Where a stroke raises the land a butte stands, where one lowers it a wash is wide.
static void strokes_make_buttes_and_washes(void **state)
{
    (void)state;
    TerrainParams params = small();
    UpliftStroke strokes[] = {
        {.from = {0.2f, -0.2f}, .to = {0.2f, -0.2f}, .radius = 0.2f, .strength = 4.0f},
        {.from = {-0.3f, 0.2f}, .to = {0.3f, 0.2f}, .radius = 0.15f, .strength = -0.85f}};
    params.resolution = 128;
    Made even = make(&params, 0);
    params.uplift.strokes = strokes;
    params.uplift.stroke_count = 2;
    Made raised = make(&params, 0);
    double butte = height_about(raised.field, 0.2, -0.2) / height_about(even.field, 0.2, -0.2);
    double wash = height_about(raised.field, 0.0, 0.2) / height_about(even.field, 0.0, 0.2);
    double before = measured(&even.list, "wash_share"),
           after = measured(&raised.list, "wash_share");
    printf("  heights: butte x %.2f, wash x %.2f; washes %.2f, before %.2f\n", butte, wash, after,
           before);
    assert_true(butte > 1.25 && wash < 0.75 && after > before);
    assert_int_equal(height_field_pits(raised.field), 0);
    clear(&even);
    clear(&raised);
}

static void threads_change_nothing(void **state)
{
    (void)state;
    TerrainParams params = small();
    params.resolution = 128;
    Made one = make(&params, 1), three = make(&params, 3);
    size_t bytes = sizeof(float) * (size_t)height_field_count(one.field);
    assert_memory_equal(one.field->height, three.field->height, bytes);
    assert_memory_equal(one.field->wetness, three.field->wetness, bytes);
    clear(&one);
    clear(&three);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(walls_around_a_hole_are_a_cone), cmocka_unit_test(gentle_slopes_stay),
        cmocka_unit_test(creep_flattens_waves),           cmocka_unit_test(a_wash_fills_the_gorge),
        cmocka_unit_test(land_is_cut_as_badlands_are),    cmocka_unit_test(storms_cut_rills),
        cmocka_unit_test(strokes_make_buttes_and_washes), cmocka_unit_test(threads_change_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
