// The parts of a fit: the search finds minima of functions that are known, parameters round as
// they should, the misfit is what fit.h says.
#include "fit/fit.h"
#include "fit/misfit.h"
#include "fit/search.h"
#include "testing.h"

#include <math.h>
#include <string.h>

static void assert_near(double value, double wanted)
{
    assert_true(fabs(value - wanted) < 1e-12);
}

// ---- search

typedef struct Valley {
    int dimensions, calls;
    double best;
    double steps; // 0 = smooth; else the first coordinate counts in such steps
    double noise; // amplitude
    int stop_at;  // call that ends the search; 0 = none
} Valley;

// A paraboloid with its minimum at 0.3, 0.43, 0.56, ...
static bool valley(void *user, const double *x, double *value, int *spent)
{
    Valley *v = user;
    *value = 0.0;
    for (int i = 0; i < v->dimensions; i++) {
        assert_true(x[i] >= 0.0 && x[i] <= 1.0);
        double at = i == 0 && v->steps > 0.0 ? floor(x[i] * v->steps) / v->steps : x[i];
        double d = at - (0.3 + 0.13 * i);
        *value += d * d + v->noise * sin(1e4 * x[i]);
    }
    v->best = v->calls == 0 || *value < v->best ? *value : v->best;
    *spent = ++v->calls;
    return v->calls != v->stop_at;
}

static Valley search_valley(Valley v, int evaluations)
{
    double start[] = {0.9, 0.9, 0.9}, least[] = {v.steps > 0.0 ? 1.0 / v.steps : 0.0, 0.0, 0.0};
    Search search = {.dimensions = v.dimensions,
                     .evaluations = evaluations,
                     .start = start,
                     .least = least,
                     .evaluate = valley,
                     .user = &v};
    Error e = {0};
    assert_true(search_run(&search, &e));
    return v;
}

static void search_finds_the_minimum(void **state)
{
    (void)state;
    assert_true(search_valley((Valley){.dimensions = 1}, 30).best < 1e-5);
    assert_true(search_valley((Valley){.dimensions = 2}, 60).best < 1e-4);
    assert_true(search_valley((Valley){.dimensions = 3}, 80).best < 1e-3);
    assert_true(search_valley((Valley){.dimensions = 2, .noise = 1e-3}, 60).best < 2e-3);
    // 3 of 10 steps is the minimum itself
    assert_true(search_valley((Valley){.dimensions = 2, .steps = 10.0}, 60).best < 1e-4);
}

static void search_keeps_to_its_evaluations(void **state)
{
    (void)state;
    for (int evaluations = 1; evaluations < 40; evaluations += 3) {
        assert_true(search_valley((Valley){.dimensions = 3}, evaluations).calls <= evaluations);
        assert_int_equal(search_valley((Valley){.dimensions = 3, .stop_at = evaluations}, 40).calls,
                         evaluations);
    }
}

// ---- parameters

static const char TEXT[] = "objects: [{name: oak, tree: {height: 8, crown: {lobes: 3}}}]\n"
                           "targets: [{object: oak, measure: height, low: 1, high: 2}]\n";

static void parameters_round(void **state)
{
    (void)state;
    char text[FIT_NUMBER_TEXT];
    FitParameter linear = {.low = 1.0, .high = 4.0},
                 factors = {.low = 1.0, .high = 100.0, .logarithmic = true},
                 whole = {.low = 1.5, .high = 4.0, .whole = true};
    assert_true(fit_parameter_value(&linear, 0.12345678, text) == 1.3704);
    assert_string_equal(text, "1.3704");
    assert_true(fit_parameter_value(&linear, 1.0, text) == 4.0);
    assert_true(fit_parameter_value(&factors, 0.5, text) == 10.0);
    assert_true(fit_parameter_value(&factors, 0.25, text) == 3.1623);
    // three whole numbers, each a third of the range
    assert_true(fit_parameter_value(&whole, 0.0, text) == 2.0);
    assert_true(fit_parameter_value(&whole, 0.34, text) == 3.0);
    assert_true(fit_parameter_value(&whole, 1.0, text) == 4.0);
    assert_string_equal(text, "4");
}

static void parameters_know_their_keys(void **state)
{
    (void)state;
    Error e = {0};
    Arena *arena = arena_new(&e);
    Scene *scene = scene_read_text(TEXT, strlen(TEXT), "t", "", NULL, 0, &e);
    assert_non_null(scene);
    FitParameter p;
    FitRange height = {"objects.oak.tree.height", 4.0, 12.0, false};
    FitRange lobes = {"objects.0.tree.crown.lobes", 1.0, 8.0, false};
    assert_true(fit_parameter_read(scene, &height, arena, &p, &e));
    assert_false(p.whole);
    assert_true(p.start == 0.5);
    assert_true(fit_parameter_read(scene, &lobes, arena, &p, &e));
    assert_true(p.whole);
    assert_near(p.start, 2.0 / 7.0);
    FitRange none = {"objects.oak.tree.hight", 4.0, 12.0, false};
    assert_false(fit_parameter_read(scene, &none, arena, &p, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    assert_string_equal(e.file, "range objects.oak.tree.hight=4:12");
    scene_free(scene);
    arena_free(arena);
}

// ---- misfit

static void misfit_is_as_told(void **state)
{
    (void)state;
    SceneTarget both = {.low = 4.0, .high = 8.0}, least = {.low = 10.0, .high = TARGET_NO_BOUND},
                exact = {.low = 5.0, .high = 5.0};
    assert_true(misfit_of(&both, 4.0) == 0.0 && misfit_of(&both, 8.0) == 0.0);
    assert_near(misfit_of(&both, 10.0), 0.5);       // one half width outside
    assert_near(misfit_of(&both, -2.0), 9.0 / 4.0); // three of them
    assert_near(misfit_of(&least, 5.0), 0.25 / 1.5);
    assert_true(misfit_of(&least, 1e9) == 0.0);
    assert_near(misfit_of(&exact, 10.0), 0.5);
    assert_near(misfit_of(&both, (double)NAN), 100.0 / 11.0);
    assert_true(isfinite(misfit_of(&both, (double)INFINITY)));
    assert_near(misfit_from_middle(&both, 7.0), 0.25);
    assert_true(misfit_from_middle(&least, 7.0) == 0.0);
    assert_false(misfit_is_met(&both, (double)NAN));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(search_finds_the_minimum),
        cmocka_unit_test(search_keeps_to_its_evaluations),
        cmocka_unit_test(parameters_round),
        cmocka_unit_test(parameters_know_their_keys),
        cmocka_unit_test(misfit_is_as_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
