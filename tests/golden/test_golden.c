// Our own golden images: every tests/golden/NAME.yaml is rendered, pinned to one instruction set,
// and compared with NAME.png, as `ramify golden tests/golden` does; with --update that stores new
// ones. A failure writes build/golden/NAME.html. Changed scenes must differ from the stored image,
// or the comparison means nothing; other instruction sets must not.
#include "golden/golden.h"
#include "golden/pinned.h"
#include "golden/report.h"
#include "render/film.h"
#include "testing.h"

#include <glob.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

static Run two_threads(void)
{
    Run run = run_default();
    run.threads = 2;
    return run;
}

// ---- as they are stored

static void write_report(const char *name, const GoldenResults *results)
{
    char page[256];
    mkdir("build", 0777);
    mkdir("build/golden", 0777);
    snprintf(page, sizeof page, "build/golden/%s.html", name);
    assert_true(report_write(page, name, "ours", "stored", results, NULL));
}

static void expect_alike(const char *name, const char *isa)
{
    GoldenOptions options = golden_options_default();
    options.filter = name;
    options.isa = isa;
    options.pictures = true;
    Run run = two_threads();
    GoldenResults results;
    Error e = {0};
    if (!golden_run("tests/golden", &options, &run, &results, &e)) {
        fail_msg("%s", e.message);
    }
    assert_int_equal(results.count, 1);
    if (results.item[0].status != GOLDEN_ALIKE) {
        write_report(name, &results);
        fail_msg("%s on %s is %s: %s; see build/golden/%s.html", name, isa ? isa : "its best",
                 golden_status_name(results.item[0].status), results.item[0].message, name);
    }
    golden_results_clear(&results);
}

static void golden(void **state)
{
    expect_alike(*state, PINNED_ISA);
}

static void other_instruction_sets_draw_the_same(void **state)
{
    (void)state;
    expect_alike("cut_shape", NULL);
    expect_alike("twigs", NULL);
}

// ---- what must differ

static Scene *read_scene(const char *name, const char *change)
{
    char file[256];
    Error e = {0};
    snprintf(file, sizeof file, "tests/golden/%s.yaml", name);
    Scene *scene = scene_read(file, &change, change ? 1 : 0, &e);
    if (!scene) {
        fail_msg("%s: %s", file, e.message);
    }
    return scene;
}

// The picture as its PNG file would give it back.
static Image *developed(const Scene *scene, const Run *run)
{
    unsigned char *bytes = NULL;
    size_t size = 0;
    Image *linear = pinned_render(scene, PINNED_ISA, run, NULL);
    assert_non_null(linear);
    Image *shown = pinned_develop(scene, linear, NULL);
    assert_true(image_encode_png(shown, NULL, &bytes, &size, NULL));
    Image *image = image_decode_png(bytes, size, NULL);
    free(bytes);
    image_free(shown);
    image_free(linear);
    return image;
}

// The stored picture with the middle of ours: the whole of ours differs at least as much. Where
// ours was not drawn it has alpha 0, and so perhaps a channel more.
static Image *stored_around(const Image *ours, const Image *stored, const float crop[4])
{
    Image *both = image_new(stored->width, stored->height, stored->channels, NULL);
    size_t width = (size_t)stored->width, channels = (size_t)stored->channels;
    PixelBox box = film_crop_pixels(stored->width, stored->height, crop);
    assert_non_null(both);
    assert_true(ours->channels >= stored->channels);
    memcpy(both->pixel, stored->pixel,
           width * (size_t)stored->height * channels * sizeof *both->pixel);
    for (int y = box.y0; y < box.y1; y++) {
        for (int x = box.x0; x < box.x1; x++) {
            size_t at = (size_t)y * width + (size_t)x;
            memcpy(both->pixel + channels * at, ours->pixel + (size_t)ours->channels * at,
                   channels * sizeof *both->pixel);
        }
    }
    return both;
}

static void expect_different(const char *name, const char *change)
{
    static const float middle[4] = {0.3f, 0.3f, 0.7f, 0.7f};
    char stored_png[256];
    bool is_linear;
    Run run = two_threads();
    Scene *scene = read_scene(name, change);
    memcpy(scene->film.crop, middle, sizeof middle);
    snprintf(stored_png, sizeof stored_png, "tests/golden/%s.png", name);
    Image *stored = image_read_color(stored_png, &is_linear, NULL, NULL),
          *drawn = developed(scene, &run), *ours = stored_around(drawn, stored, middle);
    Limits limits = {scene->golden.max_rmse, scene->golden.threshold, scene->golden.max_failing};
    Comparison c;
    assert_true(compare_images(ours, stored, false, &limits, false, &c, NULL));
    if (c.alike) {
        fail_msg("%s with %s passes for unchanged: RMSE %.5f, %.3f %% of pixels", name, change,
                 c.difference.rmse, 100.0 * c.difference.failing);
    }
    comparison_clear(&c);
    image_free(ours);
    image_free(drawn);
    image_free(stored);
    scene_free(scene);
}

static void small_changes_are_seen(void **state)
{
    (void)state;
    static const char *const changes[][2] = {
        {"cut_shape", "sky.sun_azimuth=82"},
        {"environment", "sky.rotation=31"},
        {"materials", "materials.matt.roughness=0.8"},
        {"materials", "materials.coated.roughness=0.3"},
        {"twigs", "camera.aperture=0.21"},
        {"bodies", "materials.flesh.anisotropy=0.6"},
        {"glow_in_fog", "medium.falloff=1.6"},
        {"underwater", "medium.height=4.1"},
        {"leafy_tree", "objects.tree.tree.radii.flare=0.8"},
        {"mesh_crown", "objects.hare.tree.leaves.length=0.082"},
        {"coral", "objects.staghorn.coral.light=0.55"},
        {"dla", "objects.dendrite.dla.swell=5.2"},
        {"fracture", "objects.ball.fracture.roughness=0.014"},
        {"frost", "objects.frost.frost.angle=58"},
        {"lightning", "objects.bolt.lightning.jitter=0.105"},
        {"lsystem", "objects.written.lsystem.elasticity=0.145"},
        {"sculpture", "objects.lamp.sculpture.thickness=0.43"},
        {"terrain", "objects.range.terrain.erosion.talus=43"},
        {"venation", "objects.leaf.venation.curl=13"},
        {"vessels", "objects.kidney.vessels.exponent=2.72"}};
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++) {
        expect_different(changes[i][0], changes[i][1]);
    }
}

static void the_bits_are_the_same_for_any_threads(void **state)
{
    (void)state;
    Scene *scene = read_scene("twigs", NULL);
    Run run = run_default();
    Image *one = pinned_render(scene, PINNED_ISA, &run, NULL);
    run.threads = 3;
    Image *three = pinned_render(scene, PINNED_ISA, &run, NULL);
    size_t values = (size_t)one->channels * (size_t)one->width * (size_t)one->height;
    assert_memory_equal(one->pixel, three->pixel, values * sizeof *one->pixel);
    image_free(one);
    image_free(three);
    scene_free(scene);
}

// ---- statistics on real renderings

// A small scene, built once for all its renderings.
typedef struct Subject {
    Scene *scene;
    Pinned *pinned;
} Subject;

// Soft shadows and a glossy ball that mirrors its lamp: noise as it is. change: one override.
static Subject make_subject(const char *change)
{
    static const char text[] =
        "camera: {position: [0, 1.2, 5], target: [0, 0.5, 0], fov: 32}\n"
        "film: {width: 64, height: 44}\n"
        "render: {samples: 24, max_depth: 5}\n"
        "sky: {kind: constant, color: 0.3}\n"
        "lights: [{kind: sphere, center: [2, 2.5, 2], radius: 0.2, radiance: 60}]\n"
        "materials:\n"
        "  - {name: grey, kind: diffuse, color: 0.5}\n"
        "  - {name: mirror, kind: conductor, color: 0.9, roughness: 0.1}\n"
        "objects:\n"
        "  - {name: floor, material: grey, shape: {envelope: [{shape: box, size: [3, 0.1, 3], "
        "position: [0, -0.1, 0]}]}}\n"
        "  - {name: ball, material: mirror, shape: {envelope: [{shape: sphere, size: 0.5, "
        "position: [0.6, 0.5, 0]}]}}\n"
        "  - {name: egg, material: grey, shape: {envelope: [{shape: sphere, size: 0.5, "
        "position: [-0.6, 0.5, 0]}]}}\n";
    Error e = {0};
    Run run = two_threads();
    Subject subject = {scene_read_text(text, sizeof text - 1, "noise", "", &change, 1, &e), NULL};
    subject.pinned = subject.scene ? pinned_open(subject.scene, PINNED_ISA, &run, &e) : NULL;
    if (!subject.pinned) {
        fail_msg("%s", e.message);
    }
    return subject;
}

static void clear_subject(Subject *subject)
{
    pinned_close(subject->pinned);
    scene_free(subject->scene);
}

static NoisyPicture noisy_rendering(const Subject *subject, uint64_t series)
{
    Run run = two_threads();
    NoisyPicture picture;
    assert_true(pinned_render_noisy(subject->pinned, series, 4, &run, &picture, NULL));
    return picture;
}

static NoiseVerdict verdict_on(const NoisyPicture *stored, const Subject *subject, uint64_t series)
{
    NoisyPicture ours = noisy_rendering(subject, series);
    NoiseVerdict verdict;
    assert_true(noise_compare(&ours, stored, 0.01, &verdict, NULL, NULL));
    noisy_picture_clear(&ours);
    return verdict;
}

static void other_seeds_are_alike_but_for_noise(void **state)
{
    (void)state;
    enum { TRIALS = 50, MOST = 3 }; // 0.5 expected; more than 3 in 2 of 1000 such tests
    int alarms = 0;
    Subject subject = make_subject("render.samples=3");
    NoisyPicture stored = noisy_rendering(&subject, 0);
    for (uint64_t series = 1; series <= TRIALS; series++) {
        alarms += verdict_on(&stored, &subject, series).rejected > 0;
    }
    noisy_picture_clear(&stored);
    clear_subject(&subject);
    print_message("%d alarms in %d trials\n", alarms, TRIALS);
    assert_true(alarms <= MOST);
}

// 1 % more albedo, 3.3 % more of the lamp; a pixel's noise is many times that.
static void a_change_below_the_noise_is_found(void **state)
{
    (void)state;
    static const char *const changes[] = {"materials.grey.color=0.505", "lights.0.radiance=62"};
    Subject unchanged = make_subject("render.samples=24");
    NoisyPicture stored = noisy_rendering(&unchanged, 0);
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++) {
        Subject changed = make_subject(changes[i]);
        for (uint64_t series = 1; series <= 3; series++) {
            NoiseVerdict verdict = verdict_on(&stored, &changed, series);
            print_message("%s: p %.2g\n", changes[i], verdict.p);
            assert_true(verdict.rejected > 0);
        }
        clear_subject(&changed);
    }
    noisy_picture_clear(&stored);
    clear_subject(&unchanged);
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
        cmocka_unit_test(other_seeds_are_alike_but_for_noise),
        cmocka_unit_test(a_change_below_the_noise_is_found),
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
