// Film grain: its deviation follows the model, its mean is zero, its layers share their noise.
#include "image/grain.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { SIDE = 256, PIXELS = SIDE * SIDE };

static Image *plain(float value, int channels)
{
    Image *image = image_new(SIDE, SIDE, channels, NULL);
    for (int i = 0; i < PIXELS * channels; i++) {
        image->pixel[i] = channels == 4 && i % 4 == 3 ? 0.25f : value;
    }
    return image;
}

// Mean over all pixels of (a - value) (b - value), where b is the channel `other` of the pixel
// `right` columns on.
static double covariance(const Image *image, float value, int channel, int other, int right)
{
    double sum = 0.0;
    for (int i = 0; i < PIXELS; i++) {
        int j = i / SIDE * SIDE + (i + right) % SIDE;
        double a = (double)(image->pixel[image->channels * i + channel] - value);
        double b = (double)(image->pixel[image->channels * j + other] - value);
        sum += a * b;
    }
    return sum / PIXELS;
}

static void the_deviation_follows_the_light(void **state)
{
    (void)state;
    const float value[] = {0.05f, 0.2f, 0.5f, 0.9f};
    for (int k = 0; k < 4; k++) {
        Image *image = plain(value[k], 4), *out = image_grain(image, 0.02f, 7, NULL);
        double mean = 0.0;
        for (int i = 0; i < PIXELS; i++) {
            mean += (double)(out->pixel[4 * i] - value[k]) / PIXELS;
            assert_float_equal(out->pixel[4 * i + 3], 0.25f, 0.0f);
        }
        double expected = 0.02 * sqrt(8.0 * (double)value[k]) * (1.0 - (double)value[k]);
        assert_true(fabs(mean) < 0.02 * expected);
        for (int c = 0; c < 3; c++) {
            double deviation = sqrt(covariance(out, value[k], c, c, 0));
            assert_true(fabs(deviation / expected - 1.0) < 0.02);
        }
        image_free(image);
        image_free(out);
    }
}

// Nine tenths of the variance are common; neighbours share 2 s (1 - 2 s) / (2 s^2 + (1 - 2 s)^2)
// of it for s = 0.15, pixels three apart nothing.
static void grains_have_a_size_and_a_colour(void **state)
{
    (void)state;
    Image *image = plain(0.5f, 3), *out = image_grain(image, 0.02f, 7, NULL);
    double variance = covariance(out, 0.5f, 0, 0, 0);
    assert_true(fabs(covariance(out, 0.5f, 0, 2, 0) / variance - 0.9) < 0.02);
    assert_true(fabs(covariance(out, 0.5f, 1, 1, 1) / variance - 0.21 / 0.535) < 0.02);
    assert_true(fabs(covariance(out, 0.5f, 1, 1, 3) / variance) < 0.02);
    image_free(image);
    image_free(out);
}

static void black_and_white_stay_and_keys_differ(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        Image *image = plain((float)k, 3), *out = image_grain(image, 0.5f, 7, NULL);
        assert_memory_equal(image->pixel, out->pixel, sizeof(float) * 3 * PIXELS);
        image_free(image);
        image_free(out);
    }
    Image *image = plain(0.5f, 3);
    Image *one = image_grain(image, 0.02f, 7, NULL), *same = image_grain(image, 0.02f, 7, NULL);
    Image *other = image_grain(image, 0.02f, 8, NULL);
    assert_memory_equal(one->pixel, same->pixel, sizeof(float) * 3 * PIXELS);
    assert_true(memcmp(one->pixel, other->pixel, sizeof(float) * 3 * PIXELS) != 0);
    image_free(image);
    image_free(one);
    image_free(same);
    image_free(other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_deviation_follows_the_light),
        cmocka_unit_test(grains_have_a_size_and_a_colour),
        cmocka_unit_test(black_and_white_stay_and_keys_differ),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
