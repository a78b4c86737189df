// Meandering rivers: growth of small waves against the closed form, cutoffs, sinuosity.
#include "land/meander.h"
#include "making_terrain.h"
#include "objects/terrain/form.h"
#include "objects/terrain/meander_trace.h"
#include "testing.h"

#include <math.h>
#include <string.h>

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

// The curvature that the flow feels of a small sine follows it as a first-order lag: of amplitude
// a / sqrt(a^2 + k^2) and behind by atan(k / a), a being the decay by the width.
static void the_flow_feels_bends_late(void **state)
{
    (void)state;
    const double decay = 0.75, wavelength = 11.0, k = 6.283185307179586 / wavelength;
    Meander *m = meander_new(0.25, 4.0 * wavelength, 0.0, 1, NULL);
    assert_non_null(m);
    m->width = 1.0;
    for (int64_t i = 0; i < m->count; i++) {
        m->node[i].x = 1e-3 * sin(k * m->node[i].z);
    }
    double *bend = malloc((size_t)m->count * sizeof *bend), s = 0.0, c = 0.0;
    assert_non_null(bend);
    meander_bends(m, bend);
    for (int64_t i = 0; i < m->count; i++) {
        s += 2.0 * bend[i] * sin(k * m->node[i].z) / (double)m->count;
        c += 2.0 * bend[i] * cos(k * m->node[i].z) / (double)m->count;
    }
    double curved = 1e-3 * k * k; // where x is greatest, on the left, is the outer bank
    double lagged = curved * decay / sqrt(decay * decay + k * k);
    assert_true(fabs(sqrt(s * s + c * c) - lagged) < 0.01 * curved);
    assert_true(fabs(atan2(-c, s) - atan2(k, decay)) < 0.02);
    free(bend);
    meander_free(m);
}

// A river on its land, with the traces that the land is made of.
typedef struct Traced {
    Grown grown;
    HeightField *field;
    MeanderTrace trace;
    const Meander *m;
} Traced;

static Traced trace_river(const TerrainParams *params)
{
    Traced t = {.field = NULL};
    t.field = make_heights(params, 5, 0, NULL, &t.grown);
    t.m = ((const Terrain *)t.grown.state)->meander;
    assert_true(meander_trace_new(&t.trace, t.field, NULL));
    assert_true(meander_trace_river(&t.trace, t.m, NULL));
    return t;
}

static void free_traced(Traced *t)
{
    meander_trace_free(&t->trace);
    height_field_free(t->field);
    grown_clear(&t->grown);
}

// A river of this width, m, without a fall, in 4 km of plain.
static TerrainParams level_plain(float width)
{
    TerrainParams params = terrain_params_default();
    params.form = TERRAIN_MEANDER;
    params.size = 4096.0f;
    params.resolution = 512;
    params.meander.width = width;
    params.meander.slope = 0.0f;
    return params;
}

// In bends the outer half of the bed is deeper, and the water's edge is farther from the middle.
static void pools_lie_at_outer_banks(void **state)
{
    (void)state;
    TerrainParams params = level_plain(100.0f);
    params.meander.age = 0.5f;
    Traced t = trace_river(&params);
    double depth[2] = {0.0, 0.0};
    int64_t wet[2] = {0, 0}, all[2] = {0, 0};
    for (int64_t i = 0; i < height_field_count(t.field); i++) {
        float aside = t.trace.aside[i], bend = t.trace.bend[i];
        if (fabsf(aside) < 0.95f && fabsf(bend) > 0.15f) {
            int outer = aside * bend > 0.0f;
            depth[outer] += fmax(-(double)t.field->height[i], 0.0);
            wet[outer] += t.field->height[i] < 0.0f;
            all[outer]++;
        }
    }
    assert_true(all[0] > 500 && all[1] > 500);
    print_message("depth %.2f m at outer banks, %.2f m at bars, water on %.0f and %.0f %%\n",
                  depth[1] / (double)all[1], depth[0] / (double)all[0],
                  100.0 * (double)wet[1] / (double)all[1], 100.0 * (double)wet[0] / (double)all[0]);
    assert_true(depth[1] / (double)all[1] > 1.6 * depth[0] / (double)all[0]);
    assert_true(wet[1] * all[0] > wet[0] * all[1]);
    free_traced(&t);
}

// The curve between nodes goes through them and stays near the circle on which they lie, much
// nearer than chords, whose sagitta is radius (1 - cos(half the step)).
static void lines_are_round_between_nodes(void **state)
{
    (void)state;
    const double radius = 100.0, step = 0.35;
    MeanderNode node[4];
    for (int k = 0; k < 4; k++) {
        node[k] = (MeanderNode){radius * cos(step * (k - 1)), radius * sin(step * (k - 1))};
    }
    MeanderNode first = meander_between(node, 0.0), last = meander_between(node, 1.0);
    assert_true(first.x == node[1].x && first.z == node[1].z);
    assert_true(fabs(last.x - node[2].x) < 1e-12 && fabs(last.z - node[2].z) < 1e-12);
    double worst = 0.0;
    for (int i = 1; i < 20; i++) {
        MeanderNode p = meander_between(node, i / 20.0);
        worst = fmax(worst, fabs(sqrt(p.x * p.x + p.z * p.z) - radius));
    }
    double chord = radius * (1.0 - cos(0.5 * step));
    print_message("%.3f m from the circle, chords %.3f m\n", worst, chord);
    assert_true(worst < 0.06 * chord);
}

// A sample that is moved by a cell sees the river as the one beside it does.
static void samples_are_looked_up_where_they_are_moved(void **state)
{
    (void)state;
    TerrainParams params = level_plain(100.0f);
    params.meander.age = 0.2f;
    Traced t = trace_river(&params);
    int64_t count = height_field_count(t.field), found = 0;
    Vec2 *moved = malloc((size_t)count * sizeof *moved);
    assert_non_null(moved);
    for (int64_t i = 0; i < count; i++) {
        moved[i] = (Vec2){t.field->cell.x, 0.0f};
    }
    MeanderTrace aside;
    assert_true(meander_trace_new(&aside, t.field, NULL));
    aside.moved = moved;
    aside.most = t.field->cell.x;
    assert_true(meander_trace_river(&aside, t.m, NULL));
    for (int64_t i = 0; i < count; i++) {
        if ((i + 1) % t.field->columns != 0) {
            assert_true(aside.aside[i] == t.trace.aside[i + 1]);
            found += aside.aside[i] < INFINITY;
        }
    }
    assert_true(found > 1000);
    meander_trace_free(&aside);
    free(moved);
    free_traced(&t);
}

typedef struct Lakes {
    const HeightField *field;
    uint8_t *seen;
    int32_t *stack;
} Lakes;

// Samples of the water at sample i, all that it is joined with.
static int64_t flood_lake(Lakes *l, int64_t i)
{
    int columns = l->field->columns;
    int64_t count = 0, found = 1;
    l->stack[0] = (int32_t)i;
    l->seen[i] = 1;
    while (count < found) {
        int64_t at = l->stack[count++];
        for (int k = 0; k < 9; k++) {
            int64_t column = at % columns + k % 3 - 1, row = at / columns + k / 3 - 1;
            int64_t next = row * columns + column;
            if (column >= 0 && row >= 0 && column < columns && row < l->field->rows &&
                !l->seen[next] && l->field->height[next] < 0.0f) {
                l->seen[next] = 1;
                l->stack[found++] = (int32_t)next;
            }
        }
    }
    return count;
}

// An oxbow's water is in one piece: only the river itself, where it comes back, cuts some in two.
static void oxbows_do_not_break_into_beads(void **state)
{
    (void)state;
    TerrainParams params = level_plain(60.0f);
    Traced t = trace_river(&params);
    int64_t count = height_field_count(t.field), pieces = 0, beads = 0;
    Lakes l = {
        .field = t.field, .seen = calloc((size_t)count, 1), .stack = malloc((size_t)count * 4)};
    assert_true(l.seen && l.stack);
    for (int64_t i = 0; i < count; i++) {
        if (!l.seen[i] && t.field->height[i] < 0.0f) {
            int64_t samples = flood_lake(&l, i);
            pieces++;
            beads += samples < 56; // of a square as wide as the river
        }
    }
    int64_t open = meander_open_oxbows(t.m);
    print_message("%d oxbows, %d pieces of water, %d of them small\n", (int)open, (int)pieces,
                  (int)beads);
    assert_true(pieces >= 4 && pieces <= open + 1); // the river is one
    assert_true(beads <= open / 4);
    free(l.seen);
    free(l.stack);
    free_traced(&t);
}

// Water that heights record has a material and a roughness of its form's own; rivers that are laid
// on the land afterwards have neither.
static void forms_tell_what_their_water_is(void **state)
{
    (void)state;
    TerrainParams params = terrain_params_default();
    for (int form = 0; form <= TERRAIN_DELTA; form++) {
        params.form = (TerrainForm)form;
        const char *water = kind_terrain.material_for(&params, TERRAIN_WATER);
        const char *wanted = form == TERRAIN_BRAIDED   ? "terrain/glacial"
                             : form == TERRAIN_MEANDER ? "terrain/river"
                             : form == TERRAIN_DELTA   ? "terrain/silt"
                                                       : NULL;
        assert_true(wanted ? water && strcmp(water, wanted) == 0 : !water);
        assert_true(!water == !terrain_form(&params)->roughness);
    }
}

// The valley goes on beyond its end: the last row is the first, lower by the slope.
static void the_ends_of_the_valley_meet(void **state)
{
    (void)state;
    TerrainParams params = terrain_params_default();
    params.form = TERRAIN_MEANDER;
    params.resolution = 128;
    params.meander.age = 0.5f;
    HeightField *field = make_heights(&params, 5, 0, NULL, NULL);
    int64_t last = (int64_t)(field->rows - 1) * field->columns;
    float fall = params.meander.slope * params.size;
    for (int64_t i = 0; i < field->columns; i++) {
        assert_true(fabsf(field->height[i] - field->height[last + i] - fall) < 2e-3f);
    }
    height_field_free(field);
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
        cmocka_unit_test(the_flow_feels_bends_late),
        cmocka_unit_test(lines_are_round_between_nodes),
        cmocka_unit_test(samples_are_looked_up_where_they_are_moved),
        cmocka_unit_test(pools_lie_at_outer_banks),
        cmocka_unit_test(oxbows_do_not_break_into_beads),
        cmocka_unit_test(a_finer_grid_shows_the_same_land),
        cmocka_unit_test(forms_tell_what_their_water_is),
        cmocka_unit_test(the_ends_of_the_valley_meet),
        cmocka_unit_test(threads_do_not_change_the_land),
        cmocka_unit_test(a_grown_river_winds_and_never_crosses_itself),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
