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

static bool in_hole(int32_t i)
{
    int x = i % SIDE - SIDE / 2, z = i / SIDE - SIDE / 2;
    return x * x + z * z < 36;
}

// A tilted plane with bumps, whose streams reach the fourth order; with or without a hole, where
// heights are missing.
static Land new_land(uint64_t seed, bool hole)
{
    Error e = {0};
    Land land = {.field = height_field_new(SIDE, SIDE, (Vec2){1.0f, 1.0f}, (Vec2){0}, &e)};
    assert_non_null(land.field);
    for (int i = 0; i < SAMPLES; i++) {
        float bump = random_unit(random_key(seed, (uint64_t)i));
        float height = 0.3f * (float)(i / SIDE) + 2.0f * bump;
        land.field->height[i] = hole && in_hole(i) ? NAN : height;
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

// Beside the outermost samples that have a height, where water leaves the field.
static bool is_near_rim(const Land *land, int32_t i)
{
    int column = i % SIDE, row = i / SIDE;
    bool near = column < 2 || row < 2 || column > SIDE - 3 || row > SIDE - 3;
    for (int k = 0; !near && k < 25; k++) {
        near = isnan(land->field->height[i + (k / 5 - 2) * SIDE + k % 5 - 2]);
    }
    return near;
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
            if (is_near_rim(land, i)) {
                return (double)NAN;
            }
        }
    }
    return (sum / samples - low) / (high - low);
}

typedef struct BruteMean {
    double sum;
    int basins, cut;
} BruteMean;

static BruteMean brute_mean(const Land *land, int rank)
{
    BruteMean mean = {0};
    for (int32_t i = 0; i < SAMPLES; i++) {
        int32_t to = land->drainage->receiver[i];
        if (!isnan(land->field->height[i]) && land->order[i] == rank && land->order[to] > rank) {
            double integral = brute_integral(land, i);
            mean.cut += isnan(integral);
            mean.basins += !isnan(integral);
            mean.sum += isnan(integral) ? 0.0 : integral;
        }
    }
    return mean;
}

static double measured(const Land *land, int rank)
{
    Error e = {0};
    double integral = 0.0;
    assert_true(basin_hypsometry(land->field, land->drainage, land->order, rank, &integral, &e));
    return integral;
}

static void basins_are_those_of_brute_force(void **state)
{
    (void)state;
    for (int k = 0; k < 6; k++) {
        Land land = new_land((uint64_t)k / 2, k % 2);
        for (int rank = 1; rank <= 3; rank++) {
            BruteMean mean = brute_mean(&land, rank);
            assert_true(mean.basins > 0);
            assert_true(rank > 1 || mean.cut > 0); // the test sees basins of both kinds
            assert_true(fabs(measured(&land, rank) - mean.sum / mean.basins) < 1e-9);
        }
        free_land(&land);
    }
}

static void land_without_streams_of_a_rank_has_no_integral(void **state)
{
    (void)state;
    Land land = new_land(4, false);
    assert_true(isnan(measured(&land, 200)));
    free_land(&land);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(basins_are_those_of_brute_force),
        cmocka_unit_test(land_without_streams_of_a_rank_has_no_integral),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
