// Keys, eases and frames' names against closed forms.
#include "testing.h"

#include "animate/keys.h"
#include "animate/pattern.h"
#include "animate/timeline.h"

#include <math.h>
#include <string.h>

static double one(Ease ease, bool loop, int count, const double *at, const double *value,
                  double time)
{
    Keys keys = {ease, loop, count, 1, at, value};
    double result;
    keys_at(&keys, time, &result);
    return result;
}

#define ASSERT_NEAR(value, wanted)                             \
    do {                                                       \
        double v_ = (value), w_ = (wanted);                    \
        if (!(fabs(v_ - w_) < 1e-12)) {                        \
            fail_msg("%s = %.15g, not %.15g", #value, v_, w_); \
        }                                                      \
    } while (0)

static void eases_are_what_they_are_called(void **state)
{
    (void)state;
    const double at[] = {0.0, 0.5, 1.0}, value[] = {1.0, 3.0, -1.0};
    for (double t = 0.0; t < 0.5; t += 0.0625) {
        double u = 2.0 * t;
        ASSERT_NEAR(one(EASE_LINEAR, false, 3, at, value, t), 1.0 + 2.0 * u);
        ASSERT_NEAR(one(EASE_SMOOTH, false, 3, at, value, t), 1.0 + 2.0 * u * u * (3.0 - 2.0 * u));
        ASSERT_NEAR(one(EASE_STEP, false, 3, at, value, t), 1.0);
    }
    for (int ease = EASE_LINEAR; ease <= EASE_SPLINE; ease++) {
        for (int i = 0; i < 3; i++) { // every ease goes through its keys
            ASSERT_NEAR(one((Ease)ease, false, 3, at, value, at[i]), value[i]);
        }
        ASSERT_NEAR(one((Ease)ease, false, 3, at, value, -0.5), 1.0);
        ASSERT_NEAR(one((Ease)ease, false, 3, at, value, 1.5), -1.0);
    }
}

static void splines_are_smooth_and_never_overshoot(void **state)
{
    (void)state;
    const double at[] = {0.0, 0.1, 0.5, 0.6, 1.0}, value[] = {0.0, 0.0, 1.0, 5.0, 5.0};
    double before = 0.0;
    for (int i = 0; i <= 10000; i++) {
        double now = one(EASE_SPLINE, false, 5, at, value, i * 1e-4);
        assert_true(now >= before - 1e-12 && now <= 5.0 + 1e-12);
        before = now;
    }
    const double h = 1e-6, key = one(EASE_SPLINE, false, 5, at, value, 0.5);
    double left = (key - one(EASE_SPLINE, false, 5, at, value, 0.5 - h)) / h;
    double right = (one(EASE_SPLINE, false, 5, at, value, 0.5 + h) - key) / h;
    assert_true(left > 1.0 && fabs(left - right) < 1e-2); // one slope on both sides of a key
    const double line[] = {0.0, 0.2, 1.0, 1.2, 2.0};
    ASSERT_NEAR(one(EASE_SPLINE, false, 5, at, line, 0.37), 0.74);
}

static void loops_close(void **state)
{
    (void)state;
    const double h = 1e-6;
    // from the last key back to the first, a whole time later
    const double at[] = {0.25, 0.75}, value[] = {0.0, 8.0};
    ASSERT_NEAR(one(EASE_LINEAR, true, 2, at, value, 0.875), 6.0);
    ASSERT_NEAR(one(EASE_LINEAR, true, 2, at, value, 0.125), 2.0);
    ASSERT_NEAR(one(EASE_LINEAR, true, 2, at, value, 7.125), 2.0);
    ASSERT_NEAR(one(EASE_STEP, true, 2, at, value, 0.125), 0.0 + 8.0);
    // the key at 1 is that at 0
    const double closed_at[] = {0.0, 0.3, 0.6, 1.0}, closed[] = {1.0, 3.0, 2.0, 1.0};
    const Ease eases[] = {EASE_LINEAR, EASE_SMOOTH, EASE_SPLINE};
    for (int i = 0; i < 3; i++) {
        assert_true(fabs(one(eases[i], true, 4, closed_at, closed, 1.0 - h) - 1.0) < 1e-4);
        ASSERT_NEAR(one(eases[i], true, 4, closed_at, closed, 1.0), 1.0);
    }
    const double wave_at[] = {0.0, 0.25, 0.5, 0.75}, wave[] = {0.0, 1.0, 2.0, 1.0};
    ASSERT_NEAR(one(EASE_SPLINE, true, 4, wave_at, wave, 0.0), 0.0);
    assert_true(fabs(one(EASE_SPLINE, true, 4, wave_at, wave, 1.0 - h)) < 1e-9); // no corner there
    // keys at both ends that differ ask for the jump
    const double ends[] = {0.0, 1.0};
    ASSERT_NEAR(one(EASE_LINEAR, true, 2, ends, ends, 0.75), 0.75);
    ASSERT_NEAR(one(EASE_LINEAR, true, 2, ends, ends, 1.0), 0.0);
}

static void vectors_go_component_by_component(void **state)
{
    (void)state;
    const double at[] = {0.0, 1.0}, value[] = {0, 10, 20, 1, 0, 40};
    Keys keys = {EASE_LINEAR, false, 2, 3, at, value};
    double v[3];
    keys_at(&keys, 0.25, v);
    ASSERT_NEAR(v[0], 0.25);
    ASSERT_NEAR(v[1], 7.5);
    ASSERT_NEAR(v[2], 25.0);
}

static void frames_have_times(void **state)
{
    (void)state;
    ASSERT_NEAR(frame_time(3, 4, true), 0.75);
    ASSERT_NEAR(frame_time(3, 4, false), 1.0);
    ASSERT_NEAR(frame_time(0, 1, true), 0.0);
    ASSERT_NEAR(frame_time(0, 1, false), 0.0);
}

static void names_come_from_patterns(void **state)
{
    (void)state;
    const struct {
        const char *pattern;
        int frame;
        const char *name;
    } good[] = {{"oak-%04d.png", 7, "oak-0007.png"},
                {"%d.exr", 12345, "12345.exr"},
                {"100%%/a%02d.jpg", 3, "100%/a03.jpg"},
                {"%09d.png", 1, "000000001.png"},
                {"%4d.png", 1, "0001.png"},
                {"%02d.png", 1234, "1234.png"}};
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        assert_true(pattern_check(good[i].pattern, NULL));
        char *name = pattern_name(good[i].pattern, good[i].frame, NULL);
        assert_string_equal(name, good[i].name);
        free(name);
    }
    const char *const bad[] = {"oak.png",  "oak-%04d-%04d.png",
                               "%s.png",   "%n%d.png",
                               "%0d.png",  "%012d.png",
                               "%-4d.png", "%ld.png",
                               "%x.png",   "%",
                               "a%",       "%04",
                               "%d%",      "%1$d.png",
                               "%*d.png",  "%.3d.png",
                               "%%d.png",  "%04i.png",
                               "",         "%+d.png"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        Error e = {0};
        assert_false(pattern_check(bad[i], &e));
        assert_int_equal(e.code, ERROR_INPUT);
        assert_non_null(strstr(e.message, "%04d"));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(eases_are_what_they_are_called),
        cmocka_unit_test(splines_are_smooth_and_never_overshoot),
        cmocka_unit_test(loops_close),
        cmocka_unit_test(vectors_go_component_by_component),
        cmocka_unit_test(frames_have_times),
        cmocka_unit_test(names_come_from_patterns),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
