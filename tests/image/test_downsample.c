// Pictures made smaller: the mean of light, by alpha.
#include "image/downsample.h"

#include "image/tone_curve.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

// A picture without symmetry, 0..1 in all channels.
static Image *uneven(int width, int height, int channels)
{
    Image *image = image_new(width, height, channels, NULL);
    for (int i = 0; i < width * height * channels; i++) {
        image->pixel[i] = (float)((i * 37 + i * i * 11) % 101) / 100.0f;
    }
    return image;
}

// Every value of the small picture against the sum over the pixels that it covers.
static void check_means(int width, int height, int channels, int factor)
{
    Image *fine = uneven(width, height, channels);
    Image *small = image_downsample(fine, factor, NULL);
    assert_int_equal(small->width, width / factor);
    assert_int_equal(small->height, height / factor);
    assert_int_equal(small->channels, channels);
    for (int i = 0; i < small->width * small->height; i++) {
        double light[3] = {0, 0, 0}, cover = 0;
        for (int j = 0; j < width * height; j++) {
            if (j % width / factor == i % small->width && j / width / factor == i / small->width) {
                const float *p = fine->pixel + j * channels;
                double alpha = channels == 4 ? (double)p[3] : 1.0;
                for (int c = 0; c < 3; c++) {
                    light[c] += alpha * (double)tone_linear_from_srgb(p[c]);
                }
                cover += alpha;
            }
        }
        for (int c = 0; c < 3; c++) {
            double shown = (double)tone_linear_from_srgb(small->pixel[i * channels + c]);
            assert_float_equal((float)shown, (float)(light[c] / cover), 1e-5f);
        }
        if (channels == 4) {
            assert_float_equal(small->pixel[4 * i + 3], (float)(cover / (factor * factor)), 1e-5f);
        }
    }
    image_free(fine);
    image_free(small);
}

static void test_means(void **state)
{
    (void)state;
    check_means(6, 4, 3, 2);
    check_means(9, 6, 4, 3);
    check_means(8, 8, 4, 8);
}

// Black beside white is as bright as half the light, not as half the number.
static void test_light(void **state)
{
    (void)state;
    Image *image = image_new(2, 2, 3, NULL);
    for (int c = 0; c < 3; c++) {
        image->pixel[c] = image->pixel[9 + c] = 1.0f;
        image->pixel[3 + c] = image->pixel[6 + c] = 0.0f;
    }
    Image *small = image_downsample(image, 2, NULL);
    assert_float_equal(small->pixel[0], 0.7353569f, 1e-5f); // the code of 0.5, IEC 61966-2-1
    image_free(image);
    image_free(small);
}

// What is not seen has no colour that could bleed into what is.
static void test_alpha(void **state)
{
    (void)state;
    const float pixels[16] = {1, 0, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0};
    Image *image = image_new(2, 2, 4, NULL);
    memcpy(image->pixel, pixels, sizeof pixels);
    Image *small = image_downsample(image, 2, NULL);
    const float wanted[4] = {0.0f, 1.0f, 0.0f, 0.25f};
    for (int c = 0; c < 4; c++) {
        assert_float_equal(small->pixel[c], wanted[c], 1e-6f);
    }
    memset(image->pixel, 0, sizeof pixels);
    Image *nothing = image_downsample(image, 2, NULL);
    for (int c = 0; c < 4; c++) {
        assert_true(nothing->pixel[c] == 0.0f);
    }
    image_free(image);
    image_free(small);
    image_free(nothing);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_means),
        cmocka_unit_test(test_light),
        cmocka_unit_test(test_alpha),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
