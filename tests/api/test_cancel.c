// Cancelled at any moment of growing, building, tracing and exporting: the call ends soon with
// RAMIFY_CANCELLED, or with a picture once tracing has begun, and no file is left half.
#include "ramify.h"
#include "testing.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { WIDTH = 24, HEIGHT = 16 };

static const char text[] =
    "camera: {position: [0, 1.5, 7], target: [0, 1.4, 0]}\n"
    "film: {width: 24, height: 16}\n"
    "render: {samples: 8, max_depth: 2}\n"
    "sky: {kind: constant, color: 1}\n"
    "objects:\n"
    "  - name: bush\n"
    "    tree: {height: 3, leaves: {max_count: 40}, crown: {lobes: 0, growth: {levels: "
    "[{attractors: 60}]}}}\n"
    "  - {name: hill, terrain: {size: 500, relief: 60, resolution: 32, rivers: {count: 20}}}\n"
    "  - {name: leaf, venation: {detail: 12}}\n"
    "  - {name: twig, dla: {particles: 500}}\n";

// Cancels at report number `at`.
typedef struct Moment {
    volatile int cancelled;
    int reports, at;
    char stage[40]; // of that report
} Moment;

static void count_down(void *user, const char *stage, double done)
{
    Moment *moment = user;
    (void)done;
    if (moment->reports++ == moment->at) {
        moment->cancelled = 1;
        snprintf(moment->stage, sizeof moment->stage, "%s", stage);
    }
}

typedef bool Way(const RamifyScene *scene, const RamifyRun *run, RamifyError *error);

static bool way_render(const RamifyScene *scene, const RamifyRun *run, RamifyError *error)
{
    static float rgba[4 * WIDTH * HEIGHT];
    int samples = 0;
    bool done = ramify_render(scene, rgba, &samples, run, error);
    assert_true(!done || samples >= 0);
    return done;
}

static bool way_export(const RamifyScene *scene, const RamifyRun *run, RamifyError *error)
{
    bool done = ramify_export(scene, "x.glb", NULL, run, NULL, error);
    assert_int_equal(access("x.glb", F_OK) == 0, done);
    unlink("x.glb");
    return done;
}

static RamifyScene *load(void)
{
    RamifyError error = {0};
    RamifyScene *scene = ramify_scene_load_text(text, strlen(text), "cancel", "", NULL, 0, &error);
    if (!scene) {
        fail_msg("%s", error.message);
    }
    return scene;
}

// Cancels at report 0, 1, 2, ... with growing gaps, until the way ends before.
static void cancel_everywhere(Way *way, int least_reports)
{
    RamifyScene *scene = load();
    Moment moment;
    int at = 0;
    do {
        RamifyError error = {0};
        moment = (Moment){.at = at};
        RamifyRun run = {
            .threads = 2, .cancelled = &moment.cancelled, .progress = count_down, .user = &moment};
        bool done = way(scene, &run, &error);
        if (!done && error.code != RAMIFY_CANCELLED) {
            fail_msg("cancelled at report %d (%s): code %d, %s", at, moment.stage, error.code,
                     error.message);
        }
        if (done && moment.cancelled && strcmp(moment.stage, "trace") != 0 && way == way_render) {
            fail_msg("cancelled at report %d (%s) and nothing came of it", at, moment.stage);
        }
        at += 1 + at / 2;
    } while (moment.cancelled);
    assert_true(moment.reports > least_reports);
    ramify_scene_free(scene);
}

static void rendering(void **state)
{
    (void)state;
    cancel_everywhere(way_render, 40);
}

static void exporting(void **state)
{
    (void)state;
    cancel_everywhere(way_export, 20);
}

static int enter_folder(void **state)
{
    static char folder[] = "/tmp/ramify_cancel_XXXXXX";
    *state = folder;
    return mkdtemp(folder) ? chdir(folder) : -1;
}

static int leave_folder(void **state)
{
    char command[80];
    snprintf(command, sizeof command, "rm -rf '%s'", (const char *)*state);
    return chdir("/") || system(command);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rendering),
        cmocka_unit_test(exporting),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
