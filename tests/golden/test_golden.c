// Golden images: every tests/golden/NAME.yaml is rendered, pinned to one instruction set, and
// compared with NAME.png. RAMIFY_GOLDEN=update in the environment stores what was rendered. A
// failure writes build/golden/NAME.html with the two pictures, their amplified difference and the
// numbers.
#include "image/compare.h"
#include "image/tonemap.h"
#include "render/renderer.h"
#include "scene/build.h"
#include "testing.h"

#include <glob.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

// Pixels may differ by this much of the display range; so many of them by more (rare paths that
// meet another triangle on another machine); none by much.
#define THRESHOLD 0.012
#define MOST_FAILING 0.002
#define MOST_RMSE 0.004

static Image *film_image(const Film *film)
{
    Image *image = image_new(film->width, film->height, 3, NULL);
    assert_non_null(image);
    for (int64_t i = 0; i < (int64_t)film->width * film->height; i++) {
        memcpy(image->pixel + 3 * i, &film->color[i], sizeof(Vec3));
    }
    return image;
}

static Image *render(const char *file)
{
    Error e = {0};
    Run run = run_default();
    run.threads = 2;
    Scene *scene = scene_read(file, NULL, 0, &e);
    World *world = scene ? scene_build(scene, &run, NULL, &e) : NULL;
    Renderer *renderer = world ? renderer_new(world, "sse4.2", &run, &e) : NULL;
    Film *film = world ? film_new(world->film.width, world->film.height, &e) : NULL;
    RenderStats stats;
    if (!renderer || !film || !renderer_render(renderer, film, &run, NULL, NULL, &stats, &e)) {
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

static void write_report(const char *name, const Image *ours, const Image *stored,
                         const ImageDifference *d)
{
    char path[512];
    mkdir("build", 0777);
    mkdir("build/golden", 0777);
    Image *difference = image_new(ours->width, ours->height, 3, NULL);
    for (int64_t i = 0; difference && i < (int64_t)3 * ours->width * ours->height; i++) {
        difference->pixel[i] = clampf(fabsf(ours->pixel[i] - stored->pixel[i]) * 10.0f, 0, 1);
    }
    const char *kind[3] = {"ours", "stored", "difference"};
    const Image *image[3] = {ours, stored, difference};
    snprintf(path, sizeof path, "build/golden/%s.html", name);
    FILE *page = fopen(path, "w");
    if (!page) {
        return;
    }
    fprintf(page,
            "<!doctype html><title>%s</title><h1>%s</h1><p>RMSE %.5f, largest %.4f, %.3f %% of "
            "pixels over %.3f</p>",
            name, name, d->rmse, d->maximum, 100.0 * d->failing, THRESHOLD);
    for (int i = 0; i < 3 && image[i]; i++) {
        snprintf(path, sizeof path, "build/golden/%s-%s.png", name, kind[i]);
        image_write_display(path, image[i], NULL, NULL);
        fprintf(
            page,
            "<figure><img src='%s-%s.png' "
            "style='width:640px;image-rendering:pixelated'><figcaption>%s%s</figcaption></figure>",
            name, kind[i], kind[i], i == 2 ? " x 10" : "");
    }
    fclose(page);
    image_free(difference);
}

static void compare_with_stored(const char *name, const char *png, const Image *ours)
{
    Error e = {0};
    Image *stored = image_read(png, &e);
    if (!stored) {
        fail_msg("%s", e.message);
    }
    ImageDifference d;
    if (!image_compare(ours, stored, THRESHOLD, &d, &e)) {
        fail_msg("%s: %s", png, e.message);
    }
    bool same = d.rmse <= MOST_RMSE && d.failing <= MOST_FAILING;
    if (!same) {
        write_report(name, ours, stored, &d);
    }
    image_free(stored);
    if (!same) {
        fail_msg("%s differs: RMSE %.5f, %.3f %% of pixels; see build/golden/%s.html", name, d.rmse,
                 100.0 * d.failing, name);
    }
}

static void golden(void **state)
{
    const char *file = *state;
    char name[256], png[512];
    const char *slash = strrchr(file, '/');
    snprintf(name, sizeof name, "%.*s", (int)strcspn(slash + 1, "."), slash + 1);
    snprintf(png, sizeof png, "tests/golden/%s.png", name);
    Image *ours = render(file);
    const char *mode = getenv("RAMIFY_GOLDEN");
    if (mode && strcmp(mode, "update") == 0) {
        Error e = {0};
        assert_true(image_write_display(png, ours, NULL, &e));
    } else {
        compare_with_stored(name, png, ours);
    }
    image_free(ours);
}

int main(void)
{
    glob_t found;
    if (glob("tests/golden/*.yaml", 0, NULL, &found) != 0) {
        fprintf(stderr, "no scenes in tests/golden (run from the top of the repository)\n");
        return 1;
    }
    struct CMUnitTest *tests = calloc(found.gl_pathc, sizeof *tests);
    if (!tests) {
        return 1;
    }
    for (size_t i = 0; i < found.gl_pathc; i++) {
        tests[i] = (struct CMUnitTest){
            .name = found.gl_pathv[i], .test_func = golden, .initial_state = found.gl_pathv[i]};
    }
    int failed = _cmocka_run_group_tests("golden", tests, found.gl_pathc, NULL, NULL);
    free(tests);
    globfree(&found);
    return failed;
}
