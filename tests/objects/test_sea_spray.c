// Spray of surf: where it is thrown up, how high, and when.
#include "objects/sea/spray.h"

#include <math.h>
#include <stdlib.h>

#include "testing.h"

enum { SIDE = 48, WALL = 30 }; // rows of water, then land
static const float cell = 2.5f, deep = 4.0f;

// Waves run along z toward land of this height (negative: ground under water), which begins with a
// step or, if `rises`, along a slope of 1 in 20.
static Waves *shore_with(float land, bool rises)
{
    Waves *waves = calloc(1, sizeof *waves);
    WavesShore *shore = calloc(1, sizeof *shore);
    int64_t count = (int64_t)SIDE * SIDE;
    *shore = (WavesShore){.columns = SIDE, .rows = SIDE, .cell = cell};
    shore->depth = calloc((size_t)count, sizeof(float));
    shore->share = calloc((size_t)count * WAVES_TILES, sizeof(float));
    shore->shift = calloc((size_t)count * WAVES_TILES, sizeof(float));
    shore->breaking = calloc((size_t)count, sizeof(float));
    shore->drift = calloc((size_t)count, sizeof(float));
    for (int64_t i = 0; i < count; i++) {
        shore->depth[i] = i / SIDE < WALL ? deep : -land;
        if (rises) {
            shore->depth[i] = fmaxf(0.05f * cell * (float)(WALL - i / SIDE), -land);
        }
        shore->share[i * WAVES_TILES] = i / SIDE < WALL ? 1.0f : 0.0f;
    }
    waves->way = (Vec2){0.0f, 1.0f};
    waves->shore = shore;
    return waves;
}

static Waves *shore_of(float land)
{
    return shore_with(land, false);
}

static SprayParcels *spray_at(Waves *waves, float seconds)
{
    SeaParams params = sea_params_default();
    params.level = 3.0f;
    params.time = seconds;
    SprayParcels *spray = sea_spray(&params, waves, 8, NULL);
    assert_non_null(spray);
    return spray;
}

// No jet is higher than its speed allows, 3.4 sqrt(g H), and none is far from the wall.
static void cliffs_throw_spray_up(void **state)
{
    (void)state;
    Waves *waves = shore_of(20.0f);
    SeaParams params = sea_params_default();
    WaveSpectrum spectrum = sea_spectrum(&params);
    double high = 4.0 * sqrt(wave_spectrum_variance(&spectrum)) * 0.5 * 3.4 * 3.4;
    int64_t all = 0, aloft = 0;
    for (int k = 0; k < 12; k++) {
        SprayParcels *spray = spray_at(waves, 0.7f * (float)k);
        for (int64_t i = 0; i < spray->count; i++) {
            const SprayParcel *parcel = &spray->parcel[i];
            float wall = cell * (float)WALL - cell;
            assert_true((double)(parcel->center.y - 3.0f) <= high);
            assert_true(fabsf(parcel->center.z - wall) < 25.0f);
            assert_true(parcel->radius > 0.0f && parcel->content >= 0.0f);
            aloft += parcel->center.y > 3.0f + 0.2f * (float)high;
        }
        all += spray->count;
        spray_free(spray);
    }
    assert_true(all > 500 && aloft > all / 50 && aloft < all);
    waves_free(waves);
}

static void beaches_and_lee_shores_do_not(void **state)
{
    (void)state;
    Waves *flat = shore_with(0.5f, true), *lee = shore_of(20.0f);
    lee->way.y = -1.0f;
    for (int k = 0; k < 6; k++) {
        SprayParcels *a = spray_at(flat, (float)k), *b = spray_at(lee, (float)k);
        assert_int_equal(a->count, 0);
        assert_int_equal(b->count, 0);
        spray_free(a);
        spray_free(b);
    }
    waves_free(flat);
    waves_free(lee);
}

// The higher jets over a shore in twelve moments, m above the water.
static double highest_over(float land, int64_t *count)
{
    Waves *waves = shore_of(land);
    double highest = 0.0;
    *count = 0;
    for (int k = 0; k < 12; k++) {
        SprayParcels *spray = spray_at(waves, 0.7f * (float)k);
        for (int64_t i = 0; i < spray->count; i++) {
            highest = fmax(highest, (double)(spray->parcel[i].center.y - 3.0f));
        }
        *count += spray->count;
        spray_free(spray);
    }
    waves_free(waves);
    return highest;
}

// Waves that come out of deep water over the edge of a platform are thrown up, less than at a
// cliff, and the less the deeper the water is that carries them on.
static void edges_of_platforms_throw_less_up(void **state)
{
    (void)state;
    int64_t at_cliff, dry, shallow, drowned;
    double cliff = highest_over(20.0f, &at_cliff), ledge = highest_over(0.3f, &dry);
    double reef = highest_over(-0.5f, &shallow), deep_reef = highest_over(-3.0f, &drowned);
    print_message("cliff %.2f m, ledge %.2f m, reef %.2f m\n", cliff, ledge, reef);
    assert_true(dry > 100 && shallow > 50 && drowned == 0 && deep_reef == 0.0);
    assert_true(ledge > 0.3 * cliff && ledge < 0.8 * cliff && reef < ledge && reef > 0.1 * cliff);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cliffs_throw_spray_up),
        cmocka_unit_test(beaches_and_lee_shores_do_not),
        cmocka_unit_test(edges_of_platforms_throw_less_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
