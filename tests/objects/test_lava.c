// Lava on an inclined plane against closed forms, its volume, and the way it takes.
#include "land/lava.h"
#include "testing.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CELLS = 128 };
static const double CELL = 10.0;

// A plane that falls along +z.
static Landscape *incline(double slope)
{
    Landscape *land = landscape_new(CELLS, CELLS * CELL, NULL, NULL);
    assert_non_null(land);
    for (int64_t i = 0; i < landscape_count(land); i++) {
        land->rock[i] = 1000.0 - slope * CELL * (double)(i / land->side);
    }
    return land;
}

static const LavaParams LAVA = {
    .volume = 1.2e5, .rate = 100.0, .yield = 1.0, .viscosity = 0.3, .seed = 7};

static double *erupt(Landscape *land, const LavaParams *params, double x, double z, int threads)
{
    Error e = {0};
    Run run = run_default();
    run.threads = threads;
    double *thickness = malloc(sizeof *thickness * (size_t)landscape_count(land));
    if (!lava_erupt(land, params, x, z, thickness, &run, &e)) {
        fail_msg("%s", e.message);
    }
    return thickness;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// A sheet at rest is as thick as yield strength / (density g slope), wherever it is not at the
// edge.
static void lava_rests_at_its_critical_thickness(void **state)
{
    (void)state;
    static const double slopes[] = {0.2, 0.3, 0.4};
    for (int k = 0; k < 3; k++) {
        double slope = slopes[k], wanted = LAVA.yield / slope, inner[CELLS];
        Landscape *land = incline(slope);
        LavaParams params = LAVA;
        params.volume *= 0.09 / (slope * slope); // edges are as long as thickness / slope
        double *thickness = erupt(land, &params, 0.0, -450.0, 1);
        int count = 0;
        for (int row = 25; row < CELLS - 3; row++) { // below the vent, along the middle
            double h = thickness[(int64_t)row * land->side + CELLS / 2];
            if (thickness[(int64_t)(row + 3) * land->side + CELLS / 2] > 0.0) {
                inner[count++] = h;
            }
        }
        assert_true(count > 12);
        qsort(inner, (size_t)count, sizeof *inner, ascending);
        printf("slope %g: %g m, closed form %g m, %d samples\n", slope, inner[count / 2], wanted,
               count);
        if (fabs(inner[count / 2] - wanted) > 0.03 * wanted) {
            fail_msg("%g m on a slope of %g, not %g m", inner[count / 2], slope, wanted);
        }
        free(thickness);
        landscape_free(land);
    }
}

static void lava_keeps_its_volume(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        Landscape *land = incline(0.3);
        LavaParams params = LAVA;
        params.volume = k == 0 ? 6e4 : 6e5; // the second runs over the rim
        params.cooling = 1e-4;
        params.stiffening = 1.0;
        double before = landscape_volume(land), sum = 0.0;
        double *thickness = erupt(land, &params, 100.0, -300.0, 1);
        for (int64_t i = 0; i < landscape_count(land); i++) {
            assert_true(thickness[i] >= 0.0);
            sum += thickness[i] * CELL * CELL;
        }
        printf("volume %g, on the land %g, outflow %g\n", params.volume, sum, land->outflow);
        assert_true(fabs(landscape_volume(land) - before) < 1e-6 * params.volume);
        assert_true(fabs(sum + land->outflow - params.volume) < 1e-6 * params.volume);
        assert_true((land->outflow > 0.0) == (k == 1));
        free(thickness);
        landscape_free(land);
    }
}

// Lava goes down, spreads evenly to both sides, and is thickest in front where it has cooled.
static void lava_flows_down_and_ends_in_a_front(void **state)
{
    (void)state;
    Landscape *land = incline(0.3), *again = incline(0.3);
    LavaParams params = LAVA;
    params.cooling = 4e-3;
    params.stiffening = 2.5;
    double *thickness = erupt(land, &params, 0.0, -450.0, 1);
    double *same = erupt(again, &params, 0.0, -450.0, 4);
    size_t bytes = sizeof(double) * (size_t)landscape_count(land);
    assert_memory_equal(thickness, same, bytes);
    assert_memory_equal(land->rock, again->rock, bytes);
    double left = 0.0, right = 0.0, up = 0.0, down = 0.0;
    int front = 0, from = CELLS, to = 0;
    for (int64_t i = 0; i < landscape_count(land); i++) {
        int column = (int)(i % land->side), row = (int)(i / land->side);
        double h = thickness[i];
        *(column < CELLS / 2 ? &left : &right) += column == CELLS / 2 ? 0.0 : h;
        *(row < 19 ? &up : &down) += h;
        front = h > 0.5 && row > front ? row : front;
        from = h > 0.5 && column < from ? column : from;
        to = h > 0.5 && column > to ? column : to;
    }
    assert_true(fabs(left - right) < 0.03 * (left + right));
    assert_true(up < 0.12 * down);
    assert_true(front - 19 > (to - from) / 2); // longer than half as wide
    double middle = thickness[(int64_t)((19 + front) / 2) * land->side + CELLS / 2], high = 0.0;
    for (int row = front - 8; row <= front; row++) {
        high = fmax(high, thickness[(int64_t)row * land->side + CELLS / 2]);
    }
    printf("length %d, width %d, middle %g m, front %g m\n", front - 19, to - from, middle, high);
    assert_true(high > 1.05 * middle);
    free(thickness);
    free(same);
    landscape_free(land);
    landscape_free(again);
}

// A cold crust stiffens lava: what cools faster stays shorter and thicker.
static void cooling_shortens_a_flow(void **state)
{
    (void)state;
    double length[2];
    for (int k = 0; k < 2; k++) {
        Landscape *land = incline(0.3);
        LavaParams params = LAVA;
        params.volume = 6e4;
        params.stiffening = 2.0;
        params.cooling = k == 0 ? 0.0 : 1e-2;
        double *thickness = erupt(land, &params, 0.0, -450.0, 1);
        length[k] = 0.0;
        for (int64_t i = 0; i < landscape_count(land); i++) {
            double down = (double)(i / land->side) * CELL;
            length[k] = thickness[i] > 0.5 ? fmax(length[k], down) : length[k];
        }
        free(thickness);
        landscape_free(land);
    }
    printf("ends at %g m hot, %g m cooling\n", length[0], length[1]);
    assert_true(length[1] < 0.9 * length[0]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lava_rests_at_its_critical_thickness),
        cmocka_unit_test(lava_keeps_its_volume),
        cmocka_unit_test(lava_flows_down_and_ends_in_a_front),
        cmocka_unit_test(cooling_shortens_a_flow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
