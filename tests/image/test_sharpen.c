// Sharpened pictures: contrast of fine detail grows by the mask's gain, edges get no halo, smooth
// gradients stay.
#include "image/sharpen.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { SIDE = 24 };

static Image *picture(float (*value)(int x, int y), int channels)
{
    Image *image = image_new(SIDE, SIDE, channels, NULL);
    for (int i = 0; i < SIDE * SIDE; i++) {
        for (int c = 0; c < channels; c++) {
            image->pixel[channels * i + c] = c == 3 ? 0.25f : value(i % SIDE, i / SIDE);
        }
    }
    return image;
}

static float ripples(int x, int y)
{
    (void)y;
    return 0.5f + 0.1f * cosf(2.0f * (float)M_PI * (float)x / 6.0f);
}

static float edge(int x, int y)
{
    (void)y;
    return x < SIDE / 2 ? 0.2f : 0.7f;
}

static float gradient(int x, int y)
{
    return 0.3f + 0.0015f * (float)x + 0.001f * (float)(y * y) / SIDE;
}

// A cosine of period 6 keeps 0.5 + 0.5 cos(2 pi / 6) = 0.75 of its amplitude in the mean, so a
// strength s adds 0.25 s of it, up to the limit of an eighth of the range, which the crests of so
// fine a cosine do not reach at s = 0.4.
static void fine_contrast_grows_by_the_gain(void **state)
{
    (void)state;
    Image *image = picture(ripples, 4), *sharp = image_sharpen(image, 0.3f, NULL);
    for (int x = 6; x < SIDE - 6; x++) {
        float before = ripples(x, 0) - 0.5f, after = sharp->pixel[4 * (SIDE * 5 + x)] - 0.5f;
        float removed = 0.25f * fabsf(before);
        if (removed > 2.0f / 255.0f) { // below that the threshold fades it
            assert_float_equal(after, 1.075f * before, 1e-5f);
        } else {
            assert_true(fabsf(after) >= fabsf(before) - 1e-6f &&
                        fabsf(after) <= 1.075f * fabsf(before) + 1e-6f);
        }
        assert_float_equal(sharp->pixel[4 * (SIDE * 5 + x) + 3], 0.25f, 0.0f);
    }
    image_free(image);
    image_free(sharp);
}

static void an_edge_gets_steeper_within_its_limit(void **state)
{
    (void)state;
    Image *image = picture(edge, 3), *sharp = image_sharpen(image, 10.0f, NULL);
    const float *row = sharp->pixel + (size_t)3 * SIDE * 7;
    assert_float_equal(row[3 * (SIDE / 2 - 1)], 0.2f - 0.2f * 0.5f, 1e-5f);
    assert_float_equal(row[3 * (SIDE / 2)], 0.7f + 0.2f * 0.5f, 1e-5f);
    assert_float_equal(row[3 * (SIDE / 2 - 2)], 0.2f, 1e-6f);
    assert_float_equal(row[3 * (SIDE / 2 + 1)], 0.7f, 1e-6f);
    image_free(image);
    image_free(sharp);
}

static void gradients_and_strength_zero_change_nothing(void **state)
{
    (void)state;
    Image *image = picture(gradient, 3), *sharp = image_sharpen(image, 1.0f, NULL);
    Image *same = image_sharpen(image, 0.0f, NULL);
    for (int i = 0; i < 3 * SIDE * SIDE; i++) {
        assert_float_equal(sharp->pixel[i], image->pixel[i], 1e-6f);
        assert_float_equal(same->pixel[i], image->pixel[i], 0.0f);
    }
    image_free(image);
    image_free(sharp);
    image_free(same);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fine_contrast_grows_by_the_gain),
        cmocka_unit_test(an_edge_gets_steeper_within_its_limit),
        cmocka_unit_test(gradients_and_strength_zero_change_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
