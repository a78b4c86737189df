// Tone mapping: the curve, exposure, white balance, lens, alpha.
#include "image/tonemap.h"

#include "image/agx.h"
#include "image/lens.h"
#include "image/tone_curve.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

// The curve alone: no lens.
static ToneParams plain(void)
{
    ToneParams p = tone_params_default();
    p.bloom = p.vignette = 0.0f;
    return p;
}

static void map_one(float r, float g, float b, const ToneParams *params, float out[3])
{
    Image *image = image_new(1, 1, 3, NULL);
    float in[3] = {r, g, b};
    memcpy(image->pixel, in, sizeof in);
    Image *mapped = tone_map(image, NULL, params, NULL);
    assert_non_null(mapped);
    memcpy(out, mapped->pixel, sizeof in);
    image_free(image);
    image_free(mapped);
}

static void check_curve(const ToneParams *params)
{
    float last = -1.0f, out[3];
    for (int i = -140; i <= 60; i++) {
        float x = exp2f((float)i * 0.1f);
        map_one(x, x, x, params, out);
        assert_true(out[0] >= last && out[0] <= 1.0f);
        assert_float_equal(out[0], out[1], 1e-5f);
        assert_float_equal(out[0], out[2], 1e-5f);
        last = out[0];
    }
    assert_float_equal(last, 1.0f, 1e-4f);
    map_one(0, 0, 0, params, out);
    assert_float_equal(out[0], 0.0f, 0.0f);
    map_one(0.18f, 0.18f, 0.18f, params, out);
    assert_float_equal(out[0], tone_srgb_from_linear(0.18f), 1e-4f);
}

// Greys stay grey, brighter stays brighter, black, middle grey and white stay in their places.
static void test_curve(void **state)
{
    (void)state;
    static const float contrast[] = {0.05f, 0.7f, 1.0f, 1.3f, 10.0f};
    ToneParams params = plain();
    for (int i = 0; i < 5; i++) {
        params.contrast = contrast[i];
        params.view = VIEW_FILMIC;
        check_curve(&params);
        params.view = VIEW_AGX;
        for (params.look = 0; params.look <= AGX_PUNCHY; params.look++) {
            check_curve(&params);
        }
    }
}

// A toe and a shoulder: steeper in the middle than at both ends, and highlights of 2 stops over
// white paper still differ.
static void test_shape(void **state)
{
    (void)state;
    ToneParams params = plain();
    float low[3], low2[3], mid[3], mid2[3], high[3], high2[3];
    map_one(0.004f, 0.004f, 0.004f, &params, low);
    map_one(0.008f, 0.008f, 0.008f, &params, low2);
    map_one(0.18f, 0.18f, 0.18f, &params, mid);
    map_one(0.36f, 0.36f, 0.36f, &params, mid2);
    map_one(3.0f, 3.0f, 3.0f, &params, high);
    map_one(6.0f, 6.0f, 6.0f, &params, high2);
    assert_true(mid2[0] - mid[0] > low2[0] - low[0]);
    assert_true(mid2[0] - mid[0] > high2[0] - high[0]);
    assert_true(high2[0] > high[0] + 0.01f);
}

// The ends of the log2 encoding, the slope and the inverse, in closed form.
static void test_agx_curve(void **state)
{
    (void)state;
    AgxFit base = agx_fit(AGX_BASE_CONTRAST, 1.0f), steep = agx_fit(AGX_HIGH_CONTRAST, 1.0f);
    assert_float_equal(agx_curve(&base, 0.18f * exp2f(6.5f)), 1.0f, 1e-6f);
    assert_true(agx_curve(&base, 0.18f * exp2f(6.3f)) < 1.0f);
    assert_float_equal(agx_curve(&base, 0.18f * exp2f(-10.0f)), 0.0f, 1e-6f);
    assert_true(agx_curve(&base, 0.18f * exp2f(-9.0f)) > 0.0f);
    // the encoded value rises by `slope` over the 16.5 stops
    float encoded[2] = {powf(agx_curve(&base, 0.18f * exp2f(-0.1f)), 1.0f / 2.2f),
                        powf(agx_curve(&base, 0.18f * exp2f(0.1f)), 1.0f / 2.2f)};
    assert_float_equal((encoded[1] - encoded[0]) / (0.2f / 16.5f), 2.4f, 0.01f);
    for (float stops = -8.0f; stops < 6.0f; stops += 0.25f) {
        float x = 0.18f * exp2f(stops), back = agx_curve_inverse(&steep, agx_curve(&steep, x));
        assert_float_equal(log2f(back / x), 0.0f, stops < 4.0f ? 2e-3f : 0.05f);
        assert_true(stops == 0.0f ||
                    (agx_curve(&steep, x) > agx_curve(&base, x)) == (stops > 0.0f));
    }
    assert_float_equal(agx_curve_inverse(&steep, 1.0f), 0.18f * exp2f(6.5f), 1e-3f);
}

// Hue (degrees) and chroma in Oklab (Ottosson 2020) of display values.
static float oklab_hue(const float display[3], float *chroma)
{
    float c[3];
    for (int i = 0; i < 3; i++) {
        c[i] = tone_linear_from_srgb(display[i]);
    }
    float l = cbrtf(0.4122214708f * c[0] + 0.5363325363f * c[1] + 0.0514459929f * c[2]);
    float m = cbrtf(0.2119034982f * c[0] + 0.6806995451f * c[1] + 0.1073969566f * c[2]);
    float s = cbrtf(0.0883024619f * c[0] + 0.2817188376f * c[1] + 0.6299787005f * c[2]);
    float a = 1.9779984951f * l - 2.4285922050f * m + 0.4505937099f * s;
    float b = 0.0259040371f * l + 0.7827717662f * m - 0.8086757660f * s;
    *chroma = hypotf(a, b);
    return atan2f(b, a) * 57.29578f;
}

// Hue of a colour that is `stops` brighter than middle grey, less its hue in the middle.
static float hue_shift(const float rgb[3], float stops, const ToneParams *params, float *chroma)
{
    float hue[2], unused, y = 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2];
    for (int i = 0; i < 2; i++) {
        float out[3], k = 0.18f / y * (i ? exp2f(stops) : 1.0f);
        map_one(k * rgb[0], k * rgb[1], k * rgb[2], params, out);
        hue[i] = oklab_hue(out, i ? chroma : &unused);
    }
    return fabsf(remainderf(hue[1] - hue[0], 360.0f));
}

// Highlights keep their hue: the low sun's orange stays orange, the sky's blue does not turn cyan.
static void test_hues_of_highlights(void **state)
{
    (void)state;
    static const float color[][3] = {
        {1.0f, 0.2f, 0.02f},  {1.0f, 0.35f, 0.04f}, {0.25f, 0.5f, 0.06f}, {0.05f, 0.8f, 1.0f},
        {0.03f, 0.08f, 1.0f}, {0.25f, 0.5f, 1.0f},  {1.0f, 0.05f, 0.8f},  {0.7f, 0.4f, 0.28f}};
    enum { COLORS = sizeof color / sizeof *color };
    ToneParams agx = plain(), filmic = plain();
    filmic.view = VIEW_FILMIC;
    float sum = 0.0f, filmic_sum = 0.0f, chroma, filmic_chroma;
    for (int i = 0; i < COLORS; i++) {
        for (int stops = 2; stops <= 4; stops++) {
            float shift = hue_shift(color[i], (float)stops, &agx, &chroma);
            sum += shift;
            filmic_sum += hue_shift(color[i], (float)stops, &filmic, &filmic_chroma);
            assert_true(shift < 30.0f);
            assert_true(chroma > 0.01f); // not burnt out
        }
    }
    assert_true(sum < 0.65f * filmic_sum);
}

static void test_looks(void **state)
{
    (void)state;
    ToneParams params = plain();
    float dark[4], chroma[4];
    for (int look = 0; look < 4; look++) {
        float out[3];
        params.look = (AgxLook)look;
        map_one(0.02f, 0.02f, 0.02f, &params, out);
        dark[look] = out[0];
        map_one(0.3f, 0.15f, 0.1f, &params, out);
        oklab_hue(out, &chroma[look]);
    }
    assert_true(dark[AGX_HIGH_CONTRAST] < dark[AGX_MEDIUM_HIGH_CONTRAST]);
    assert_true(dark[AGX_MEDIUM_HIGH_CONTRAST] < dark[AGX_BASE_CONTRAST]);
    assert_float_equal(dark[AGX_PUNCHY], dark[AGX_MEDIUM_HIGH_CONTRAST], 1e-6f);
    assert_true(chroma[AGX_PUNCHY] > 1.15f * chroma[AGX_MEDIUM_HIGH_CONTRAST]);
}

// Bright colours pale, but keep the order of their channels.
static void test_colours(void **state)
{
    (void)state;
    ToneParams params = plain();
    float dim[3], bright[3];
    map_one(0.2f, 0.1f, 0.05f, &params, dim);
    assert_true(dim[0] > dim[1] && dim[1] > dim[2]);
    map_one(12.0f, 6.0f, 3.0f, &params, bright);
    assert_true(bright[0] >= bright[1] && bright[1] > bright[2]);
    assert_true(bright[0] - bright[2] < dim[0] - dim[2]);
    map_one(-1.0f, NAN, INFINITY, &params, bright);
    for (int c = 0; c < 3; c++) {
        assert_true(bright[c] >= 0.0f && bright[c] <= 1.0f);
    }
}

static void test_linear_and_exposure(void **state)
{
    (void)state;
    ToneParams params = plain();
    params.view = VIEW_STANDARD;
    params.exposure = 1.0f;
    float out[3];
    map_one(0.1f, 0.2f, 0.6f, &params, out);
    assert_float_equal(out[0], tone_srgb_from_linear(0.2f), 1e-5f);
    assert_float_equal(out[1], tone_srgb_from_linear(0.4f), 1e-5f);
    assert_float_equal(out[2], 1.0f, 0.0f);
    params.exposure = 0.0f;
    params.saturation = 0.0f;
    map_one(0.0f, 0.5f, 0.0f, &params, out);
    assert_float_equal(out[0], tone_srgb_from_linear(0.3576f), 1e-4f);
    assert_float_equal(out[0], out[2], 1e-6f);
    // IEC 61966-2-1
    assert_float_equal(tone_srgb_from_linear(0.5f), 0.735357f, 1e-5f);
    assert_float_equal(tone_linear_from_srgb(0.735357f), 0.5f, 1e-5f);
    assert_float_equal(tone_linear_from_srgb(0.04f), 0.04f / 12.92f, 1e-8f);
    assert_float_equal(tone_srgb_from_linear(0.002f), 0.02584f, 1e-6f);
}

static void test_auto_exposure(void **state)
{
    (void)state;
    Image *image = image_new(4, 1, 3, NULL);
    float values[4] = {50.0f, 200.0f, 100.0f, 0.0f}; // geometric mean 100, black left out
    for (int i = 0; i < 12; i++) {
        image->pixel[i] = values[i / 3];
    }
    ToneParams params = plain();
    params.view = VIEW_STANDARD;
    params.auto_exposure = true;
    Image *out = tone_map(image, NULL, &params, NULL);
    assert_float_equal(out->pixel[6], tone_srgb_from_linear(0.18f), 1e-4f);
    image_free(out);
    image_free(image);
}

static void apply(float m[3][3], const float v[3], float out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    }
}

static void test_white_balance(void **state)
{
    (void)state;
    float m[3][3], out[3], white[3] = {1, 1, 1};
    for (int k = 0; k < 2; k++) {
        tone_white_balance(k ? 6500.0f : 0.0f, m);
        apply(m, white, out);
        assert_float_equal(out[0], 1.0f, 1e-5f);
        assert_float_equal(out[2], 1.0f, 1e-5f);
    }
    // CIE illuminant A (2856 K) in linear Rec. 709, luminance 1: turned nearly grey
    float lamp[3] = {1.8453f, 0.8262f, 0.2333f};
    tone_white_balance(2856.0f, m);
    apply(m, lamp, out);
    assert_float_equal(out[0] / out[1], 1.0f, 0.02f);
    assert_float_equal(out[2] / out[1], 1.0f, 0.03f);
    // a light bluer than daylight makes white look warm
    tone_white_balance(10000.0f, m);
    apply(m, white, out);
    assert_true(out[0] > 1.02f && out[2] < 0.95f);
}

static double sum_of(const Image *image)
{
    double sum = 0.0;
    for (int i = 0; i < image->width * image->height * image->channels; i++) {
        sum += (double)image->pixel[i];
    }
    return sum;
}

static void test_bloom(void **state)
{
    (void)state;
    Image *image = image_new(90, 70, 3, NULL);
    float *spot = image->pixel + 3 * (20 * 90 + 30);
    spot[0] = 1000.0f;
    spot[1] = 500.0f;
    image->pixel[0] = 100.0f; // in the corner: what leaves comes back
    assert_true(lens_bloom(image, NULL, 0.1f, NULL));
    assert_true(fabs(sum_of(image) / 1600.0 - 1.0) < 1e-4);
    assert_true(spot[0] > 900.0f && spot[0] < 950.0f);
    assert_float_equal(spot[1] / spot[0], 0.5f, 1e-3f);
    assert_true(spot[3] > spot[6] && spot[6] > spot[12] && spot[12] > 0.0f);
    assert_float_equal(spot[3], spot[-3], 1e-3f);
    assert_float_equal(spot[3], spot[3 * 90], 1e-3f);
    image_free(image);

    Image *flat = image_new(1, 3, 4, NULL); // smaller than any blur
    for (int i = 0; i < 12; i++) {
        flat->pixel[i] = 0.5f;
    }
    assert_true(lens_bloom(flat, NULL, 0.2f, NULL));
    assert_float_equal(flat->pixel[4], 0.5f, 1e-5f);
    assert_float_equal(flat->pixel[7], 0.5f, 0.0f);
    image_free(flat);

    Image *narrow = image_new(2, 400, 3, NULL); // several times narrower than the widest blur
    narrow->pixel[3 * (2 * 130 + 1)] = 1000.0f;
    assert_true(lens_bloom(narrow, NULL, 0.1f, NULL));
    assert_true(fabs(sum_of(narrow) / 1000.0 - 1.0) < 1e-4);
    assert_float_equal(narrow->pixel[3 * 2 * 134], narrow->pixel[3 * (2 * 134 + 1)], 1e-3f);
    image_free(narrow);
}

static void test_vignette(void **state)
{
    (void)state;
    Image *image = image_new(1001, 501, 3, NULL);
    assert_float_equal(lens_vignette(image, 500, 250, 0.4f), 1.0f, 1e-6f);
    assert_float_equal(lens_vignette(image, 0, 0, 0.4f), 0.6f, 5e-3f);
    assert_float_equal(lens_vignette(image, 1000, 500, 0.4f), lens_vignette(image, 0, 0, 0.4f),
                       1e-6f);
    assert_float_equal(lens_vignette(image, 0, 0, 0.0f), 1.0f, 1e-6f);
    image_free(image);
}

// Premultiplied radiance in, straight display values out: the colour does not depend on alpha.
static void test_alpha(void **state)
{
    (void)state;
    Image *image = image_new(3, 1, 4, NULL);
    float pixels[12] = {0.4f, 0.2f, 0.1f, 1.0f, 0.2f, 0.1f, 0.05f, 0.5f, 0, 0, 0, 0};
    memcpy(image->pixel, pixels, sizeof pixels);
    ToneParams params = plain();
    Image *out = tone_map(image, NULL, &params, NULL);
    for (int c = 0; c < 3; c++) {
        assert_float_equal(out->pixel[c], out->pixel[4 + c], 1e-5f);
        assert_float_equal(out->pixel[8 + c], 0.0f, 0.0f);
    }
    assert_float_equal(out->pixel[7], 0.5f, 0.0f);
    image_free(image);
    image_free(out);
    Error e = {0};
    Image *two = image_new(1, 1, 2, NULL);
    assert_null(tone_map(two, NULL, &params, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    image_free(two);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_curve),
        cmocka_unit_test(test_shape),
        cmocka_unit_test(test_agx_curve),
        cmocka_unit_test(test_hues_of_highlights),
        cmocka_unit_test(test_looks),
        cmocka_unit_test(test_colours),
        cmocka_unit_test(test_linear_and_exposure),
        cmocka_unit_test(test_auto_exposure),
        cmocka_unit_test(test_white_balance),
        cmocka_unit_test(test_bloom),
        cmocka_unit_test(test_vignette),
        cmocka_unit_test(test_alpha),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
