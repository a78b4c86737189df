// The form coast and the shore that makes it: retreat, platform, shelter, beach, volume, grids.
#include "land/shore.h"
#include "making_terrain.h"
#include "objects/terrain/coast.h"
#include "testing.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// ---- a shore of uniform rock

typedef struct Made {
    Landscape *land;
    Shore *shore;
} Made;

static const LandscapeRates SLOPES = {.rubble = 0.0, .repose = 0.67};

// m of land inland of the shore at a place, in a square of 800 m.
typedef double ShoreLine(double x, double z);

static double straight(double x, double z)
{
    (void)x;
    return 100.0 - z;
}

// A bay 300 m deep and 160 m wide.
static double with_bay(double x, double z)
{
    double flank = fabs(x) - 80.0, mouth = 100.0 - z, head = -200.0 - z;
    double bay = flank > head ? flank : head; // inside: negative
    return mouth < bay ? mouth : bay;
}

static Made make(int cells, ShoreLine *inland, double sand, double waves)
{
    Error e = {0};
    ShoreParams params = {.sea_z = 1,
                          .waves = waves,
                          .wave_height = 2.0,
                          .tide = 3.0,
                          .grain = 0.0004,
                          .sand = sand,
                          .speed = 100.0};
    Made made = {.land = landscape_new(cells, 800.0, NULL, &e)};
    made.shore = made.land ? shore_new(&params, made.land, &e) : NULL;
    assert_non_null(made.shore);
    for (int64_t i = 0; i < landscape_count(made.land); i++) {
        int64_t row = i / made.land->side;
        double x = made.land->corner + (double)(i % made.land->side) * made.land->cell;
        double z = made.land->corner + (double)row * made.land->cell;
        double in = inland(x, z);
        made.shore->front[i] = in;
        made.land->rock[i] = in > 0.0 ? 40.0 : shore_platform(made.shore, -in) - 2.0;
    }
    return made;
}

static void clear(Made *made)
{
    shore_free(made->shore);
    landscape_free(made->land);
}

static void wear(Made *made, double time, int threads)
{
    Error e = {0};
    Run run = run_default();
    run.threads = threads;
    int steps = 1 + (int)(time / shore_step_limit(made->shore, made->land));
    for (int k = 0; k < steps; k++) {
        if (!shore_step(made->shore, made->land, &SLOPES, time / steps, &run, &e)) {
            fail_msg("%s", e.message);
        }
    }
}

// m from the middle of the south rim to the front, along a column.
static double front_row(const Made *made, double x)
{
    const Landscape *land = made->land;
    int column = (int)((x - land->corner) / land->cell + 0.5);
    for (int row = land->side - 1; row > 0; row--) {
        double here = made->shore->front[(int64_t)row * land->side + column];
        double next = made->shore->front[(int64_t)(row - 1) * land->side + column];
        if (next > 0.0) {
            return land->corner + land->cell * (row - here / (here - next));
        }
    }
    return land->corner;
}

// On a straight shore across the waves nothing is in their way: it retreats at `speed`.
static void a_straight_shore_retreats_at_its_speed(void **state)
{
    (void)state;
    for (int cells = 128; cells <= 256; cells *= 2) {
        Made made = make(cells, straight, 0.0, 0.0);
        wear(&made, 1.5, 0);
        double at = front_row(&made, 0.0), left = front_row(&made, -300.0);
        printf("  %d cells: front at %g and %g m, by theory -50\n", cells, at, left);
        assert_true(fabs(at + 50.0) < 0.03 * 150.0 && fabs(left + 50.0) < 0.03 * 150.0);
        clear(&made);
    }
}

// What a steadily retreating cliff leaves behind: high - base ln(1 + slope x / base).
static void the_platform_has_its_profile(void **state)
{
    (void)state;
    Made made = make(256, straight, 0.0, 0.0);
    wear(&made, 1.5, 0);
    const Landscape *land = made.land;
    double foot = front_row(&made, 0.0), worst = 0.0;
    for (int row = 0; row < land->side; row++) {
        double x = land->corner + row * land->cell - foot;
        if (x > 10.0 && x < 130.0) {
            double is = land->rock[(int64_t)row * land->side + land->side / 2];
            double off = fabs(is - shore_platform(made.shore, x));
            worst = off > worst ? off : worst;
        }
    }
    printf("  platform %g m off at most, %g m at 100 m\n", worst,
           shore_platform(made.shore, 100.0));
    assert_true(worst < 0.12);
    clear(&made);
}

static void a_bay_is_sheltered(void **state)
{
    (void)state;
    Made made = make(128, with_bay, 0.0, 0.0);
    wear(&made, 0.5, 0);
    double cape = 100.0 - front_row(&made, 200.0), head = -200.0 - front_row(&made, 0.0);
    Made aside = make(128, with_bay, 0.0, 40.0); // waves that do not reach the head
    wear(&aside, 0.5, 0);
    double hidden = -200.0 - front_row(&aside, 0.0);
    printf("  capes retreat by %g m, the bay's head by %g m; by %g m under oblique waves\n", cape,
           head, hidden);
    assert_true(cape > 25.0 && head > 0.0 && head < 0.8 * cape && hidden < 0.65 * head);
    clear(&made);
    clear(&aside);
}

static double volume(const Made *made)
{
    return landscape_volume(made->land) + made->shore->pool;
}

static void no_rock_is_lost(void **state)
{
    (void)state;
    Error e = {0};
    Run run = run_default();
    Made made = make(128, with_bay, 0.05, 10.0);
    double before = volume(&made), outflow = made.land->outflow;
    wear(&made, 0.6, 0);
    double pool = made.shore->pool, fine = made.land->outflow - outflow;
    assert_true(shore_lay_beach(made.shore, made.land, &run, &e));
    double after = volume(&made), loose = 0.0;
    for (int64_t i = 0; i < landscape_count(made.land); i++) {
        loose += made.land->loose[i] * made.land->cell * made.land->cell;
    }
    printf("  of %g m^3, %g are lost; %g sand, of which %g lie on the shore\n", before,
           before - after, pool, loose);
    assert_true(fabs(after - before) < 1e-9 * fabs(before));
    assert_true(pool > 0.0 && fabs(pool / (pool + fine) - 0.05) < 1e-6);
    assert_true(loose > 0.98 * pool && loose < 1.000001 * pool);
    clear(&made);
}

// Sand gathers where the waves are weak.
static void sand_lies_in_the_bay(void **state)
{
    (void)state;
    Error e = {0};
    Run run = run_default();
    Made made = make(128, with_bay, 0.01, 0.0);
    wear(&made, 0.4, 0);
    assert_true(shore_lay_beach(made.shore, made.land, &run, &e));
    double bay = 0.0, capes = 0.0;
    for (int64_t i = 0; i < landscape_count(made.land); i++) {
        double x = made.land->corner + (double)(i % made.land->side) * made.land->cell;
        *(fabs(x) < 150.0 ? &bay : &capes) += made.land->loose[i];
    }
    printf("  %g of the sand lies in the bay\n", bay / (bay + capes));
    assert_true(bay > 0.9 * (bay + capes));
    clear(&made);
}

// Sunamura (1984): fine sand under high waves is flat, shingle steep.
static void coarse_beaches_are_steep(void **state)
{
    (void)state;
    ShoreParams sand = {.wave_height = 2.0, .grain = 0.0004}, shingle = sand;
    shingle.grain = 0.02;
    double flat = atan(shore_beach_slope(&sand, 1.0)) * 57.29578;
    double steep = atan(shore_beach_slope(&shingle, 1.0)) * 57.29578;
    printf("  sand %g degrees, shingle %g\n", flat, steep);
    assert_true(flat > 2.0 && flat < 5.0 && steep > 7.0 && steep < 13.0);
    assert_true(shore_beach_slope(&sand, 0.2) > shore_beach_slope(&sand, 1.0));
}

// ---- the form

typedef struct Grew {
    TerrainParams params;
    Grown grown;
    HeightField *field;
    MeasureList list;
} Grew;

static void grow(Grew *grew, int resolution, TerrainSide sea, int threads)
{
    *grew = (Grew){.params = terrain_params_default()};
    grew->params.form = TERRAIN_COAST;
    grew->params.size = 1000.0f;
    grew->params.relief = 70.0f;
    grew->params.resolution = resolution;
    grew->params.coast.sea = sea;
    grew->field = make_heights(&grew->params, 4, threads, &grew->list, &grew->grown);
}

static void forget(Grew *grew)
{
    measures_clear(&grew->list);
    height_field_free(grew->field);
    grown_clear(&grew->grown);
}

// Grown once for several tests.
static int grow_shared(void **state)
{
    static Grew shared;
    grow(&shared, 256, SIDE_SOUTH, 0);
    *state = &shared;
    return 0;
}

static int forget_shared(void **state)
{
    forget(*state);
    return 0;
}

static double value(const Grew *grew, const char *name)
{
    return measured(&grew->list, name);
}

static double land_share(const HeightField *field)
{
    int64_t count = height_field_count(field), land = 0;
    for (int64_t i = 0; i < count; i++) {
        land += field->height[i] > 3.0f;
    }
    return (double)land / (double)count;
}

static void the_resolution_keeps_the_coast(void **state)
{
    const Grew *fine = *state;
    Grew coarse;
    grow(&coarse, 128, SIDE_SOUTH, 0);
    double same = 0.0, all = 0.0;
    for (int row = 0; row <= 128; row++) {
        for (int column = 0; column <= 128; column++) {
            bool a = coarse.field->height[row * 129 + column] > 3.0f;
            bool b = fine->field->height[2 * row * 257 + 2 * column] > 3.0f;
            same += a == b;
            all += 1.0;
        }
    }
    printf("  %g of the samples are land, or sea, in both; land %g and %g, cliffs %g and %g m\n",
           same / all, land_share(coarse.field), land_share(fine->field),
           value(&coarse, "cliff_height"), value(fine, "cliff_height"));
    assert_true(same > 0.96 * all);
    assert_true(fabs(value(&coarse, "cliff_height") / value(fine, "cliff_height") - 1.0) < 0.25);
    forget(&coarse);
}

static void it_measures_as_coasts_do(void **state)
{
    const Grew *grew = *state;
    double steep = value(grew, "cliff_slope"), beach = value(grew, "beach_slope");
    double dimension = value(grew, "shore_dimension"), sandy = value(grew, "beach_share");
    printf("  cliffs %g m and %g degrees, beach %g degrees on %g, platform %g, dimension %g, %g "
           "stacks\n",
           value(grew, "cliff_height"), steep, beach, sandy, value(grew, "platform_slope"),
           dimension, value(grew, "stacks"));
    assert_true(value(grew, "cliff_height") > 20.0 && value(grew, "cliff_height") < 70.0);
    assert_true(steep > 45.0 && steep < 85.0);
    assert_true(beach > 2.0 && beach < 9.0);
    assert_true(dimension > 1.05 && dimension < 1.4);
    assert_true(sandy > 0.1 && sandy < 0.95);
}

// The sea lies on the side that is asked for, and reaches across the border there.
static void the_sea_lies_where_it_should(void **state)
{
    (void)state;
    static const TerrainSide sides[] = {SIDE_NORTH, SIDE_EAST, SIDE_SOUTH, SIDE_WEST};
    for (int k = 0; k < 4; k++) {
        Grew grew;
        grow(&grew, 64, sides[k], 0);
        int wet[4] = {0};
        for (int i = 0; i <= 64; i++) {
            const float *h = grew.field->height;
            wet[0] += h[i] < 0.0f;
            wet[1] += h[65 * i + 64] < 0.0f;
            wet[2] += h[65 * 64 + i] < 0.0f;
            wet[3] += h[65 * i] < 0.0f;
        }
        assert_int_equal(wet[k], 65);
        assert_int_equal(wet[(k + 2) % 4], 0);
        assert_true(wet[(k + 1) % 4] > 10 && wet[(k + 1) % 4] < 55);
        forget(&grew);
    }
}

static void threads_change_nothing(void **state)
{
    (void)state;
    Grew one, three;
    grow(&one, 128, SIDE_WEST, 1);
    grow(&three, 128, SIDE_WEST, 3);
    size_t bytes = sizeof(float) * (size_t)height_field_count(one.field);
    assert_memory_equal(one.field->height, three.field->height, bytes);
    assert_memory_equal(one.field->wetness, three.field->wetness, bytes);
    forget(&one);
    forget(&three);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_straight_shore_retreats_at_its_speed),
        cmocka_unit_test(the_platform_has_its_profile),
        cmocka_unit_test(a_bay_is_sheltered),
        cmocka_unit_test(no_rock_is_lost),
        cmocka_unit_test(sand_lies_in_the_bay),
        cmocka_unit_test(coarse_beaches_are_steep),
        cmocka_unit_test(the_resolution_keeps_the_coast),
        cmocka_unit_test(it_measures_as_coasts_do),
        cmocka_unit_test(the_sea_lies_where_it_should),
        cmocka_unit_test(threads_change_nothing),
    };
    return cmocka_run_group_tests(tests, grow_shared, forget_shared);
}
