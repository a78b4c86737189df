// Golden images: every tests/golden/NAME.yaml is rendered, pinned to one instruction set, and
// compared with NAME.png. RAMIFY_GOLDEN=update in the environment stores what was rendered. A
// failure writes build/golden/NAME.html, one page with the two pictures, their amplified difference
// and the numbers. Changed scenes must differ from the stored image, or the comparison means
// nothing; other instruction sets must not.
#include "golden/golden_report.h"
#include "image/compare.h"
#include "image/tonemap.h"
#include "render/renderer.h"
#include "scene/build.h"
#include "testing.h"

#include <glob.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

// Images of one instruction set are equal to the last bit on one machine. Other instruction sets
// and mathematical libraries move last bits, by which rare paths meet another triangle: measured
// over these scenes, RMSE up to 0.00026 of the display range and 0.016 % of pixels off by more than
// three of 255 steps. Small changes of a scene (below) come to RMSE 0.0009 and more.
#define THRESHOLD 0.012
#define MOST_FAILING 0.0008
#define MOST_RMSE 0.0007

#define PINNED "sse4.2"

static Image *film_image(const Film *film)
{
    Image *image = image_new(film->width, film->height, 3, NULL);
    assert_non_null(image);
    for (int64_t i = 0; i < (int64_t)film->width * film->height; i++) {
        memcpy(image->pixel + 3 * i, &film->color[i], sizeof(Vec3));
    }
    return image;
}

// set: one override, or NULL. The picture in display values, before they become 8 bits.
static Image *render(const char *name, const char *set, const char *isa, int threads)
{
    char file[256];
    snprintf(file, sizeof file, "tests/golden/%s.yaml", name);
    Error e = {0};
    Run run = run_default();
    run.threads = threads;
    Scene *scene = scene_read(file, &set, set ? 1 : 0, &e);
    World *world = scene ? scene_build(scene, &run, NULL, &e) : NULL;
    Renderer *renderer = world ? renderer_new(world, isa, &run, &e) : NULL;
    Film *film = renderer ? film_new(world->film.width, world->film.height, &e) : NULL;
    RenderStats stats;
    if (!film || !renderer_render(renderer, film, &run, NULL, NULL, &stats, &e)) {
        fail_msg("%s: %s", file, e.message);
    }
    Image *linear = film_image(film);
    Image *shown = tone_map(linear, &scene->tone, &e);
    assert_non_null(shown);
    image_free(linear);
    film_free(film);
    renderer_free(renderer);
    world_free(world);
    scene_free(scene);
    return shown;
}

static Image *read_png(const char *png)
{
    Error e = {0};
    Image *image = image_read(png, &e);
    if (!image) {
        fail_msg("%s", e.message);
    }
    return image;
}

// The image as a PNG file gives it back: 8 bits, dithered as the stored one is. Takes image.
static Image *developed(Image *image, char png[64])
{
    Error e = {0};
    strcpy(png, "/tmp/ramify_golden_XXXXXX.png");
    int file = mkstemps(png, 4);
    assert_true(file >= 0);
    close(file);
    if (!image_write_display(png, image, NULL, &e)) {
        fail_msg("%s", e.message);
    }
    image_free(image);
    return read_png(png);
}

static bool alike(const ImageDifference *d)
{
    return d->rmse <= MOST_RMSE && d->failing <= MOST_FAILING;
}

static ImageDifference difference_of(const char *name, const Image *ours, const Image *stored)
{
    Error e = {0};
    ImageDifference d;
    if (!image_compare(ours, stored, THRESHOLD, &d, &e)) {
        fail_msg("%s: %s; RAMIFY_GOLDEN=update stores a new one", name, e.message);
    }
    return d;
}

static bool updating(void)
{
    const char *mode = getenv("RAMIFY_GOLDEN");
    return mode && strcmp(mode, "update") == 0;
}

// Compares with the stored image; takes image. Where they should be alike and are not, a report
// says in what.
static ImageDifference compare_with_stored(const char *name, Image *image, bool report)
{
    char stored_png[512], png[64];
    snprintf(stored_png, sizeof stored_png, "tests/golden/%s.png", name);
    Image *ours = developed(image, png), *stored = read_png(stored_png);
    ImageDifference d = difference_of(name, ours, stored);
    if (report && !alike(&d)) {
        golden_report(name, png, stored_png, ours, stored, &d, THRESHOLD);
    }
    image_free(ours);
    image_free(stored);
    unlink(png);
    return d;
}

static void expect_alike(const char *name, const char *what, const ImageDifference *d)
{
    if (!alike(d)) {
        fail_msg("%s%s differs: RMSE %.5f (most %.5f), %.3f %% of pixels over %.3f (most %.3f %%); "
                 "see build/golden/%s.html",
                 name, what, d->rmse, MOST_RMSE, 100.0 * d->failing, THRESHOLD,
                 100.0 * MOST_FAILING, name);
    }
}

static void golden(void **state)
{
    const char *name = *state;
    Image *ours = render(name, NULL, PINNED, 2);
    if (updating()) {
        char png[512];
        Error e = {0};
        snprintf(png, sizeof png, "tests/golden/%s.png", name);
        assert_true(image_write_display(png, ours, NULL, &e));
    }
    ImageDifference d = compare_with_stored(name, ours, true);
    expect_alike(name, "", &d);
}

static void the_bits_are_the_same_for_any_threads(void **state)
{
    (void)state;
    Image *one = render("twigs", NULL, PINNED, 1), *three = render("twigs", NULL, PINNED, 3);
    size_t values = 3 * (size_t)one->width * (size_t)one->height;
    assert_memory_equal(one->pixel, three->pixel, values * sizeof *one->pixel);
    image_free(one);
    image_free(three);
}

static void small_changes_are_seen(void **state)
{
    (void)state;
    static const char *const changes[][2] = {{"cut_shape", "sky.sun_azimuth=82"},
                                             {"environment", "sky.rotation=31"},
                                             {"materials", "materials.matt.roughness=0.8"},
                                             {"materials", "materials.coated.roughness=0.3"},
                                             {"twigs", "camera.aperture=0.21"},
                                             {"bodies", "materials.flesh.anisotropy=0.6"},
                                             {"glow_in_fog", "medium.falloff=1.6"},
                                             {"underwater", "medium.height=4.1"}};
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++) {
        Image *changed = render(changes[i][0], changes[i][1], PINNED, 2);
        ImageDifference d = compare_with_stored(changes[i][0], changed, false);
        if (alike(&d)) {
            fail_msg("%s with %s passes for unchanged: RMSE %.5f, %.3f %% of pixels", changes[i][0],
                     changes[i][1], d.rmse, 100.0 * d.failing);
        }
    }
}

static void other_instruction_sets_draw_the_same(void **state)
{
    (void)state;
    static const char *const names[] = {"cut_shape", "twigs"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        ImageDifference d = compare_with_stored(names[i], render(names[i], NULL, NULL, 2), true);
        expect_alike(names[i], " on this machine's best instruction set", &d);
    }
}

static char *scene_name(const char *path)
{
    const char *name = strrchr(path, '/') + 1;
    return strndup(name, strcspn(name, "."));
}

int main(void)
{
    static const struct CMUnitTest more[] = {
        cmocka_unit_test(the_bits_are_the_same_for_any_threads),
        cmocka_unit_test(small_changes_are_seen),
        cmocka_unit_test(other_instruction_sets_draw_the_same),
    };
    enum { MORE = sizeof more / sizeof more[0] };
    glob_t found;
    if (glob("tests/golden/*.yaml", 0, NULL, &found) != 0) {
        fprintf(stderr, "no scenes in tests/golden (run from the top of the repository)\n");
        return 1;
    }
    size_t count = found.gl_pathc;
    struct CMUnitTest *tests = calloc(count + MORE, sizeof *tests);
    if (!tests) {
        return 1;
    }
    for (size_t i = 0; i < count; i++) {
        char *name = scene_name(found.gl_pathv[i]);
        tests[i] = (struct CMUnitTest){.name = name, .test_func = golden, .initial_state = name};
    }
    memcpy(tests + count, more, sizeof more);
    int failed = _cmocka_run_group_tests("golden", tests, count + MORE, NULL, NULL);
    for (size_t i = 0; i < count; i++) {
        free(tests[i].initial_state);
    }
    free(tests);
    globfree(&found);
    return failed;
}
