// Views of OpenColorIO's configurations against closed forms, and errors that name what there is.
#include "image/ocio.h"
#include "image/tonemap.h"
#include "testing.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[] = "/tmp/ramify-ocio-XXXXXX";

// A screen of gamma 2.2, a look of twice the light and one that swaps red and blue.
static const char VIEWS[] =
    "ocio_profile_version: 2\n"
    "environment: {}\n"
    "roles: {default: linear, scene_linear: linear}\n"
    "displays:\n"
    "  Screen:\n"
    "    - !<View> {name: Gamma, colorspace: gamma}\n"
    "    - !<View> {name: Bright, colorspace: gamma, looks: double}\n"
    "  Beamer:\n"
    "    - !<View> {name: Dim, colorspace: dim}\n"
    "looks:\n"
    "  - !<Look> {name: double, process_space: linear, transform: !<CDLTransform> {slope: [2, 2, "
    "2]}}\n"
    "  - !<Look> {name: swap, process_space: linear, transform: !<MatrixTransform> {matrix: [0, 0, "
    "1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1]}}\n"
    "colorspaces:\n"
    "  - !<ColorSpace> {name: linear}\n"
    "  - !<ColorSpace> {name: gamma, from_scene_reference: !<ExponentTransform> {value: [2.2, 2.2, "
    "2.2, 1], direction: inverse}}\n"
    "  - !<ColorSpace> {name: dim, from_scene_reference: !<MatrixTransform> {matrix: [0.5, 0, 0, "
    "0, "
    "0, 0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1]}}\n"
    "  - !<ColorSpace> {name: thirds, to_scene_reference: !<MatrixTransform> {matrix: [3, 0, 0, 0, "
    "0, 3, 0, 0, 0, 0, 3, 0, 0, 0, 0, 1]}}\n";

// The reference is ACES2065-1, and the screen shows linear Rec. 709.
static const char ACES[] =
    "ocio_profile_version: 2\n"
    "environment: {}\n"
    "roles: {default: ACES2065-1, aces_interchange: ACES2065-1}\n"
    "displays:\n"
    "  Screen:\n"
    "    - !<View> {name: Plain, colorspace: out}\n"
    "colorspaces:\n"
    "  - !<ColorSpace> {name: ACES2065-1}\n"
    "  - !<ColorSpace> {name: out, from_scene_reference: !<MatrixTransform> {matrix: [2.52168619, "
    "-1.13413099, -0.38755520, 0, -0.27647992, 1.37271909, -0.09623917, 0, -0.01537807, "
    "-0.15297536, 1.16833343, 0, 0, 0, 0, 1]}}\n";

static const char *config(const char *name, const char *text)
{
    static char path[64];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
    return path;
}

static void view_of(const OcioParams *params, const float in[4], float out[4])
{
    Image *image = image_new(1, 1, 4, NULL);
    assert_non_null(image);
    memcpy(image->pixel, in, 4 * sizeof *in);
    Error e = {0};
    if (!ocio_check(params, &e) || !ocio_apply(params, image, &e)) {
        fail_msg("%s", e.message);
    }
    memcpy(out, image->pixel, 4 * sizeof *out);
    image_free(image);
}

static const float IN[4] = {0.18f, 0.4f, 0.09f, 0.5f};

static void expect_view(const OcioParams *params, float r, float g, float b)
{
    float out[4], right[3] = {r, g, b};
    view_of(params, IN, out);
    for (int c = 0; c < 3; c++) {
        assert_float_equal(out[c], right[c], 2e-5f);
    }
    assert_float_equal(out[3], 0.5f, 0.0f); // alpha is kept
}

static float gamma22(float x)
{
    return powf(x, 1.0f / 2.2f);
}

static void test_views_and_looks(void **state)
{
    (void)state;
    OcioParams p = {.config = config("views.ocio", VIEWS)};
    expect_view(&p, gamma22(0.18f), gamma22(0.4f), gamma22(0.09f)); // the defaults
    p.view = "Bright";
    expect_view(&p, gamma22(0.36f), gamma22(0.8f), gamma22(0.18f));
    p.view = "bright"; // names have no case
    expect_view(&p, gamma22(0.36f), gamma22(0.8f), gamma22(0.18f));
    p.look = "swap"; // in place of the view's own
    expect_view(&p, gamma22(0.09f), gamma22(0.4f), gamma22(0.18f));
    p.look = "swap, -double";
    expect_view(&p, gamma22(0.045f), gamma22(0.2f), gamma22(0.09f));
    p = (OcioParams){.config = p.config, .display = "Beamer"};
    expect_view(&p, 0.09f, 0.2f, 0.045f);
    p.space = "thirds";
    expect_view(&p, 0.27f, 0.6f, 0.135f);
}

static void test_rec709_by_way_of_aces(void **state)
{
    (void)state;
    OcioParams p = {.config = config("aces.ocio", ACES)};
    expect_view(&p, IN[0], IN[1], IN[2]);
    p.space = "ACES2065-1"; // taken as it is: not the same
    float out[4];
    view_of(&p, IN, out);
    assert_true(fabsf(out[0] - IN[0]) > 0.01f);
}

// Exposure, white balance and saturation come first; straight colours go in.
static void test_in_tone_map(void **state)
{
    (void)state;
    OcioParams p = {.config = config("views.ocio", VIEWS)};
    ToneParams tone = tone_params_default();
    tone.bloom = tone.vignette = 0.0f;
    tone.exposure = 1.0f;
    tone.color = &p;
    Image *image = image_new(1, 1, 4, NULL);
    memcpy(image->pixel, IN, sizeof IN);
    Image *shown = tone_map(image, NULL, &tone, NULL);
    assert_non_null(shown);
    for (int c = 0; c < 3; c++) {
        // a view may leave the display's range, a developed picture does not
        assert_float_equal(shown->pixel[c], fminf(gamma22(IN[c] * 2.0f / 0.5f), 1.0f), 2e-5f);
    }
    image_free(shown);
    p.view = "Gone";
    Error e = {0};
    assert_null(tone_map(image, NULL, &tone, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    image_free(image);
}

static void expect_refusal(const OcioParams *params, const char *key, const char *part)
{
    Error e = {0};
    assert_false(ocio_check(params, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    assert_string_equal(e.key, key);
    if (!strstr(e.message, part)) {
        fail_msg("'%s' does not say '%s'", e.message, part);
    }
}

static void test_errors(void **state)
{
    (void)state;
    const char *file = config("views.ocio", VIEWS);
    expect_refusal(&(OcioParams){.config = file, .display = "TV"}, "display",
                   "'TV' is no display of the configuration; it has Screen, Beamer");
    expect_refusal(&(OcioParams){.config = file, .view = "Dim"}, "view",
                   "'Dim' is no view of display 'Screen' of the configuration; it has Gamma, "
                   "Bright");
    expect_refusal(&(OcioParams){.config = file, .look = "swap, -half"}, "look",
                   "'half' is no look of the configuration; it has double, swap");
    expect_refusal(&(OcioParams){.config = file, .space = "acescg"}, "space",
                   "'acescg' is no space of the configuration; it has linear, gamma, dim, thirds");
    expect_refusal(&(OcioParams){.config = "/nowhere/x.ocio"}, "config", "/nowhere/x.ocio");
    expect_refusal(&(OcioParams){.config = config("bad.ocio", "ocio_profile_version: [\n")},
                   "config", "OpenColorIO cannot use");
    expect_refusal(&(OcioParams){.config = config("none.ocio", "ocio_profile_version: 2\n")},
                   "config", "OpenColorIO cannot use");
}

static int make_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    static const char *const names[] = {"views.ocio", "aces.ocio", "bad.ocio", "none.ocio"};
    char path[64];
    for (int i = 0; i < 4; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        unlink(path);
    }
    return rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_views_and_looks),
        cmocka_unit_test(test_rec709_by_way_of_aces),
        cmocka_unit_test(test_in_tone_map),
        cmocka_unit_test(test_errors),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
