// What is out of its range is refused by the C API with RAMIFY_BAD_INPUT before anything is done:
// options of films, golden images, comparisons and exports.
#include "ramify.h"
#include "testing.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const char text[] = "film: {width: 24, height: 16}\n"
                           "render: {samples: 1, max_depth: 1}\n"
                           "objects: [{name: ball, shape: {envelope: [{shape: sphere}]}}]\n";

// The scene is loaded before each test and freed after it.
static int load(void **state)
{
    *state = ramify_scene_load_text(text, strlen(text), "refusals", "", NULL, 0, NULL);
    return *state == NULL;
}

static int unload(void **state)
{
    ramify_scene_free(*state);
    return 0;
}

#define FRAMES "/tmp/ramify_refused-%d.png"

static void films(void **state)
{
    static const struct {
        RamifyTurntable turntable;
        const char *said;
    } wrong[] = {
        {{.frames = -1}, "-1 frames; there must be 1 to 1000000"},
        {{.frames = INT_MAX}, "2147483647 frames; there must be 1 to 1000000"},
        {{.frames = 3, .start = -1}, "0 frames from frame -1; neither may be negative"},
        {{.frames = 3, .count = -1}, "-1 frames from frame 0; neither may be negative"},
        {{.frames = 3, .start = 3}, "frames 3 to 2 of 3"},
        {{.frames = 3, .start = 2, .count = INT_MAX}, "frames 2 to 2147483647 of 3"},
        {{.frames = 1, .fps = (double)NAN}, "nan frames a second"},
        {{.frames = 1, .turns = (double)NAN}, "nan turns"},
        {{.frames = 1, .turns = 1e300}, "1e+300 turns"},
        {{.frames = 1, .ease = 3}, "ease 3"},
        {{.frames = 1, .dolly = {1, {(double)NAN}}}, "dolly has nan"},
        {{.frames = 1, .grow = {RAMIFY_MOST_KEYS + 1, {0}}}, "17 keys of grow"},
        {{.frames = 1, .sun = {-1, {0}}}, "-1 keys of sun"},
        {{.frames = 1, .isa = "mmx"}, "unknown instruction set 'mmx'"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        RamifyError error = {0};
        assert_false(ramify_turntable(*state, &wrong[i].turntable, FRAMES, NULL, NULL, &error));
        assert_int_equal(error.code, RAMIFY_BAD_INPUT);
        if (!strstr(error.message, wrong[i].said)) {
            fail_msg("'%s' and not '%s'", error.message, wrong[i].said);
        }
    }
    for (int frame = 0; frame < 3; frame++) {
        char file[64];
        snprintf(file, sizeof file, FRAMES, frame);
        assert_int_not_equal(access(file, F_OK), 0);
    }
}

static void moments(void **state)
{
    static const double times[] = {-0.1, 1.1, (double)NAN, (double)INFINITY};
    for (size_t i = 0; i < sizeof times / sizeof times[0]; i++) {
        RamifyError error = {0};
        assert_null(ramify_scene_at(*state, NULL, times[i], &error));
        assert_int_equal(error.code, RAMIFY_BAD_INPUT);
    }
    assert_null(ramify_scene_at_frame(*state, NULL, 72, NULL));
    assert_null(ramify_scene_at_frame(*state, NULL, -1, NULL));
    RamifyScene *then = ramify_scene_at_frame(*state, NULL, 71, NULL);
    assert_non_null(then);
    ramify_scene_free(then);
}

static void comparisons(void **state)
{
    (void)state;
    const RamifyLimits limits[] = {
        {(double)NAN, -1, -1}, {-1, (double)NAN, -1}, {-1, -1, (double)NAN}};
    RamifyDifference difference;
    for (size_t i = 0; i < sizeof limits / sizeof limits[0]; i++) {
        RamifyError error = {0};
        assert_false(ramify_compare("tests/golden/twigs.png", "tests/golden/bodies.png", &limits[i],
                                    NULL, &difference, &error));
        assert_int_equal(error.code, RAMIFY_BAD_INPUT);
        const RamifyGoldenOptions options = {.limits = &limits[i], .filter = "twigs"};
        RamifyGoldenCounts counts;
        assert_false(ramify_golden("tests/golden", &options, NULL, &counts, &error));
        assert_string_equal(error.message, "a limit is not a number; negative stands for no limit");
    }
}

static void golden_modes(void **state)
{
    (void)state;
    static const int32_t modes[] = {-1, 4, INT_MIN, INT_MAX};
    for (size_t i = 0; i < sizeof modes / sizeof modes[0]; i++) {
        const RamifyGoldenOptions options = {.mode = modes[i], .filter = "twigs"};
        RamifyGoldenCounts counts;
        RamifyError error = {0};
        assert_false(ramify_golden("tests/golden", &options, NULL, &counts, &error));
        assert_int_equal(error.code, RAMIFY_BAD_INPUT);
    }
}

static void exports(void **state)
{
    static const char file[] = "/tmp/ramify_refused.ply";
    const char *unknown = "bal";
    const RamifyExportOptions wrong[] = {
        {.tube_sides = -1}, {.tube_sides = 2},    {.tube_sides = 65},
        {.instances = 4},   {.instances = -1},    {.colors = 4},
        {.colors = -1},     {.object_count = -1}, {.objects = &unknown, .object_count = 1}};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        RamifyError error = {0};
        assert_false(ramify_export(*state, file, &wrong[i], NULL, NULL, &error));
        assert_int_equal(error.code, RAMIFY_BAD_INPUT);
        assert_int_not_equal(access(file, F_OK), 0);
    }
}

static void sizes_of_films(void **state)
{
    (void)state;
    RamifyError error = {0};
    assert_null(ramify_film_new(0, 1, &error));
    assert_int_equal(error.code, RAMIFY_BAD_INPUT);
    assert_null(ramify_film_new(5, -1, &error));
    assert_null(ramify_film_new(INT_MAX, INT_MAX, &error));
    assert_int_equal(error.code, RAMIFY_MEMORY);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(films, load, unload),
        cmocka_unit_test_setup_teardown(moments, load, unload),
        cmocka_unit_test(comparisons),
        cmocka_unit_test(golden_modes),
        cmocka_unit_test_setup_teardown(exports, load, unload),
        cmocka_unit_test(sizes_of_films),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
