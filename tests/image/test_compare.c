// image_compare's numbers on images made by hand.
#include "image/compare.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static Image *image_of(int width, int channels, const float *values)
{
    Image *image = image_new(width, 1, channels, NULL);
    assert_non_null(image);
    memcpy(image->pixel, values, (size_t)(width * channels) * sizeof(float));
    return image;
}

static ImageDifference difference(const float *a, const float *b, double threshold)
{
    Image *first = image_of(2, 3, a), *second = image_of(2, 3, b);
    ImageDifference d;
    assert_true(image_compare(first, second, threshold, &d, NULL));
    image_free(first);
    image_free(second);
    return d;
}

static void test_equal(void **state)
{
    (void)state;
    float a[6] = {0, 0.5f, 1, INFINITY, NAN, -3};
    ImageDifference d = difference(a, a, 0.0);
    assert_true(d.rmse == 0.0 && d.mean == 0.0 && d.maximum == 0.0 && d.failing == 0.0);
}

static void test_numbers(void **state)
{
    (void)state;
    float a[6] = {0, 0, 0, 1, 1, 1}, b[6] = {0, 0.5f, 0, 1, 1, 2};
    ImageDifference d = difference(a, b, 0.75);
    assert_true(fabs(d.mean - 0.25) < 1e-12);
    assert_true(fabs(d.rmse - sqrt(1.25 / 6.0)) < 1e-12);
    assert_true(d.maximum == 1.0);
    assert_true(d.failing == 0.5);
    assert_true(difference(a, b, 0.25).failing == 1.0);
    assert_true(difference(a, b, 1.0).failing == 0.0); // at the threshold is not over it
}

static void test_not_a_number(void **state)
{
    (void)state;
    float a[6] = {0, 0, 0, 0, 0, 0}, b[6] = {0, NAN, 0, 0, 0, 0};
    ImageDifference d = difference(a, b, 1e30);
    assert_true(isinf(d.maximum) && d.failing == 0.5);
}

static void test_sizes(void **state)
{
    (void)state;
    float values[6] = {0};
    Image *a = image_of(2, 3, values), *b = image_of(3, 2, values);
    ImageDifference d;
    Error e = {0};
    assert_false(image_compare(a, b, 0.0, &d, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    assert_string_equal(e.message,
                        "images of 2 x 1 with 3 channels and 3 x 1 with 2 channels cannot be "
                        "compared; they must be alike in all three");
    image_free(a);
    image_free(b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_equal),
        cmocka_unit_test(test_numbers),
        cmocka_unit_test(test_not_a_number),
        cmocka_unit_test(test_sizes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
