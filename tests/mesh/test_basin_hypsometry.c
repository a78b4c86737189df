#include "base/random.h"
#include "land/basin_hypsometry.h"
#include "land/height_measure.h"
#include "testing.h"

#include <math.h>
#include <stdlib.h>

enum { SIDE = 97, SAMPLES = SIDE * SIDE };

typedef struct Land {
    HeightField *field;
    Drainage *drainage;
    uint8_t *order;
} Land;

// A tilted plane with bumps, whose streams reach the fourth order.
static Land new_land(uint64_t seed)
{
    Error e = {0};
    Land land = {.field = height_field_new(SIDE, SIDE, (Vec2){1.0f, 1.0f}, (Vec2){0}, &e)};
    assert_non_null(land.field);
    for (int i = 0; i < SAMPLES; i++) {
        float bump = random_unit(random_key(seed, (uint64_t)i));
        land.field->height[i] = 0.3f * (float)(i / SIDE) + 2.0f * bump;
    }
    assert_true(height_field_fill(land.field, 1e-3f, &e));
    land.drainage = drainage_new(land.field, &e);
    land.order = calloc(SAMPLES, 1);
    assert_true(land.drainage && land.order);
    assert_true(drainage_orders(land.drainage, 6.0, land.order, &e));
    return land;
}

static void free_land(Land *land)
{
    height_field_free(land->field);
    drainage_free(land->drainage);
    free(land->order);
}

static bool drains_through(const Drainage *drainage, int32_t i, int32_t mouth)
{
    while (i != mouth && drainage->receiver[i] != i) {
        i = drainage->receiver[i];
    }
    return i == mouth;
}

static bool is_near_rim(int32_t i)
{
    int column = i % SIDE, row = i / SIDE;
    return column < 2 || row < 2 || column > SIDE - 3 || row > SIDE - 3;
}

// The integral of the basin above a mouth, by following every sample; NAN if the rim cuts it.
static double brute_integral(const Land *land, int32_t mouth)
{
    double sum = 0.0, low = INFINITY, high = -INFINITY;
    int samples = 0;
    for (int32_t i = 0; i < SAMPLES; i++) {
        if (drains_through(land->drainage, i, mouth)) {
            double height = (double)land->field->height[i];
            sum += height;
            low = fmin(low, height);
            high = fmax(high, height);
            samples++;
            if (is_near_rim(i)) {
                return (double)NAN;
            }
        }
    }
    return (sum / samples - low) / (high - low);
}

static void basins_are_those_of_brute_force(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 3; seed++) {
        Land land = new_land(seed);
        for (int rank = 1; rank <= 3; rank++) {
            double sum = 0.0;
            int basins = 0, cut = 0;
            for (int32_t i = 0; i < SAMPLES; i++) {
                int32_t to = land.drainage->receiver[i];
                if (land.order[i] == rank && land.order[to] > rank) {
                    double integral = brute_integral(&land, i);
                    cut += isnan(integral);
                    basins += !isnan(integral);
                    sum += isnan(integral) ? 0.0 : integral;
                }
            }
            assert_true(basins > 0);
            assert_true(rank > 1 || cut > 0); // the test sees basins of both kinds
            Error e = {0};
            double integral;
            assert_true(
                basin_hypsometry(land.field, land.drainage, land.order, rank, &integral, &e));
            assert_true(fabs(integral - sum / basins) < 1e-9);
        }
        free_land(&land);
    }
}

// A hole beside a basin cuts it, and land without confluences has no integral.
static void cut_basins_do_not_count(void **state)
{
    (void)state;
    Error e = {0};
    Land land = new_land(4);
    double integral;
    assert_true(basin_hypsometry(land.field, land.drainage, land.order, 200, &integral, &e));
    assert_true(isnan(integral));
    for (int i = 0; i < SAMPLES; i++) {
        if (i % 3 == 0 && i / SIDE % 3 == 0) {
            land.field->height[i] = NAN;
        }
    }
    assert_true(basin_hypsometry(land.field, land.drainage, land.order, 1, &integral, &e));
    assert_true(isnan(integral));
    free_land(&land);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(basins_are_those_of_brute_force),
        cmocka_unit_test(cut_basins_do_not_count),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
