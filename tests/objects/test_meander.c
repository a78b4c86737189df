// Meandering rivers: growth of small waves against the closed form, cutoffs, sinuosity.
#include "land/meander.h"
#include "making_terrain.h"
#include "testing.h"

#include <math.h>

// The line's part at one wave number: rms of its sine and cosine.
static double amplitude(const Meander *m, double wavelength)
{
    double c = 0.0, s = 0.0;
    for (int64_t i = 0; i < m->count; i++) {
        double phase = 6.283185307179586 * m->node[i].z / wavelength;
        c += m->node[i].x * cos(phase);
        s += m->node[i].x * sin(phase);
    }
    return 2.0 * sqrt(c * c + s * s) / (double)m->count;
}

static void small_waves_grow_as_the_closed_form(void **state)
{
    (void)state;
    const double wavelengths[] = {6.0, 8.0, 11.0, 16.0, 30.0}; // the first one fades
    for (int n = 0; n < 5; n++) {
        double wavelength = wavelengths[n];
        Meander *m = meander_new(0.25, 4.0 * wavelength, 0.0, 1, NULL);
        assert_non_null(m);
        m->width = 1.0; // nodes closer than a river's own, which stand for the closed form
        for (int64_t i = 0; i < m->count; i++) {
            m->node[i].x = 1e-3 * sin(6.283185307179586 * m->node[i].z / wavelength);
        }
        double before = amplitude(m, wavelength);
        for (int i = 0; i < 1000; i++) {
            meander_move(m, 0.004);
        }
        double growth = log(amplitude(m, wavelength) / before) / m->time;
        double wanted = meander_growth(wavelength);
        if (fabs(growth - wanted) > 0.02 * fabs(wanted) + 0.001) {
            fail_msg("wavelength %g: growth %g, not %g", wavelength, growth, wanted);
        }
        meander_free(m);
    }
    assert_true(meander_growth(6.0) < 0.0 && meander_growth(11.0) > 0.0);
}

static void a_grown_river_winds_and_never_crosses_itself(void **state)
{
    (void)state;
    Error e = {0};
    Run run = run_default();
    for (uint64_t seed = 1; seed <= 2; seed++) {
        Meander *m = meander_new(40.0, 4000.0, 0.3, seed, &e);
        assert_non_null(m);
        m->contrast = 0.5;
        m->reach = 900.0;
        for (int part = 0; part < 10; part++) {
            assert_true(meander_run(m, 20.0, &run, &e));
            assert_int_equal(meander_crossings(m), 0);
        }
        double sinuosity = meander_sinuosity(m), wavelength = meander_wavelength(m);
        print_message("sinuosity %.2f, wavelength %.1f widths, %d oxbows\n", sinuosity, wavelength,
                      (int)m->oxbows);
        assert_true(sinuosity > 1.3 && sinuosity < 4.0);
        assert_true(m->oxbows > 0);
        meander_free(m);
    }
}

static void threads_do_not_change_the_land(void **state)
{
    (void)state;
    TerrainParams params = terrain_params_default();
    params.form = TERRAIN_MEANDER;
    params.resolution = 64;
    params.meander.age = 0.3f;
    HeightField *first = make_heights(&params, 5, 1, NULL, NULL);
    size_t bytes = (size_t)height_field_count(first) * sizeof(float);
    for (int threads = 2; threads <= 3; threads++) {
        HeightField *field = make_heights(&params, 5, threads, NULL, NULL);
        assert_memory_equal(first->height, field->height, bytes);
        assert_memory_equal(first->age, field->age, bytes);
        assert_memory_equal(first->water, field->water, bytes);
        height_field_free(field);
    }
    height_field_free(first);
}

// The river does not know the grid: samples that two grids share have the same height, at sizes
// whose cells are exact in binary.
static void a_finer_grid_shows_the_same_land(void **state)
{
    (void)state;
    enum { CELLS = 128 };
    TerrainParams params = terrain_params_default();
    params.form = TERRAIN_MEANDER;
    params.size = 4096.0f;
    params.meander.width = 100.0f;
    HeightField *field[2];
    for (int k = 0; k < 2; k++) {
        params.resolution = CELLS << k;
        field[k] = make_heights(&params, 5, 0, NULL, NULL);
    }
    for (int64_t row = 0; row <= CELLS; row++) {
        for (int64_t column = 0; column <= CELLS; column++) {
            float coarse = field[0]->height[row * (CELLS + 1) + column];
            float fine = field[1]->height[2 * row * (2 * CELLS + 1) + 2 * column];
            assert_true(coarse == fine);
        }
    }
    height_field_free(field[0]);
    height_field_free(field[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(small_waves_grow_as_the_closed_form),
        cmocka_unit_test(a_finer_grid_shows_the_same_land),
        cmocka_unit_test(threads_do_not_change_the_land),
        cmocka_unit_test(a_grown_river_winds_and_never_crosses_itself),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
