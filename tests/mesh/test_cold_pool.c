// The level of pooled cold air against closed forms and a brute force.
#include "testing.h"

#include "base/random.h"
#include "land/cold_pool.h"

#include <math.h>
#include <string.h>

typedef float Surface(int x, int z);

static HeightField *make(int side, Surface *surface)
{
    HeightField *field =
        height_field_new(side, side, (Vec2){10.0f, 10.0f}, (Vec2){-50.0f, 70.0f}, NULL);
    assert_non_null(field);
    for (int i = 0; i < side * side; i++) {
        field->height[i] = surface(i % side, i / side);
    }
    return field;
}

static HeightField *level_of(const HeightField *land, ColdPoolParams params, int threads)
{
    Run run = run_default();
    run.threads = threads;
    HeightField *level = cold_pool_level(land, &params, &run, NULL);
    assert_non_null(level);
    return level;
}

static float slope(int x, int z)
{
    return 3.0f * (float)x + 0.0f * (float)z;
}

// On a slope s the lowest land is a radius downhill, and means change nothing: h - s radius. Wind
// that blows uphill banks up drift s radius / 2, and one that blows downhill takes as much.
static void a_slope_has_its_closed_form(void **state)
{
    (void)state;
    enum { SIDE = 129, MIDDLE = 64 };
    HeightField *land = make(SIDE, slope);
    const float wanted = 3.0f * MIDDLE - 0.3f * 100.0f;
    for (int i = 0; i < 4; i++) {
        ColdPoolParams params = {.radius = 100.0f, .depth = 200.0f, .drift = i == 0 ? 0.0f : 0.8f};
        params.wind = 90.0f * (float)i; // 90: toward +x, uphill
        float banked = i == 1 ? 12.0f : (i == 3 ? -12.0f : 0.0f);
        HeightField *level = level_of(land, params, 2);
        float met = level->height[MIDDLE * SIDE + MIDDLE];
        assert_true(fabsf(met - wanted - banked) < 0.01f);
        height_field_free(level);
    }
    height_field_free(land);
}

static float rough(int x, int z)
{
    return 100.0f * random_unit(random_key((uint64_t)x, (uint64_t)z));
}

static int mirrored(int i, int side)
{
    i = i < 0 ? -i : i;
    return i > side - 1 ? 2 * (side - 1) - i : i;
}

static int repeated(int i, int side)
{
    return (i + side - 1) % (side - 1);
}

// What a square window holds: its least sample, or the mean of all.
static double window(const double *from, int side, bool periodic, int x, int z, int reach,
                     bool lowest)
{
    double least = INFINITY, sum = 0.0;
    for (int k = z - reach; k <= z + reach; k++) {
        for (int i = x - reach; i <= x + reach; i++) {
            int column = periodic ? repeated(i, side) : mirrored(i, side);
            int row = periodic ? repeated(k, side) : mirrored(k, side);
            least = fmin(least, from[row * side + column]);
            sum += from[row * side + column];
        }
    }
    return lowest ? least : sum / (double)((2 * reach + 1) * (2 * reach + 1));
}

static void levels_are_those_of_a_brute_force(void **state)
{
    (void)state;
    enum { SIDE = 33 };
    static double a[SIDE * SIDE], b[SIDE * SIDE];
    for (int periodic = 0; periodic < 2; periodic++) {
        HeightField *land = make(SIDE, rough);
        land->periodic = periodic;
        for (int i = 0; i < SIDE && periodic; i++) { // the last samples are the first again
            land->height[i * SIDE + SIDE - 1] = land->height[i * SIDE];
            land->height[(SIDE - 1) * SIDE + i] = land->height[i];
        }
        land->height[SIDE * SIDE - 1] = periodic ? land->height[0] : land->height[SIDE * SIDE - 1];
        for (int i = 0; i < SIDE * SIDE; i++) {
            a[i] = (double)land->height[i];
        }
        for (int pass = 0; pass < 3; pass++) {
            for (int i = 0; i < SIDE * SIDE; i++) {
                b[i] = window(a, SIDE, periodic, i % SIDE, i / SIDE, pass == 0 ? 4 : 2, pass == 0);
            }
            memcpy(a, b, sizeof a);
        }
        HeightField *level = level_of(land, (ColdPoolParams){.radius = 40.0f, .depth = 50.0f}, 2);
        for (int i = 0; i < SIDE * SIDE; i++) {
            assert_true(fabs((double)level->height[i] - a[i]) < 1e-3);
        }
        height_field_free(level);
        height_field_free(land);
    }
}

static float gully(int x, int z)
{
    return x == 333 && z >= 0 ? -40.0f : 0.0f; // between the samples of the level
}

// Of land in more samples than the level has, the narrowest valley still counts.
static void fine_land_loses_no_valley(void **state)
{
    (void)state;
    HeightField *land = make(1025, gully);
    HeightField *level = level_of(land, (ColdPoolParams){.radius = 200.0f, .depth = 50.0f}, 2);
    assert_int_equal(level->columns, COLD_POOL_SIDE);
    assert_true(level->height[200 * level->columns + 166] == -40.0f);
    assert_true(level->height[200 * level->columns + 100] == 0.0f);
    height_field_free(level);
    height_field_free(land);
}

static void threads_do_not_change_levels(void **state)
{
    (void)state;
    HeightField *land = make(200, rough);
    ColdPoolParams params = {.radius = 90.0f, .depth = 30.0f, .drift = 1.0f, .wind = 33.0f};
    HeightField *one = level_of(land, params, 1), *three = level_of(land, params, 3);
    assert_memory_equal(one->height, three->height,
                        sizeof *one->height * (size_t)height_field_count(one));
    height_field_free(one);
    height_field_free(three);
    height_field_free(land);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_slope_has_its_closed_form),
        cmocka_unit_test(levels_are_those_of_a_brute_force),
        cmocka_unit_test(fine_land_loses_no_valley),
        cmocka_unit_test(threads_do_not_change_levels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
