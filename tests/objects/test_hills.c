// The form hills: spacing of valleys, balance of creep and streams, soil, threads, volume.
#include "land/height_drainage.h"
#include "making_terrain.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct Made {
    Grown grown;
    HeightField *field;
    MeasureList list;
    const Landscape *land; // of the grown
} Made;

static Made make_rilled(float spacing, int resolution, uint64_t seed, int threads, float rills)
{
    TerrainParams params = terrain_params_default();
    params.form = TERRAIN_HILLS;
    params.size = 3000.0f;
    params.relief = 150.0f;
    params.resolution = resolution;
    params.hills.spacing = spacing;
    params.hills.rills = rills;
    Made made = {.field = NULL};
    made.field = make_heights(&params, seed, threads, &made.list, &made.grown);
    made.land = ((const Terrain *)made.grown.state)->evolved;
    return made;
}

static Made make(float spacing, int resolution, uint64_t seed, int threads)
{
    return make_rilled(spacing, resolution, seed, threads, 0.0f);
}

static void clear(Made *made)
{
    measures_clear(&made->list);
    height_field_free(made->field);
    grown_clear(&made->grown);
}

// Grown once for two tests.
static int make_shared(void **state)
{
    static Made shared;
    shared = make(300.0f, 256, 5, 0);
    *state = &shared;
    return 0;
}

static int clear_shared(void **state)
{
    clear(*state);
    return 0;
}

static double value(const Made *made, const char *name)
{
    const Measure *measure = measures_find(&made->list, name);
    assert_non_null(measure);
    return measure->value;
}

static void valleys_are_as_far_apart_as_asked(void **state)
{
    (void)state;
    static const float spacing[] = {200.0f, 350.0f};
    for (int k = 0; k < 2; k++) {
        Made made = make(spacing[k], 256, (uint64_t)(3 + k), 0);
        double is = value(&made, "valley_spacing");
        printf("  asked %g, is %g m\n", (double)spacing[k], is);
        if (fabs(is - (double)spacing[k]) > 0.3 * (double)spacing[k]) {
            fail_msg("valleys are %g m apart, not %g", is, (double)spacing[k]);
        }
        clear(&made);
    }
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double surface(const Landscape *land, int64_t i)
{
    return land->rock[i] + land->loose[i];
}

static bool is_top(const Landscape *land, int64_t i)
{
    for (int row = -2; row <= 2; row++) {
        for (int column = -2; column <= 2; column++) {
            if (surface(land, i + (int64_t)row * land->side + column) > surface(land, i)) {
                return false;
            }
        }
    }
    return true;
}

// In steady state all tops lower at the rate of the uplift, D times their curvature, so they bend
// alike, high or low (Roering et al. 2007).
static void all_tops_bend_alike(void **state)
{
    const Made *made = *state;
    const Landscape *land = made->land;
    double bend[4096];
    int count = 0;
    for (int row = 2; row < land->side - 2; row++) {
        for (int column = 2; column < land->side - 2 && count < 4096; column++) {
            int64_t i = (int64_t)row * land->side + column, next = land->side;
            if (is_top(land, i)) {
                double around = surface(land, i - 1) + surface(land, i + 1) +
                                surface(land, i - next) + surface(land, i + next);
                bend[count++] = (around - 4.0 * surface(land, i)) / (land->cell * land->cell);
            }
        }
    }
    assert_true(count > 20);
    qsort(bend, (size_t)count, sizeof *bend, by_value);
    double median = bend[count / 2];
    printf("  curvature of %d tops: %g, %g, %g /m\n", count, bend[count / 10], median,
           bend[count - 1 - count / 10]);
    assert_true(bend[count / 10] > 1.15 * median && bend[count - 1 - count / 10] < 0.85 * median);
    assert_true(fabs(median - value(made, "hilltop_curvature")) < 1e-9 * fabs(median));
}

static void land_is_as_high_as_asked_and_under_soil(void **state)
{
    const Made *made = *state;
    float low, high;
    height_field_range(made->field, &low, &high);
    assert_true(fabsf(high - low - 150.0f) < 3.0f);
    int64_t bare = 0, count = landscape_count(made->land);
    for (int64_t i = 0; i < count; i++) {
        bare += made->land->loose[i] < 0.02;
    }
    printf("  bare rock: %g of the land\n", (double)bare / (double)count);
    assert_true((double)bare < 0.05 * (double)count);
    assert_int_equal(height_field_pits(made->field), 0);
}

// The resolution changes the detail, not the form.
static void the_resolution_keeps_the_hills(void **state)
{
    const Made *coarse = *state;
    Made fine = make(300.0f, 512, 5, 0);
    double sum = 0.0, change = 0.0;
    for (int row = 0; row <= 256; row += 4) {
        for (int column = 0; column <= 256; column += 4) {
            float a = coarse->field->height[row * 257 + column];
            float b = fine.field->height[(2 * row) * 513 + 2 * column];
            change += (double)((a - b) * (a - b));
            sum += 1.0;
        }
    }
    change = sqrt(change / sum);
    printf("  spacing %g and %g m, change %g m\n", value(coarse, "valley_spacing"),
           value(&fine, "valley_spacing"), change);
    assert_true(change < 0.01 * 150.0);
    clear(&fine);
}

// Mean over the land of what its samples differ from the mean of their neighbours, m.
static double roughness(const HeightField *field)
{
    double sum = 0.0, count = 0.0;
    for (int row = 1; row < field->rows - 1; row++) {
        for (int column = 1; column < field->columns - 1; column++) {
            const float *h = field->height + (int64_t)row * field->columns + column;
            float mean = 0.25f * (h[1] + h[-1] + h[field->columns] + h[-field->columns]);
            sum += (double)fabsf(h[0] - mean);
            count += 1.0;
        }
    }
    return sum / count;
}

static double mean_height(const HeightField *field)
{
    double sum = 0.0;
    for (int64_t i = 0; i < height_field_count(field); i++) {
        sum += (double)field->height[i];
    }
    return sum / (double)height_field_count(field);
}

// Rills roughen the slopes and leave the hills.
static void rills_cut_the_slopes(void **state)
{
    (void)state;
    Made smooth = make_rilled(300.0f, 384, 9, 1, 0.0f), cut = make_rilled(300.0f, 384, 9, 3, 1.0f);
    Made again = make_rilled(300.0f, 384, 9, 1, 1.0f);
    double before = roughness(smooth.field), after = roughness(cut.field);
    double lower = mean_height(smooth.field) - mean_height(cut.field);
    printf("  roughness %g and %g m, mean %g m lower\n", before, after, lower);
    assert_true(after > 2.0 * before);
    assert_true(lower > 0.0 && lower < 0.1 * 150.0);
    size_t bytes = sizeof(float) * (size_t)height_field_count(cut.field);
    assert_memory_equal(cut.field->height, again.field->height, bytes);
    clear(&smooth);
    clear(&cut);
    clear(&again);
}

static void threads_change_nothing(void **state)
{
    (void)state;
    Made one = make(300.0f, 128, 8, 1), three = make(300.0f, 128, 8, 3);
    size_t bytes = sizeof(float) * (size_t)height_field_count(one.field);
    assert_memory_equal(one.field->height, three.field->height, bytes);
    assert_memory_equal(one.field->wetness, three.field->wetness, bytes);
    clear(&one);
    clear(&three);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(valleys_are_as_far_apart_as_asked),
        cmocka_unit_test(all_tops_bend_alike),
        cmocka_unit_test(land_is_as_high_as_asked_and_under_soil),
        cmocka_unit_test(the_resolution_keeps_the_hills),
        cmocka_unit_test(rills_cut_the_slopes),
        cmocka_unit_test(threads_change_nothing),
    };
    return cmocka_run_group_tests(tests, make_shared, clear_shared);
}
