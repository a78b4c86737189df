// Fits through the C API: the search and what it tells, files, cancellation, refusals.
#include "ramify.h"
#include "testing.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define HEIGHT "objects.weed.lsystem.height"

// The height of the weed is its key's, so that fits are quick and their end is known.
static const char text[] = "objects: # a weed\n"
                           "  - {name: weed, lsystem: {height: 12, generations: 3}}\n"
                           "targets: [{object: weed, measure: height, low: 6, high: 7}]\n";

// The scene is loaded before each test and freed after it.
static int load(void **state)
{
    *state = ramify_scene_load_text(text, strlen(text), "fit", "", NULL, 0, NULL);
    return *state == NULL;
}

static int unload(void **state)
{
    ramify_scene_free(*state);
    return 0;
}

static const RamifyRange height = {HEIGHT, 2.0, 20.0, 0};

// Counts the calls; each sees the evaluations so far.
static void count_calls(void *user, const RamifyFit *fit)
{
    RamifyFitInfo info;
    ramify_fit_info(fit, &info);
    assert_int_equal(info.evaluation_count, ++*(int *)user);
}

static void fits_meet_targets(void **state)
{
    int calls = 0;
    const RamifyFitOptions options = {
        .ranges = &height, .range_count = 1, .evaluated = count_calls, .user = &calls};
    RamifyError error = {0};
    RamifyFit *fit = ramify_fit(*state, &options, NULL, &error);
    if (!fit) {
        fail_msg("%s", error.message);
    }
    RamifyFitInfo info;
    RamifyEvaluation first, best;
    ramify_fit_info(fit, &info);
    ramify_fit_evaluation(fit, 0, &first);
    ramify_fit_evaluation(fit, info.best, &best);
    assert_true(info.met && !info.cancelled);
    assert_int_equal(info.evaluation_count, calls);
    assert_int_equal(info.best, calls - 1); // it stops there
    assert_int_equal(info.range_count, 1);
    assert_int_equal(info.target_count, 1);
    assert_true(fabs(first.parameters[0] - 12.0) < 1e-3); // the scene's own
    assert_true(first.misfit > 0.0 && best.misfit == 0.0);
    assert_true(best.measures[0] >= 6.0 && best.measures[0] <= 7.0);
    assert_null(best.failure);
    ramify_fit_free(fit);
    ramify_fit_free(NULL);
}

static void fits_are_written_and_drawn(void **state)
{
    char scene_file[] = "/tmp/ramify_fit_XXXXXX", picture[] = "/tmp/ramify_way_XXXXXX";
    assert_true(close(mkstemp(scene_file)) == 0 && close(mkstemp(picture)) == 0);
    const RamifyFitOptions options = {
        .ranges = &height, .range_count = 1, .evaluations = 3, .until = RAMIFY_UNTIL_EVALUATIONS};
    RamifyFit *fit = ramify_fit(*state, &options, NULL, NULL);
    assert_non_null(fit);
    RamifyFitInfo info;
    ramify_fit_info(fit, &info);
    assert_int_equal(info.evaluation_count, 3);
    bool whole = false;
    assert_true(ramify_fit_write(fit, scene_file, &whole, NULL));
    assert_true(whole);
    assert_true(ramify_fit_draw(fit, picture, NULL));
    RamifyScene *fitted = ramify_scene_load(scene_file, NULL, 0, NULL);
    assert_non_null(fitted);
    assert_non_null(strstr(ramify_scene_text(fitted), "objects: # a weed\n"));
    ramify_scene_free(fitted);
    RamifyError error = {0};
    assert_false(ramify_fit_write(fit, "/nowhere/fit.yaml", NULL, &error));
    assert_int_equal(error.code, RAMIFY_IO);
    assert_false(ramify_fit_draw(fit, "/nowhere/way.svg", &error));
    assert_int_equal(error.code, RAMIFY_IO);
    ramify_fit_free(fit);
    unlink(scene_file);
    unlink(picture);
}

static void cancel(void *user, const RamifyFit *fit)
{
    (void)fit;
    *(volatile int *)user = 1;
}

static void a_cancelled_fit_keeps_what_it_found(void **state)
{
    volatile int stop = 0;
    const RamifyFitOptions options = {
        .ranges = &height, .range_count = 1, .evaluated = cancel, .user = (void *)&stop};
    const RamifyRun run = {.cancelled = &stop};
    RamifyFit *fit = ramify_fit(*state, &options, &run, NULL);
    assert_non_null(fit);
    RamifyFitInfo info;
    ramify_fit_info(fit, &info);
    assert_true(info.cancelled && !info.met);
    assert_int_equal(info.evaluation_count, 1);
    assert_int_equal(info.best, 0);
    ramify_fit_free(fit);
}

static void bad_options_are_refused(void **state)
{
    const RamifyRange unknown = {"objects.weed.lsystem.hight", 2.0, 20.0, 0},
                      empty = {HEIGHT, 20.0, 2.0, 0}, unnamed = {NULL, 2.0, 20.0, 0};
    const struct {
        RamifyFitOptions options;
        const char *said;
    } wrong[] = {
        {{.range_count = 0}, "0 ranges to search"},
        {{.range_count = -1}, "-1 ranges to search"},
        {{.ranges = &height, .range_count = INT_MAX}, "2147483647 ranges to search"},
        {{.ranges = &unknown, .range_count = 1}, "did you mean 'height'"},
        {{.ranges = &empty, .range_count = 1}, "must be below its high one"},
        {{.ranges = &unnamed, .range_count = 1}, "range 0 has no path"},
        {{.ranges = &height, .range_count = 1, .evaluations = -1}, "-1 evaluations"},
        {{.ranges = &height, .range_count = 1, .until = 2}, "until is 2"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        RamifyError error = {0};
        assert_null(ramify_fit(*state, &wrong[i].options, NULL, &error));
        assert_int_equal(error.code, RAMIFY_BAD_INPUT);
        if (!strstr(error.message, wrong[i].said)) {
            fail_msg("'%s' and not '%s'", error.message, wrong[i].said);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(fits_meet_targets, load, unload),
        cmocka_unit_test_setup_teardown(fits_are_written_and_drawn, load, unload),
        cmocka_unit_test_setup_teardown(a_cancelled_fit_keeps_what_it_found, load, unload),
        cmocka_unit_test_setup_teardown(bad_options_are_refused, load, unload),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
