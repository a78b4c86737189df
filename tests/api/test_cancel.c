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
    int reports, at; // at < 0: never
    char stage[40];  // of that report
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

static void cancel_at_first_trace(void *user, const char *stage, double done)
{
    Moment *moment = user;
    (void)done;
    moment->cancelled = moment->cancelled || strcmp(stage, "trace") == 0;
}

// Does denoising change the picture of the cropped ground, traced until `moment` cancels it?
static bool denoising_matters(const char *crop, Moment *moment, int *samples)
{
    char sheet[300];
    int length = snprintf(sheet, sizeof sheet,
                          "film: {width: %d, height: %d, crop: %s}\n"
                          "render: {samples: 2}\n"
                          "objects: [{name: ground, ground: {}}]\n",
                          WIDTH, HEIGHT, crop);
    RamifyError error = {0};
    RamifyRun run = {.threads = 1, .cancelled = &moment->cancelled, .user = moment};
    RamifyRenderInfo info = {0};
    static float plain[4 * WIDTH * HEIGHT], clean[4 * WIDTH * HEIGHT];
    RamifyScene *scene =
        ramify_scene_load_text(sheet, (size_t)length, "sheet", "", NULL, 0, &error);
    RamifyWorld *world = scene ? ramify_build(scene, &run, &error) : NULL;
    RamifyRenderer *renderer = world ? ramify_renderer_new(world, NULL, &run, &error) : NULL;
    RamifyFilm *film = ramify_film_new(WIDTH, HEIGHT, &error);
    run.progress = moment->at < 0 ? NULL : cancel_at_first_trace;
    if (!renderer || !film ||
        !ramify_renderer_render(renderer, film, NULL, NULL, &run, &info, &error) ||
        !ramify_film_develop(film, scene, false, plain, NULL, &error) ||
        !ramify_film_develop(film, scene, true, clean, NULL, &error)) {
        fail_msg("%s", error.message);
    }
    *samples = info.samples;
    ramify_film_free(film);
    ramify_renderer_free(renderer);
    ramify_world_free(world);
    ramify_scene_free(scene);
    bool differ = false;
    for (int i = 0; i < 4 * WIDTH * HEIGHT; i++) {
        differ = differ || plain[i] != clean[i];
    }
    return differ;
}

// One thread reports after its first tile of 16 x 16 pixels.
static void incomplete_pictures_are_not_denoised(void **state)
{
    (void)state;
    static const struct {
        const char *crop;
        int at, samples;
        bool denoised;
    } cases[] = {{"[0, 0, 1, 1]", 0, 0, false},
                 {"[0, 0, 1, 1]", -1, 2, true},
                 {"[0, 0, 0.6, 1]", 0, 1, true}, // all of the crop in one tile
                 {"[0.1, 0, 0.9, 1]", 0, 0, false}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        Moment moment = {.at = cases[i].at};
        int samples = -1;
        bool denoised = denoising_matters(cases[i].crop, &moment, &samples);
        assert_int_equal(samples, cases[i].samples);
        assert_int_equal(denoised, cases[i].denoised);
    }
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
        cmocka_unit_test(incomplete_pictures_are_not_denoised),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
