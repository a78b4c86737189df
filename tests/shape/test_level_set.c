// A level set that is being smoothed stops within a step when it is cancelled.
#include "shape/level_set.h"
#include "testing.h"

#include <math.h>
#include <pthread.h>
#include <time.h>

#define VOXEL 0.01f

static double ball(const void *shape, Vec3 p, double *bound)
{
    (void)shape;
    double distance = (double)vec3_length(p) - 1.0;
    *bound = fabs(distance);
    return distance;
}

static LevelSet *make_ball(const Run *run)
{
    Error e = {0};
    Aabb box = {vec3(-1, -1, -1), vec3(1, 1, 1)};
    LevelSet *set =
        level_set_from_distance(ball, NULL, box, (LevelSetFrame){vec3(0, 0, 0), VOXEL}, run, &e);
    if (!set) {
        fail_msg("%s", e.message);
    }
    return set;
}

typedef struct Timer {
    volatile int cancelled;
    double seconds;
} Timer;

static void *cancel_later(void *user)
{
    Timer *timer = user;
    struct timespec pause = {.tv_nsec = (long)(timer->seconds * 1e9)};
    nanosleep(&pause, NULL);
    timer->cancelled = 1;
    return NULL;
}

// Seconds of one step of smoothing. timer: cancels it; NULL = it must end well.
static double smooth_once(Timer *timer)
{
    Error e = {0};
    Run run = run_default();
    LevelSet *set = make_ball(&run);
    pthread_t thread;
    run.cancelled = timer ? &timer->cancelled : NULL;
    double start = run_seconds();
    if (timer) {
        assert_int_equal(pthread_create(&thread, NULL, cancel_later, timer), 0);
    }
    bool done = level_set_smooth(set, 1, &run, &e);
    double end = run_seconds();
    if (timer) {
        assert_int_equal(pthread_join(thread, NULL), 0);
        assert_true(done || e.code == ERROR_CANCELLED);
    } else {
        assert_true(done);
    }
    level_set_free(set);
    return end - start;
}

// Compared with the time of a whole step; a busy machine gets several chances.
static void smoothing_stops_within_a_step(void **state)
{
    (void)state;
    double whole = fmin(smooth_once(NULL), smooth_once(NULL)), least = INFINITY;
    for (int i = 0; i < 10 && least > 0.6 * whole; i++) {
        Timer timer = {.seconds = 0.1 * whole};
        least = fmin(least, smooth_once(&timer));
    }
    assert_true(least <= 0.6 * whole);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(smoothing_stops_within_a_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
