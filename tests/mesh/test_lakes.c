// Lakes of height fields: spill levels against brute force, volumes against closed forms.
#include "base/random.h"
#include "land/height_drainage.h"
#include "land/lakes.h"
#include "testing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const LakeLimits ALL = {0};

static HeightField *new_field(int side, float cell)
{
    Error e = {0};
    float corner = -0.5f * cell * (float)(side - 1);
    HeightField *field =
        height_field_new(side, side, (Vec2){cell, cell}, (Vec2){corner, corner}, &e);
    assert_non_null(field);
    return field;
}

static HeightField *random_field(int side, uint64_t seed, int steps)
{
    HeightField *field = new_field(side, 1.0f);
    for (int i = 0; i < side * side; i++) {
        float h = random_unit(random_key(seed, (uint64_t)i));
        // Few different heights make ties.
        field->height[i] = steps > 0 ? floorf((float)steps * h) : 10.0f * h;
    }
    return field;
}

static bool on_rim(int side, int i)
{
    return i % side == 0 || i / side == 0 || i % side == side - 1 || i / side == side - 1;
}

// Of each sample the height of the highest sample on the lowest way to the rim, by relaxation.
static void relax(const HeightField *field, float *level)
{
    int w = field->columns;
    for (int i = 0; i < w * w; i++) {
        level[i] = on_rim(w, i) ? field->height[i] : INFINITY;
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (int i = 0; i < w * w; i++) {
            for (int k = 0; k < 9 && !on_rim(w, i); k++) {
                float way = fmaxf(level[i + k % 3 - 1 + (k / 3 - 1) * w], field->height[i]);
                changed = changed || way < level[i];
                level[i] = fminf(level[i], way);
            }
        }
    }
}

enum { SIDE = 41 };

static void pools_spill_as_by_brute_force(void **state)
{
    (void)state;
    static float level[SIDE * SIDE];
    for (uint64_t seed = 0; seed < 24; seed++) {
        HeightField *field = random_field(SIDE, seed, seed % 2 == 0 ? 0 : 4);
        Error e = {0};
        Drainage *flooded = drainage_spill(field, &e);
        assert_non_null(flooded);
        relax(field, level);
        for (int i = 0; i < SIDE * SIDE; i++) {
            assert_true(flooded->filled[i] == level[i]); // to the bit
        }
        drainage_free(flooded);
        height_field_free(field);
    }
}

static bool touches(const Lakes *lakes, int sample, int lake)
{
    for (int k = 0; k < 9; k++) {
        int c = sample % SIDE + k % 3 - 1, r = sample / SIDE + k / 3 - 1;
        if (c >= 0 && r >= 0 && c < SIDE && r < SIDE && lakes->label[r * SIDE + c] == lake) {
            return true;
        }
    }
    return false;
}

// Each sample under a pool's level is of one lake, each outlet is a sample beside it, as high as
// its level, from which a way leads out that never rises above it.
static void lakes_are_the_pools_and_leave_over_their_outlets(void **state)
{
    (void)state;
    static float level[SIDE * SIDE];
    for (uint64_t seed = 0; seed < 24; seed++) {
        HeightField *field = random_field(SIDE, 100 + seed, seed % 2 == 0 ? 0 : 4);
        Error e = {0};
        Lakes *lakes = lakes_find(field, &ALL, &e);
        assert_non_null(lakes);
        relax(field, level);
        int64_t wet = 0, sum = 0;
        for (int i = 0; i < SIDE * SIDE; i++) {
            int lake = lakes->label[i];
            assert_true((lake >= 0) == (level[i] > field->height[i]));
            assert_true(lake < 0 || lakes->lake[lake].level == level[i]);
            wet += lake >= 0;
        }
        assert_true(lakes->count > 10);
        for (int k = 0; k < lakes->count; k++) {
            const Lake *lake = &lakes->lake[k];
            assert_true(k == 0 || lake->samples <= lakes->lake[k - 1].samples);
            assert_int_equal(lakes->label[lake->outlet], -1);
            assert_true(field->height[lake->outlet] == lake->level);
            assert_true(level[lake->outlet] == lake->level);
            assert_true(touches(lakes, lake->outlet, k));
            sum += lake->samples;
        }
        assert_int_equal(sum, wet);
        lakes_free(lakes);
        height_field_free(field);
    }
}

// A paraboloid of radius R and depth D holds pi R^2 D / 2; the raster's error falls with the cell.
static void a_parabolic_pit_holds_half_of_its_cylinder(void **state)
{
    (void)state;
    double last = INFINITY;
    for (int side = 65; side <= 513; side = 2 * side - 1) {
        float cell = 100.0f / (float)(side - 1);
        HeightField *field = new_field(side, cell);
        for (int i = 0; i < side * side; i++) {
            float x = field->origin.x + cell * (float)(i % side);
            int row = i / side;
            float z = field->origin.y + cell * (float)row;
            float r2 = (x * x + z * z) / (37.0f * 37.0f);
            field->height[i] = 7.0f + (r2 < 1.0f ? 6.0f * (r2 - 1.0f) : 0.0f);
        }
        Error e = {0};
        Lakes *lakes = lakes_find(field, &ALL, &e);
        assert_true(lakes && lakes->count == 1);
        const Lake *lake = &lakes->lake[0];
        double area = 3.14159265358979 * 37.0 * 37.0, volume = area * 6.0 / 2.0;
        assert_true(lake->level == 7.0f);
        assert_true(fabs((double)lake->depth - 6.0) < 1e-5);
        double error = fabs(lake->volume / volume - 1.0);
        assert_true(error < fmax(0.6 * last, 2e-5) && error < 2e-3);
        last = fmax(error, 1e-5);
        assert_true(fabs((double)lake->samples * (double)(cell * cell) / area - 1.0) <
                    2.0 * (double)cell / 37.0);
        lakes_free(lakes);
        height_field_free(field);
    }
}

// Three square pits: what is too small, too shallow or one too many is no lake, the rest keep
// their order.
static void limits_leave_the_largest(void **state)
{
    (void)state;
    static const struct {
        int x, z, side;
        float depth;
    } PIT[] = {{5, 5, 4, 3.0f}, {15, 5, 8, 2.0f}, {5, 20, 12, 0.5f}};
    HeightField *field = new_field(SIDE, 2.0f);
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < PIT[k].side * PIT[k].side; i++) {
            int c = PIT[k].x + i % PIT[k].side, r = PIT[k].z + i / PIT[k].side;
            field->height[r * SIDE + c] = -PIT[k].depth;
        }
    }
    static const struct {
        LakeLimits limits;
        int count;
        float depth[3];
    } CASES[] = {{{0}, 3, {0.5f, 2.0f, 3.0f}},
                 {{.count = 2}, 2, {0.5f, 2.0f}},
                 {{.area = 65.0}, 2, {0.5f, 2.0f}},
                 {{.depth = 1.0}, 2, {2.0f, 3.0f}},
                 {{.count = 1, .depth = 1.0}, 1, {2.0f}},
                 {{.depth = 9.0}, 0, {0}}};
    for (size_t n = 0; n < sizeof CASES / sizeof *CASES; n++) {
        Error e = {0};
        Lakes *lakes = lakes_find(field, &CASES[n].limits, &e);
        assert_non_null(lakes);
        assert_int_equal(lakes->count, CASES[n].count);
        int64_t labelled = 0, samples = 0;
        for (int k = 0; k < lakes->count; k++) {
            assert_true(lakes->lake[k].depth == CASES[n].depth[k]);
            samples += lakes->lake[k].samples;
        }
        for (int i = 0; i < SIDE * SIDE; i++) {
            assert_true(lakes->label[i] < lakes->count);
            labelled += lakes->label[i] >= 0;
        }
        assert_int_equal(labelled, samples);
        lakes_free(lakes);
    }
    height_field_free(field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pools_spill_as_by_brute_force),
        cmocka_unit_test(lakes_are_the_pools_and_leave_over_their_outlets),
        cmocka_unit_test(a_parabolic_pit_holds_half_of_its_cylinder),
        cmocka_unit_test(limits_leave_the_largest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
