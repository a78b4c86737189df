// FLIP against numbers of its authors' own program (flip-evaluator 1.7 from PyPI) on pictures that
// are made here, and against what every such metric must do.
#include "image/flip.h"
#include "testing.h"

#include <math.h>

enum { WIDTH = 96, HEIGHT = 64 };

// A gradient of colours with a disc and stripes, of 8-bit values. shift: moves the disc; stain:
// recolours a part.
static Image *picture(int shift, bool stain)
{
    Image *image = image_new(WIDTH, HEIGHT, 3, NULL);
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            int dx = x - 30 - shift, dy = y - 30;
            bool disc = dx * dx + dy * dy<300, stripe = x> 60 && y / 3 % 2 == 0;
            int value[3] = {disc ? 240 : 2 * x, disc ? 90 : (stripe ? 200 : 3 * y),
                            (stain && y > 50 ? 200 : 40) + (x * 7 + y * 13) % 16};
            for (int c = 0; c < 3; c++) {
                image->pixel[3 * (y * WIDTH + x) + c] = (float)value[c] / 255.0f;
            }
        }
    }
    return image;
}

static void is_as_the_authors_program(void **state)
{
    (void)state;
    static const struct {
        int shift;
        bool stain;
        float pixels_per_degree;
        double mean, at_edge, at_stain; // pixels (48, 30) and (70, 60)
    } cases[] = {{0, true, FLIP_PIXELS_PER_DEGREE, 0.229143, 0.000000, 0.951966},
                 {1, false, FLIP_PIXELS_PER_DEGREE, 0.035949, 0.492684, 0.000000},
                 {5, true, FLIP_PIXELS_PER_DEGREE, 0.328691, 0.759561, 0.951966},
                 {3, true, 25.0f, 0.260244, 0.945501, 0.952366}};
    Image *reference = picture(0, false);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        Image *test = picture(cases[i].shift, cases[i].stain);
        Image *map = image_flip(reference, test, cases[i].pixels_per_degree, NULL);
        assert_non_null(map);
        double edge = (double)map->pixel[30 * WIDTH + 48];
        double stain = (double)map->pixel[60 * WIDTH + 70];
        if (fabs(image_mean(map) - cases[i].mean) > 1e-5 || fabs(edge - cases[i].at_edge) > 5e-5 ||
            fabs(stain - cases[i].at_stain) > 5e-5) {
            fail_msg("case %zu: mean %.6f, %.6f at the edge, %.6f in the stain", i, image_mean(map),
                     edge, stain);
        }
        image_free(map);
        image_free(test);
    }
    image_free(reference);
}

static void equal_pictures_look_equal(void **state)
{
    (void)state;
    Image *a = picture(0, false);
    a->pixel[7] = NAN;
    Image *map = image_flip(a, a, FLIP_PIXELS_PER_DEGREE, NULL);
    assert_true(image_mean(map) == 0.0);
    image_free(map);
    image_free(a);
}

static double of_plain(float grey_a, float grey_b, int size)
{
    Image *a = image_new(size, size, 3, NULL), *b = image_new(size, size, 3, NULL);
    for (int i = 0; i < 3 * size * size; i++) {
        a->pixel[i] = grey_a;
        b->pixel[i] = grey_b;
    }
    Image *map = image_flip(a, b, FLIP_PIXELS_PER_DEGREE, NULL);
    double mean = image_mean(map);
    image_free(map);
    image_free(a);
    image_free(b);
    return mean;
}

static void grows_with_the_difference(void **state)
{
    (void)state;
    double none = of_plain(0.5f, 0.5f, 5), step = of_plain(0.5f, 0.5f + 1.0f / 255.0f, 5),
           more = of_plain(0.5f, 0.7f, 5), most = of_plain(0.0f, 1.0f, 5);
    assert_true(none == 0.0 && step > 0.0 && step < 0.03 && more > step && most > more);
    assert_true(most > 0.9 && most <= 1.0);
    assert_true(of_plain(0.2f, 0.4f, 1) > 0.0); // a picture of one pixel
}

static void sizes_must_fit(void **state)
{
    (void)state;
    Image *a = image_new(4, 4, 3, NULL), *b = image_new(5, 4, 3, NULL);
    Error e = {0};
    assert_null(image_flip(a, b, FLIP_PIXELS_PER_DEGREE, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    assert_null(image_flip(a, a, 0.0f, &e));
    image_free(a);
    image_free(b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(is_as_the_authors_program),
        cmocka_unit_test(equal_pictures_look_equal),
        cmocka_unit_test(grows_with_the_difference),
        cmocka_unit_test(sizes_must_fit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
