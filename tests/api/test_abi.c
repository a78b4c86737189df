// The structs of ramify.h lie in memory as programs compiled before know them. Whoever changes one
// of these numbers counts SONAME in the Makefile up, so that the loader keeps old programs off.
#include "ramify.h"
#include "testing.h"

#define STRUCT(type, last, size, offset)                        \
    {                                                           \
#type, sizeof(type), size, offsetof(type, last), offset \
    }

static void structs_lie_as_before(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        size_t size, wanted_size, last, wanted_last; // bytes; last: where the last member begins
    } structs[] = {
        STRUCT(RamifyError, message, 1036, 268),
        STRUCT(RamifyRun, user, 40, 32),
        STRUCT(RamifySceneInfo, memory, 88, 80),
        STRUCT(RamifyObjectInfo, instances, 56, 48),
        STRUCT(RamifyTarget, high, 32, 24),
        STRUCT(RamifyLandInfo, hash, 40, 32),
        STRUCT(RamifyMeasure, high, 40, 32),
        STRUCT(RamifyRange, logarithmic, 32, 24),
        STRUCT(RamifyFitOptions, user, 40, 32),
        STRUCT(RamifyFitInfo, cancelled, 24, 20),
        STRUCT(RamifyEvaluation, failure, 32, 24),
        STRUCT(RamifyWorldInfo, mesh_seconds, 56, 48),
        STRUCT(RamifyPart, variations, 120, 112),
        STRUCT(RamifyExportOptions, tube_sides, 24, 20),
        STRUCT(RamifyExportReport, bytes, 48, 40),
        STRUCT(RamifyRenderInfo, samples, 40, 32),
        STRUCT(RamifyEstimate, write_seconds, 56, 48),
        STRUCT(RamifyPathStep, light, 96, 80),
        STRUCT(RamifyLimits, max_failing, 24, 16),
        STRUCT(RamifyDifference, message, 376, 120),
        STRUCT(RamifyGoldenScene, seconds, 56, 48),
        STRUCT(RamifyGoldenOptions, memory, 80, 72),
        STRUCT(RamifyGoldenCounts, orphans, 24, 20),
        STRUCT(RamifyKeys, value, 136, 8),
        STRUCT(RamifyTurntable, checkpoint, 608, 600),
        STRUCT(RamifyTurntableInfo, video_seconds, 88, 80),
    };
    for (size_t i = 0; i < sizeof structs / sizeof structs[0]; i++) {
        if (structs[i].size != structs[i].wanted_size ||
            structs[i].last != structs[i].wanted_last) {
            fail_msg("%s: %zu bytes, the last member at %zu; it was %zu and %zu", structs[i].name,
                     structs[i].size, structs[i].last, structs[i].wanted_size,
                     structs[i].wanted_last);
        }
    }
}

// Programs hand {0} in for "as usual", so every first choice is 0.
static void zero_is_the_usual_way(void **state)
{
    (void)state;
    assert_int_equal(RAMIFY_OK, 0);
    assert_int_equal(RAMIFY_INSTANCES_AUTO, 0);
    assert_int_equal(RAMIFY_COLORS_ALL, 0);
    assert_int_equal(RAMIFY_GOLDEN_AS_SCENE, 0);
    assert_int_equal(RAMIFY_EASE_USUAL, 0);
    assert_int_equal(RAMIFY_UNTIL_TARGETS, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(structs_lie_as_before),
        cmocka_unit_test(zero_is_the_usual_way),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
