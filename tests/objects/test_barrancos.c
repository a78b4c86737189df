// A cone of ash (form volcano, kind: ash) and the barrancos that rain cuts into it.
#include "making_terrain.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { ROUND = 1024, MOST_WAVES = 128 };
static const double TURN = 6.283185307179586;

static TerrainParams ash(int barrancos, float age)
{
    TerrainParams params = terrain_params_default();
    params.form = TERRAIN_VOLCANO;
    params.size = 2600.0f;
    params.relief = 400.0f;
    params.resolution = 512;
    params.volcano.kind = VOLCANO_ASH;
    params.volcano.crater = 320.0f;
    params.volcano.barrancos = barrancos;
    params.volcano.age = age;
    return params;
}

// Radius at which a cone of ash() has half its height, m.
static double half_way(const TerrainParams *params)
{
    return 0.5 * (double)params->volcano.crater + 0.5 * (double)params->relief / 0.625;
}

// Heights on a circle about the summit.
static void walk_round(const HeightField *field, double radius, double height[ROUND])
{
    for (int k = 0; k < ROUND; k++) {
        double turn = TURN * k / ROUND;
        height[k] = (double)height_field_at(field, (float)(radius * cos(turn)),
                                            (float)(radius * sin(turn)));
    }
}

// Power of each number of waves about the cone, times that number: a fold of a given shape counts
// the same whatever its size.
static void spectrum(const double height[ROUND], double power[MOST_WAVES])
{
    for (int waves = 0; waves < MOST_WAVES; waves++) {
        double re = 0.0, im = 0.0;
        for (int k = 0; k < ROUND; k++) {
            re += height[k] * cos(TURN * waves * k / ROUND);
            im += height[k] * sin(TURN * waves * k / ROUND);
        }
        power[waves] = (re * re + im * im) * waves * waves;
    }
}

// The number of waves in whose octave most of the slopes about the cone lie.
static double peak_waves(const HeightField *field, double radius)
{
    double height[ROUND], power[MOST_WAVES], best = 0.0;
    int at = 0;
    walk_round(field, radius, height);
    spectrum(height, power);
    for (int low = 5; 1.5 * low < MOST_WAVES; low++) {
        double sum = 0.0;
        for (int waves = low; waves <= (int)(1.5 * low); waves++) {
            sum += power[waves];
        }
        sum /= 0.5 * low + 1.0;
        at = sum > best ? low : at;
        best = sum > best ? sum : best;
    }
    return 1.2247 * at;
}

static void as_many_barrancos_as_asked_for(void **state)
{
    (void)state;
    const int asked[3] = {14, 24, 40};
    for (int k = 0; k < 3; k++) {
        TerrainParams params = ash(asked[k], 0.3f);
        double peak = 0.0;
        for (uint64_t seed = 1; seed <= 2; seed++) {
            HeightField *field = make_heights(&params, seed, 1, NULL, NULL);
            peak += peak_waves(field, half_way(&params)) / 2.0;
            height_field_free(field);
        }
        printf("%d barrancos: peak at %g waves\n", asked[k], peak);
        assert_true(peak > 0.75 * asked[k] && peak < 1.25 * asked[k]);
    }
}

// Mean slope across the flank at half the height.
static double across(const TerrainParams *params, uint64_t seed)
{
    double height[ROUND], sum = 0.0, radius = half_way(params);
    HeightField *field = make_heights(params, seed, 1, NULL, NULL);
    walk_round(field, radius, height);
    for (int k = 0; k < ROUND; k++) {
        sum += fabs(height[(k + 1) % ROUND] - height[k]);
    }
    height_field_free(field);
    return sum / (TURN * radius);
}

static void age_deepens_them(void **state)
{
    (void)state;
    double last = 0.0;
    for (int k = 0; k < 3; k++) {
        TerrainParams params = ash(24, 0.1f + 0.2f * (float)k);
        double slope = across(&params, 2);
        printf("age %g: slope %g across\n", (double)params.volcano.age, slope);
        assert_true(slope > 1.15 * last);
        last = slope;
    }
    assert_true(last > 0.4); // walls, not waves
}

// Crests are sharp: the land bends more on its highest hundredth between two barrancos than a wave
// of the same slopes would.
static void ribs_have_edges(void **state)
{
    (void)state;
    TerrainParams params = ash(24, 0.5f);
    HeightField *field = make_heights(&params, 1, 1, NULL, NULL);
    double height[ROUND], bend = 0.0, slopes = 0.0, radius = half_way(&params);
    walk_round(field, radius, height);
    double step = TURN * radius / ROUND;
    for (int k = 0; k < ROUND; k++) {
        double before = height[(k + ROUND - 1) % ROUND], after = height[(k + 1) % ROUND];
        double here = (2.0 * height[k] - before - after) / (step * step);
        bend = here > bend ? here : bend;
        slopes += (after - before) * (after - before) / (4.0 * step * step) / ROUND;
    }
    double wave = TURN * 24.0 / (TURN * radius) * sqrt(2.0 * slopes); // of a sine
    printf("crests bend by %g per metre, a wave by %g\n", bend, wave);
    assert_true(bend > 4.0 * wave);
    height_field_free(field);
}

static double ring(const HeightField *field, double radius)
{
    double height[ROUND], sum = 0.0;
    walk_round(field, radius, height);
    for (int k = 0; k < ROUND; k++) {
        sum += height[k] / ROUND;
    }
    return sum;
}

// Cinder cones have straight flanks, high ones concave ones.
static void small_cones_are_straight(void **state)
{
    (void)state;
    for (int high = 0; high < 2; high++) {
        TerrainParams params = ash(0, 0.0f);
        params.size *= high ? 8.0f : 1.0f;
        params.relief = high ? 2000.0f : 400.0f;
        double rim = 0.5 * (double)params.volcano.crater, way = (double)params.relief / 0.625;
        HeightField *field = make_heights(&params, 1, 1, NULL, NULL);
        double upper =
            (ring(field, rim + 0.15 * way) - ring(field, rim + 0.35 * way)) / (0.2 * way);
        double lower = (ring(field, rim + 0.5 * way) - ring(field, rim + 0.7 * way)) / (0.2 * way);
        printf("relief %g m: slope %g above, %g below\n", (double)params.relief, upper, lower);
        assert_true(high ? lower < 0.8 * upper : fabs(lower - upper) < 0.06 && upper > 0.58);
        height_field_free(field);
    }
}

// Mean heights of the rim's east and of its west.
static void rim_sides(const TerrainParams *params, double *east, double *west)
{
    enum { ASIDE = ROUND / 32 };
    HeightField *field = make_heights(params, 1, 1, NULL, NULL);
    double height[ROUND];
    walk_round(field, 0.55 * (double)params->volcano.crater, height);
    *east = *west = 0.0;
    for (int k = -ASIDE; k <= ASIDE; k++) {
        *east += height[(k + ROUND) % ROUND] / (2 * ASIDE + 1);
        *west += height[k + ROUND / 2] / (2 * ASIDE + 1);
    }
    height_field_free(field);
}

// The side on which ash has slid off loses the rim, the other far less.
static void a_breach_opens_one_side(void **state)
{
    (void)state;
    TerrainParams params = ash(24, 0.2f);
    double east[2], west[2];
    rim_sides(&params, &east[0], &west[0]);
    params.volcano.breach = 0.4f;
    params.volcano.breach_azimuth = 90.0f; // east, +x
    rim_sides(&params, &east[1], &west[1]);
    double lost = east[0] - east[1];
    printf("the breach takes %g m, and %g m opposite\n", lost, west[0] - west[1]);
    assert_true(lost > 0.35 * (double)params.relief && west[0] - west[1] < 0.5 * lost);
}

static void the_same_bits_for_any_threads(void **state)
{
    (void)state;
    TerrainParams params = ash(20, 0.4f);
    params.resolution = 256;
    HeightField *one = make_heights(&params, 5, 1, NULL, NULL);
    HeightField *four = make_heights(&params, 5, 4, NULL, NULL);
    assert_true(height_field_hash(one) == height_field_hash(four));
    height_field_free(one);
    height_field_free(four);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(as_many_barrancos_as_asked_for),
                                       cmocka_unit_test(age_deepens_them),
                                       cmocka_unit_test(ribs_have_edges),
                                       cmocka_unit_test(small_cones_are_straight),
                                       cmocka_unit_test(a_breach_opens_one_side),
                                       cmocka_unit_test(the_same_bits_for_any_threads)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
