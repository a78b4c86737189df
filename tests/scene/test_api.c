// The public C API: from a text to an out-tree, a picture and a file, by ramify.h alone.
#include "ramify.h"
#include "testing.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const char text[] = "camera: {position: [0, 1.5, 7], target: [0, 1.4, 0]}\n"
                           "film: {width: 24, height: 16}\n"
                           "render: {samples: 2, max_depth: 2}\n"
                           "sky: {kind: constant, color: 1}\n"
                           "objects:\n"
                           "  - name: bush\n"
                           "    tree: {height: 3, leaves: {max_count: 0}, crown: {lobes: 0, "
                           "growth: {levels: [{attractors: 60}]}}}\n"
                           "  - {name: ball, shape: {envelope: [{shape: sphere}]}}\n";

static RamifyScene *load(void)
{
    RamifyError error = {0};
    RamifyScene *scene = ramify_scene_load_text(text, strlen(text), "api", "", NULL, 0, &error);
    if (!scene) {
        fail_msg("%s", error.message);
    }
    return scene;
}

static void a_scene_tells_what_it_holds(void **state)
{
    (void)state;
    int width, height;
    RamifyScene *scene = load();
    ramify_scene_size(scene, &width, &height);
    assert_int_equal(width, 24);
    assert_int_equal(height, 16);
    assert_int_equal(ramify_scene_object_count(scene), 2);
    assert_string_equal(ramify_scene_object_name(scene, 1), "ball");
    assert_non_null(strstr(ramify_scene_resolved(scene), "phyllotaxis"));
    assert_string_equal(ramify_version(), RAMIFY_VERSION);
    ramify_scene_free(scene);
}

static void errors_carry_their_place(void **state)
{
    (void)state;
    RamifyError error = {0};
    char message[1200];
    const char *const overrides[] = {"camera.fov=0"};
    assert_null(ramify_scene_load_text("seed: x\n", 8, "api", "", NULL, 0, &error));
    assert_int_equal(error.code, RAMIFY_BAD_INPUT);
    ramify_error_format(&error, message, sizeof message);
    assert_string_equal(message, "api:1:7: seed is 'x'; it must be a whole number");
    assert_null(ramify_scene_load_text(text, strlen(text), "api", "", overrides, 1, NULL));
    assert_null(ramify_scene_load("/nope", NULL, 0, &error));
    assert_string_equal(error.file, "/nope");
}

static void growth_gives_an_out_tree(void **state)
{
    (void)state;
    RamifyError error = {0};
    RamifyScene *scene = load();
    RamifyTree *tree = ramify_grow(scene, 0, NULL, &error);
    assert_non_null(tree);
    int64_t count = ramify_tree_count(tree);
    const int32_t *parents = ramify_tree_parents(tree);
    const float *positions = ramify_tree_positions(tree), *radii = ramify_tree_radii(tree);
    assert_true(count > 20);
    for (int64_t i = 0; i < count; i++) {
        assert_true(parents[i] < i && parents[i] >= -1);
        assert_true(radii[i] > 0.0f && isfinite(positions[3 * i + 2]));
        assert_true(ramify_tree_births(tree)[i] >= 0);
    }
    ramify_tree_free(tree);
    assert_null(ramify_grow(scene, 1, NULL, &error));
    assert_string_equal(error.message, "object 'ball' does not grow; a shape never does");
    assert_null(ramify_grow(scene, 2, NULL, &error));
    assert_int_equal(error.code, RAMIFY_BAD_INPUT);
    ramify_scene_free(scene);
}

static void count_progress(void *user, const char *stage, double done)
{
    assert_non_null(stage);
    assert_true(done >= 0.0 && done <= 1.0);
    (*(int *)user)++;
}

static void a_picture_is_traced_and_written(void **state)
{
    (void)state;
    RamifyError error = {0};
    int reports = 0, samples = 0;
    RamifyRun run = {.threads = 1, .progress = count_progress, .user = &reports};
    float first[4 * 24 * 16], second[4 * 24 * 16];
    RamifyScene *scene = load();
    assert_true(ramify_render(scene, first, &samples, &run, &error));
    assert_int_equal(samples, 2);
    assert_true(reports > 0);
    run.threads = 2;
    run.progress = NULL;
    assert_true(ramify_render(scene, second, NULL, &run, &error));
    assert_memory_equal(first, second, sizeof first);
    char png[] = "/tmp/ramify_api_XXXXXX.png", exr[64];
    int descriptor = mkstemps(png, 4);
    assert_true(descriptor >= 0);
    close(descriptor);
    assert_true(ramify_write_image(scene, first, png, &error));
    snprintf(exr, sizeof exr, "%.*s.exr", (int)strlen(png) - 4, png);
    assert_true(ramify_write_image(scene, first, exr, &error));
    assert_false(ramify_write_image(scene, first, "/nope/x.png", &error));
    assert_int_equal(error.code, RAMIFY_IO);
    assert_int_equal(unlink(png) | unlink(exr), 0);
    ramify_scene_free(scene);
}

static void cancelling_ends_early(void **state)
{
    (void)state;
    RamifyError error = {0};
    const volatile int cancelled = 1;
    RamifyRun run = {.cancelled = &cancelled};
    float rgba[4 * 24 * 16];
    RamifyScene *scene = load();
    assert_false(ramify_render(scene, rgba, NULL, &run, &error));
    assert_int_equal(error.code, RAMIFY_CANCELLED);
    ramify_scene_free(scene);
}

static void the_schema_is_handed_out(void **state)
{
    (void)state;
    char *schema = ramify_schema(NULL);
    assert_non_null(strstr(schema, "ramify scene"));
    ramify_free(schema);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_scene_tells_what_it_holds),
        cmocka_unit_test(errors_carry_their_place),
        cmocka_unit_test(growth_gives_an_out_tree),
        cmocka_unit_test(a_picture_is_traced_and_written),
        cmocka_unit_test(cancelling_ends_early),
        cmocka_unit_test(the_schema_is_handed_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
