// Loading and calling Open Image Denoise, tried on a stand-in of either version (fake_oidn.c).
#include "image/oidn.h"
#include "testing.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { WIDTH = 7, HEIGHT = 5 };

static char folder[256]; // of this program and the stand-ins

static void choose(int version)
{
    char file[300];
    snprintf(file, sizeof file, "%s/fake_oidn_%d.so", folder, version);
    assert_int_equal(setenv(OIDN_VARIABLE, file, 1), 0);
    unsetenv("FAKE_OIDN");
}

static Image *made_image(int channels, float scale)
{
    Image *image = image_new(WIDTH, HEIGHT, channels, NULL);
    assert_non_null(image);
    for (int i = 0; i < WIDTH * HEIGHT * channels; i++) {
        image->pixel[i] = scale * (float)(i % 32);
    }
    return image;
}

static Image *denoise(int channels, const volatile int *cancelled, Error *e)
{
    Image *color = made_image(channels, 1.0f), *albedo = made_image(3, 0.25f);
    Image *normal = made_image(3, -0.5f);
    Run run = run_default();
    run.threads = 2;
    run.cancelled = cancelled;
    *e = (Error){0};
    Image *out = image_denoise_oidn(color, albedo, normal, &run, e);
    image_free(color);
    image_free(albedo);
    image_free(normal);
    return out;
}

static void every_version_filters(void **state)
{
    (void)state;
    for (int version = 1; version <= 2; version++) {
        choose(version);
        Error e = {0};
        assert_int_equal(image_oidn_version(&e), 10000 * version + 300);
        for (int channels = 3; channels <= 4; channels++) {
            Image *out = denoise(channels, NULL, &e);
            assert_non_null(out);
            for (int i = 0; i < WIDTH * HEIGHT * channels; i++) {
                int pixel = i / channels, c = i % channels, guide = (3 * pixel + c) % 32;
                float color = (float)(i % 32), albedo = 0.25f * (float)guide;
                float normal = -0.5f * (float)guide;
                float wanted = c < 3 ? color / 2 + albedo / 4 + normal / 8 : color;
                assert_true(out->pixel[i] == wanted);
            }
            image_free(out);
        }
    }
}

static void no_library_is_an_error_that_helps(void **state)
{
    (void)state;
    static const struct {
        const char *file, *message;
    } cases[] = {{"/nope/oidn.so", "/nope/oidn.so: cannot open shared object file"},
                 {"/dev/null", "/dev/null: "},
                 {"libm.so.6", "the library has no function oidnNewDevice"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        Error e = {0};
        assert_int_equal(setenv(OIDN_VARIABLE, cases[i].file, 1), 0);
        assert_int_equal(image_oidn_version(&e), 0);
        assert_int_equal(e.code, ERROR_INPUT);
        assert_non_null(strstr(e.message, cases[i].message));
        assert_non_null(strstr(e.message, "RAMIFY_OIDN"));
        assert_null(denoise(3, NULL, &e));
        assert_int_equal(e.code, ERROR_INPUT);
    }
    for (int empty = 0; empty <= 1; empty++) { // then the loader's path counts
        Error e = {0};
        assert_int_equal(empty ? setenv(OIDN_VARIABLE, "", 1) : unsetenv(OIDN_VARIABLE), 0);
        assert_true(image_oidn_version(&e) > 0 ||
                    (strstr(e.message, "libOpenImageDenoise.so.2: ") &&
                     strstr(e.message, "libOpenImageDenoise.so.1: ")));
    }
}

static void failures_are_told(void **state)
{
    (void)state;
    static const struct {
        const char *how, *message;
        ErrorCode code;
    } cases[] = {{"device", "Open Image Denoise failed: no such device", ERROR_INTERNAL},
                 {"filter", "Open Image Denoise failed: no such filter", ERROR_INTERNAL},
                 {"memory", "Open Image Denoise failed: no room", ERROR_MEMORY},
                 {"execute", "Open Image Denoise failed: not committed", ERROR_INTERNAL}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        Error e;
        choose(2);
        assert_int_equal(setenv("FAKE_OIDN", cases[i].how, 1), 0);
        assert_null(denoise(4, NULL, &e));
        assert_int_equal(e.code, cases[i].code);
        assert_string_equal(e.message, cases[i].message);
        assert_int_equal(image_oidn_version(&e) > 0, i > 0);
    }
}

static void it_can_be_cancelled(void **state)
{
    (void)state;
    Error e;
    volatile int cancelled = 1;
    choose(2);
    assert_null(denoise(3, &cancelled, &e));
    assert_int_equal(e.code, ERROR_CANCELLED);
    cancelled = 0;
    Image *out = denoise(3, &cancelled, &e);
    assert_non_null(out);
    image_free(out);
}

static void wrong_images_are_refused(void **state)
{
    (void)state;
    choose(2);
    Image *color = made_image(4, 1.0f), *guide = made_image(3, 1.0f), *depth = made_image(1, 1.0f);
    Image *small = image_new(WIDTH - 1, HEIGHT, 3, NULL);
    const Image *cases[][3] = {
        {color, depth, guide}, {color, guide, color}, {depth, guide, guide}, {color, small, guide}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        Run run = run_default();
        Error e = {0};
        assert_null(image_denoise_oidn(cases[i][0], cases[i][1], cases[i][2], &run, &e));
        assert_int_equal(e.code, ERROR_INPUT);
    }
    image_free(color);
    image_free(guide);
    image_free(depth);
    image_free(small);
}

int main(int argc, char **argv)
{
    (void)argc;
    char *end = strrchr(argv[0], '/');
    snprintf(folder, sizeof folder, "%.*s", end ? (int)(end - argv[0]) : 1, end ? argv[0] : ".");
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_version_filters),
        cmocka_unit_test(no_library_is_an_error_that_helps),
        cmocka_unit_test(failures_are_told),
        cmocka_unit_test(it_can_be_cancelled),
        cmocka_unit_test(wrong_images_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
