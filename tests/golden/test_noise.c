// The test for "equal but for noise": how often it errs where nothing differs, what it finds where
// something does, and its numbers against closed forms.
#include "base/memory.h"
#include "base/random.h"
#include "golden/noise.h"
#include "golden/student.h"
#include "testing.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

enum { WIDTH = 44, HEIGHT = 27, RUNS = 4 };
#define ALPHA 0.01

// What kind of noise a pixel has.
typedef enum NoiseKind { NOISE_NORMAL, NOISE_SKEWED, NOISE_FIREFLIES } NoiseKind;

// A value of mean 1.
static double noisy_value(NoiseKind kind, uint64_t key)
{
    double u = (double)random_unit(random_key(key, 1));
    switch (kind) {
    case NOISE_NORMAL:
        return 1.0 + 0.2 * (double)random_normal(key);
    case NOISE_SKEWED: // exponential: as skewed as the light of a small lamp met by chance
        return -log(1.0 - u);
    default: // one pixel in 2000 is 100 times as bright
        return 0.95 + (u < 5e-4 ? 100.0 : 0.0) + 0.2 * (double)random_normal(key) * 0.5;
    }
}

// change: factor on the left half's radiance. Channels differ, but not in relative noise.
static NoisyPicture picture_of(NoiseKind kind, uint64_t seed, double change)
{
    NoisyPicture picture;
    assert_true(noisy_picture_make(&picture, WIDTH, HEIGHT, NULL));
    Image *rendering = image_new(WIDTH, HEIGHT, 3, NULL);
    for (uint64_t run = 0; run < RUNS; run++) {
        for (uint64_t i = 0; i < (uint64_t)3 * WIDTH * HEIGHT; i++) {
            double factor = i / 3 % WIDTH < WIDTH / 2 ? change : 1.0;
            uint64_t key = random_key(random_key(seed, run), i / 3); // channels share their noise
            rendering->pixel[i] = (float)((double)(1 + i % 3) * factor * noisy_value(kind, key));
        }
        noisy_picture_add(&picture, rendering);
    }
    image_free(rendering);
    return picture;
}

static NoiseVerdict verdict_of(NoiseKind kind, uint64_t seed, double change)
{
    NoisyPicture a = picture_of(kind, 2 * seed, change), b = picture_of(kind, 2 * seed + 1, 1.0);
    NoiseVerdict verdict;
    assert_true(noise_compare(&a, &b, ALPHA, &verdict, NULL, NULL));
    noisy_picture_clear(&a);
    noisy_picture_clear(&b);
    return verdict;
}

static void seldom_errs_on(NoiseKind kind)
{
    enum { TRIALS = 600, MOST = 14 }; // 6 expected; 14 or fewer in 99.9 of 100 such tests
    int alarms = 0;
    for (uint64_t trial = 0; trial < TRIALS; trial++) {
        alarms += verdict_of(kind, trial, 1.0).rejected > 0;
    }
    if (alarms > MOST) {
        fail_msg("%d alarms in %d trials without a cause; at most %d are to be expected", alarms,
                 TRIALS, MOST);
    }
    print_message("%d alarms in %d trials\n", alarms, TRIALS);
}

static void seldom_errs_on_normal_noise(void **state)
{
    (void)state;
    seldom_errs_on(NOISE_NORMAL);
}

static void seldom_errs_on_skewed_noise(void **state)
{
    (void)state;
    seldom_errs_on(NOISE_SKEWED);
}

static void seldom_errs_on_fireflies(void **state)
{
    (void)state;
    seldom_errs_on(NOISE_FIREFLIES);
}

// 20 % noise a pixel and 5 % over half the picture: no pixel shows it, all together do.
static void finds_a_faint_change_of_a_large_part(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 20; seed++) {
        NoiseVerdict verdict = verdict_of(NOISE_NORMAL, seed, 1.05);
        assert_true(verdict.rejected > 0 && verdict.p < ALPHA);
        assert_true(verdict.worst.x < WIDTH / 2);
        assert_true(verdict.worst.z > 0.0 && verdict.worst.a > verdict.worst.b);
    }
}

// The same noise in both pictures and a difference of one pixel: its block is named.
static void finds_a_strong_change_of_a_pixel(void **state)
{
    (void)state;
    NoisyPicture a = picture_of(NOISE_NORMAL, 7, 1.0), b = picture_of(NOISE_NORMAL, 8, 1.0);
    a.mean->pixel[3 * (20 * WIDTH + 13) + 2] += 30.0f;
    NoiseVerdict verdict;
    Image *z = NULL;
    assert_true(noise_compare(&a, &b, ALPHA, &verdict, &z, NULL));
    assert_true(verdict.rejected > 0);
    assert_int_equal(verdict.worst.x, 8);
    assert_int_equal(verdict.worst.y, 16);
    assert_int_equal(verdict.worst.size, NOISE_BLOCK);
    assert_int_equal(verdict.worst.channel, 2);
    assert_int_equal(z->width, 6);
    assert_int_equal(z->height, 4);
    assert_true(fabs((double)z->pixel[2 * 6 + 1] - verdict.worst.z) < 1e-5);
    image_free(z);
    noisy_picture_clear(&a);
    noisy_picture_clear(&b);
}

static void equal_pictures_do_not_differ(void **state)
{
    (void)state;
    NoisyPicture a = picture_of(NOISE_SKEWED, 3, 1.0);
    NoiseVerdict verdict;
    a.mean->pixel[5] = NAN; // a NaN in both is no difference
    assert_true(noise_compare(&a, &a, ALPHA, &verdict, NULL, NULL));
    assert_true(verdict.rejected == 0 && verdict.p == 1.0);
    // 6 x 4, 3 x 2, 2 x 1 and 1 blocks, of three channels
    assert_int_equal(verdict.tests, 3 * (24 + 6 + 2 + 1));
    noisy_picture_clear(&a);
}

static void a_nan_beside_a_number_differs(void **state)
{
    (void)state;
    NoisyPicture a = picture_of(NOISE_NORMAL, 3, 1.0), b = picture_of(NOISE_NORMAL, 4, 1.0);
    a.mean->pixel[3 * 40] = NAN;
    NoiseVerdict verdict;
    assert_true(noise_compare(&a, &b, ALPHA, &verdict, NULL, NULL));
    assert_true(verdict.rejected > 0 && verdict.p == 0.0);
    assert_int_equal(verdict.worst.x, 40);
    noisy_picture_clear(&a);
    noisy_picture_clear(&b);
}

static void what_other_instruction_sets_move_is_no_difference(void **state)
{
    (void)state;
    NoisyPicture a, b;
    assert_true(noisy_picture_make(&a, WIDTH, HEIGHT, NULL));
    assert_true(noisy_picture_make(&b, WIDTH, HEIGHT, NULL));
    a.runs = b.runs = RUNS; // without any noise: a plain sky
    for (int i = 0; i < 3 * WIDTH * HEIGHT; i++) {
        a.mean->pixel[i] = 3.0f;
        b.mean->pixel[i] = 3.0003f;
    }
    NoiseVerdict verdict;
    assert_true(noise_compare(&a, &b, ALPHA, &verdict, NULL, NULL));
    assert_int_equal(verdict.rejected, 0);
    for (int i = 0; i < 3 * WIDTH * HEIGHT; i++) {
        b.mean->pixel[i] = 3.03f;
    }
    assert_true(noise_compare(&a, &b, ALPHA, &verdict, NULL, NULL));
    assert_true(verdict.rejected > 0);
    noisy_picture_clear(&a);
    noisy_picture_clear(&b);
}

static void mean_and_variance_are_those_of_the_runs(void **state)
{
    (void)state;
    static const float values[5] = {1.0f, 4.0f, 2.0f, 8.0f, 5.0f}; // mean 4, squares 30
    NoisyPicture picture;
    assert_true(noisy_picture_make(&picture, 2, 1, NULL));
    for (int run = 0; run < 5; run++) {
        Image *rendering = image_new(2, 1, 3, NULL);
        rendering->pixel[4] = values[run];
        rendering->pixel[0] = 0.1f; // the same each time: no variance at all
        noisy_picture_add(&picture, rendering);
        image_free(rendering);
    }
    assert_int_equal(picture.runs, 5);
    assert_true(fabs((double)picture.mean->pixel[4] - 4.0) < 1e-6);
    assert_true(fabs((double)picture.variance->pixel[4] - 30.0 / 20.0) < 1e-6);
    assert_true(picture.mean->pixel[0] == 0.1f && picture.variance->pixel[0] == 0.0f);
    noisy_picture_clear(&picture);
}

static void reads_what_it_writes(void **state)
{
    (void)state;
    NoisyPicture a = picture_of(NOISE_SKEWED, 5, 1.0), b;
    char file[] = "/tmp/ramify_noise_XXXXXX.exr";
    close(mkstemps(file, 4));
    assert_true(noisy_picture_write(&a, file, NULL));
    assert_true(noisy_picture_read(&b, file, NULL));
    size_t size = sizeof(float) * 3 * WIDTH * HEIGHT;
    assert_int_equal(b.runs, RUNS);
    assert_memory_equal(a.mean->pixel, b.mean->pixel, size);
    assert_memory_equal(a.variance->pixel, b.variance->pixel, size);
    unlink(file);
    noisy_picture_clear(&a);
    noisy_picture_clear(&b);
}

static void refuses_an_exr_without_variances(void **state)
{
    (void)state;
    NoisyPicture picture;
    char file[] = "/tmp/ramify_noise_XXXXXX.exr";
    close(mkstemps(file, 4));
    Image *image = image_new(4, 4, 3, NULL);
    ImageLayer layer = {"", "RGB", image};
    assert_true(image_write_exr(file, &layer, 1, NULL, NULL));
    Error e = {0};
    assert_false(noisy_picture_read(&picture, file, &e));
    assert_non_null(strstr(e.message, "has no channel 'runs.V'"));
    image_free(image);
    unlink(file);
}

// From tables of the distributions.
static void students_t_is_that_of_tables(void **state)
{
    (void)state;
    assert_true(fabs(student_two_sided(12.7062, 1.0) - 0.05) < 1e-6);
    assert_true(fabs(student_two_sided(-2.2281, 10.0) - 0.05) < 1e-5);
    assert_true(fabs(student_two_sided(2.5758, 1e9) - 0.01) < 1e-6);
    assert_true(fabs(normal_of_two_sided(0.05) - 1.959964) < 1e-6);
    assert_true(normal_of_two_sided(1.0) == 0.0);
    assert_true(normal_of_two_sided(0.0) > 36.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(seldom_errs_on_normal_noise),
        cmocka_unit_test(seldom_errs_on_skewed_noise),
        cmocka_unit_test(seldom_errs_on_fireflies),
        cmocka_unit_test(finds_a_faint_change_of_a_large_part),
        cmocka_unit_test(finds_a_strong_change_of_a_pixel),
        cmocka_unit_test(equal_pictures_do_not_differ),
        cmocka_unit_test(a_nan_beside_a_number_differs),
        cmocka_unit_test(what_other_instruction_sets_move_is_no_difference),
        cmocka_unit_test(mean_and_variance_are_those_of_the_runs),
        cmocka_unit_test(reads_what_it_writes),
        cmocka_unit_test(refuses_an_exr_without_variances),
        cmocka_unit_test(students_t_is_that_of_tables),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
