// The form volcano on several seeds: profile, crater, breach, lava, threads, volume.
#include "making_terrain.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static TerrainParams cone(void)
{
    TerrainParams params = terrain_params_default();
    params.form = TERRAIN_VOLCANO;
    params.size = 14000.0f;
    params.relief = 1600.0f;
    params.resolution = 128;
    params.volcano.flows = 5;
    return params;
}

static HeightField *heights(const TerrainParams *params, uint64_t seed, int threads,
                            MeasureList *list, double *volume)
{
    Grown grown;
    HeightField *field = make_heights(params, seed, threads, list, &grown);
    if (volume) {
        const Landscape *land = ((const Terrain *)grown.state)->evolved;
        volume[0] = landscape_volume(land);
        volume[1] = land->uplifted;
    }
    grown_clear(&grown);
    return field;
}

static void within(const MeasureList *list, const char *name, double low, double high)
{
    double is = measured(list, name);
    printf("  %s %g\n", name, is);
    if (!(is >= low && is <= high)) {
        fail_msg("%s is %g, not %g to %g", name, is, low, high);
    }
}

// Slopes of stratovolcanoes: near repose at the summit, a few degrees at the foot.
static void cones_are_concave(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 3; seed++) {
        TerrainParams params = cone();
        MeasureList list = {0};
        HeightField *field = heights(&params, seed, 1, &list, NULL);
        float low, high;
        height_field_range(field, &low, &high);
        printf("seed %d: relief %g m\n", (int)seed, (double)(high - low));
        assert_true(high - low > 0.9f * params.relief && high - low < 1.3f * params.relief);
        within(&list, "summit_slope", 25.0, 35.0);
        within(&list, "flank_slope", 8.0, 18.0);
        within(&list, "foot_slope", 1.5, 7.0);
        within(&list, "rim_sill", 0.2, 1.0); // closed
        within(&list, "crater_width", 0.75 * 0.26 * 1600.0, 1.5 * 0.26 * 1600.0);
        within(&list, "lava_share", 0.01, 0.5);
        for (int64_t i = 0; i < height_field_count(field); i++) {
            assert_true(isfinite(field->height[i]) && fabsf(field->ground[i]) <= 1.0f);
        }
        height_field_free(field);
        measures_clear(&list);
    }
}

static void a_breach_opens_the_rim(void **state)
{
    (void)state;
    TerrainParams params = cone();
    params.volcano.breach = 0.8f;
    params.volcano.breach_azimuth = 130.0f;
    MeasureList list = {0};
    height_field_free(heights(&params, 1, 1, &list, NULL));
    within(&list, "rim_sill", -1.0, 0.1);
    measures_clear(&list);
}

// A ring wall, and a floor that is lower than the flank of a cone without a caldera.
static void a_caldera_sinks(void **state)
{
    (void)state;
    TerrainParams params = cone();
    HeightField *without = heights(&params, 1, 1, NULL, NULL);
    params.volcano.caldera = 1800.0f;
    HeightField *with = heights(&params, 1, 1, NULL, NULL);
    float x = 1500.0f;
    float floor = height_field_at(with, x, 0.0f), flank = height_field_at(without, x, 0.0f);
    float wall = height_field_at(with, 1.2f * 1800.0f, 0.0f);
    printf("flank %g m, floor %g m, wall %g m\n", (double)flank, (double)floor, (double)wall);
    assert_true(floor < flank - 100.0f && wall > floor + 50.0f);
    height_field_free(without);
    height_field_free(with);
}

static void age_cuts_gullies_and_ages_lava(void **state)
{
    (void)state;
    TerrainParams params = cone();
    params.volcano.age = 0.0f;
    MeasureList young = {0}, old = {0};
    height_field_free(heights(&params, 2, 1, &young, NULL));
    params.volcano.age = 1.0f;
    height_field_free(heights(&params, 2, 1, &old, NULL));
    printf("steep share %g young, %g old\n", measured(&young, "cliff_share"),
           measured(&old, "cliff_share"));
    assert_true(measured(&old, "cliff_share") > measured(&young, "cliff_share"));
    measures_clear(&young);
    measures_clear(&old);
}

static void the_same_bits_for_any_threads(void **state)
{
    (void)state;
    TerrainParams params = cone();
    params.volcano.breach = 0.5f;
    HeightField *one = heights(&params, 4, 1, NULL, NULL);
    HeightField *four = heights(&params, 4, 4, NULL, NULL);
    assert_true(height_field_hash(one) == height_field_hash(four));
    size_t bytes = sizeof(float) * (size_t)height_field_count(one);
    assert_memory_equal(one->climate, four->climate, bytes);
    assert_memory_equal(one->ground, four->ground, bytes);
    height_field_free(one);
    height_field_free(four);
}

// Rock, loose ground and what has left, less what has erupted, is the plain that was there before,
// whatever has erupted.
static void volume_is_kept(void **state)
{
    (void)state;
    TerrainParams params = cone();
    double quiet[2], active[2];
    params.volcano.flows = 0;
    height_field_free(heights(&params, 3, 1, NULL, quiet));
    params.volcano.flows = 12;
    height_field_free(heights(&params, 3, 1, NULL, active));
    printf("plain %.12g and %.12g m^3, erupted %.6g and %.6g m^3\n", quiet[0], active[0], quiet[1],
           active[1]);
    assert_true(active[1] > quiet[1] + 5e7);
    assert_true(fabs(active[0] - quiet[0]) < 1e-9 * active[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cones_are_concave), cmocka_unit_test(a_breach_opens_the_rim),
        cmocka_unit_test(a_caldera_sinks),   cmocka_unit_test(age_cuts_gullies_and_ages_lava),
        cmocka_unit_test(volume_is_kept),    cmocka_unit_test(the_same_bits_for_any_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
