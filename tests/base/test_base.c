#include "base/distance_transform.h"
#include "base/error.h"
#include "base/exact_math.h"
#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"
#include "base/vec.h"
#include "testing.h"

#include <math.h>
#include <string.h>

static void exact_functions_agree_with_libm(void **state)
{
    (void)state;
    for (int i = -2000; i <= 2000; i++) {
        float x = (float)i * 0.037f, s, c;
        exact_sincos(x, &s, &c);
        assert_true(fabs((double)s - sin((double)x)) < 1e-7);
        assert_true(fabs((double)c - cos((double)x)) < 1e-7);
        double p = exp((double)i * 0.1);
        assert_true(fabs(exact_exp((double)i * 0.1) / p - 1.0) < 1e-12);
        assert_true(fabs(exact_log(p) - (double)i * 0.1) < 1e-11);
        float y = (float)(i % 61) * 0.31f - 4.0f;
        assert_true(fabs((double)exact_atan2(y, x) - atan2((double)y, (double)x)) < 1e-6);
    }
    for (int i = 0; i <= 100; i++) {
        float x = (float)i * 0.02f - 1.0f;
        assert_true(fabs((double)exact_acos(x) - acos((double)x)) < 1e-6);
        assert_true(fabs((double)exact_pow((float)i, 0.43f) - pow(i, (double)0.43f)) < 1e-5);
    }
}

// Beyond their domains they are what IEEE arithmetic says, not whatever the bits happen to be.
static void exact_functions_have_values_everywhere(void **state)
{
    (void)state;
    const double reach[] = {-1e300, -800.0, 709.0, 709.78, 709.79, 1e4, 1e300, INFINITY, -INFINITY};
    for (size_t i = 0; i < sizeof reach / sizeof reach[0]; i++) {
        double x = reach[i], wanted = x < -700.0 ? 0.0 : exp(x);
        assert_true(exact_exp(x) == wanted || fabs(exact_exp(x) / wanted - 1.0) < 1e-12);
    }
    const double small[] = {5e-324, 1e-310, 2.2250738585072014e-308, 1.7e308};
    for (size_t i = 0; i < sizeof small / sizeof small[0]; i++) {
        assert_true(fabs(exact_log(small[i]) - log(small[i])) < 1e-11);
    }
    assert_true(exact_log(0.0) == -INFINITY && exact_log(INFINITY) == INFINITY);
    assert_true(isnan(exact_log(-1.0)) && isnan(exact_log(NAN)) && isnan(exact_exp(NAN)));
    assert_true(exact_pow(9999.0f, 1e32f) == INFINITY && exact_pow(0.5f, 1e32f) == 0.0f);
    assert_true(exact_pow(0.0f, -1.0f) == INFINITY && exact_pow(1.0f, INFINITY) == 1.0f);
    assert_true(isnan(exact_pow(NAN, 2.0f)) && isnan(exact_pow(2.0f, NAN)));
    const float far[] = {1e7f, -3e9f, 1e30f, INFINITY, NAN};
    for (size_t i = 0; i < sizeof far / sizeof far[0]; i++) {
        float s, c;
        exact_sincos(far[i], &s, &c);
        assert_true(isfinite(far[i]) ? fabsf(s * s + c * c - 1.0f) < 1e-6f : isnan(s) && isnan(c));
    }
}

static void normal_numbers_have_mean_0_and_variance_1(void **state)
{
    (void)state;
    enum { COUNT = 200000 };
    double sum = 0, square = 0, fourth = 0;
    for (uint64_t i = 0; i < COUNT; i++) {
        double x = (double)random_normal(random_key(7, i));
        sum += x;
        square += x * x;
        fourth += x * x * x * x;
    }
    assert_true(fabs(sum / COUNT) < 4.0 / sqrt(COUNT));
    assert_true(fabs(square / COUNT - 1.0) < 4.0 * sqrt(2.0 / COUNT));
    assert_true(fabs(fourth / COUNT - 3.0) < 4.0 * sqrt(96.0 / COUNT));
}

static void uniform_numbers_fill_every_bin(void **state)
{
    (void)state;
    enum { COUNT = 100000, BINS = 50 };
    double chi2 = 0;
    int bin[BINS] = {0};
    for (uint64_t i = 0; i < COUNT; i++) {
        bin[(int)(random_unit(random_key(3, i)) * BINS)]++;
    }
    for (int i = 0; i < BINS; i++) {
        double d = bin[i] - (double)COUNT / BINS;
        chi2 += d * d * BINS / COUNT;
    }
    assert_true(chi2 < 85.0); // 49 degrees of freedom: 99.9 % lie below 85.4
}

static void a_transform_and_its_inverse_cancel(void **state)
{
    (void)state;
    Transform t = transform_compose(vec3(1, -2, 3), vec3(20, 130, -75), vec3(2, 0.5f, 3));
    Transform inverse;
    assert_true(transform_inverse(&t, &inverse));
    for (uint64_t i = 0; i < 100; i++) {
        Vec3 p = vec3_scale(random_direction(i), 5.0f);
        Vec3 q = transform_point(&inverse, transform_point(&t, p));
        assert_true(vec3_distance(p, q) < 1e-5f);
    }
    Transform flat = transform_compose(vec3_splat(0), vec3_splat(0), vec3(1, 0, 1));
    assert_false(transform_inverse(&flat, &inverse));
}

static void rotations_go_counter_clockwise(void **state)
{
    (void)state;
    Transform t = transform_compose(vec3_splat(0), vec3(0, 90, 0), vec3_splat(1));
    assert_true(vec3_distance(transform_vector(&t, vec3(0, 0, 1)), vec3(1, 0, 0)) < 1e-6f);
    Vec3 r = vec3_rotate(vec3(1, 0, 0), vec3(0, 0, 1), 0.0f, 1.0f);
    assert_true(vec3_distance(r, vec3(0, 1, 0)) < 1e-6f);
}

static void noise_is_smooth_and_zero_on_the_lattice(void **state)
{
    (void)state;
    float most = 0.0f;
    for (int i = 0; i < 20000; i++) {
        float x = (float)i * 0.013f, y = (float)i * 0.0071f;
        float n = noise_plane(x, y, 5);
        most = fabsf(n) > most ? fabsf(n) : most;
        assert_true(fabsf(noise_plane(x + 1e-3f, y, 5) - n) < 5e-3f);
    }
    assert_in_range((int)(100.0f * most), 30, 100);
    assert_true(noise_plane(3.0f, -8.0f, 5) == 0.0f);
}

// Large arrays begin on a large page, else the system cannot use one; all of them can be written
// to.
static void wide_arrays_lie_on_large_pages(void **state)
{
    (void)state;
    Error e = {0};
    const int64_t counts[] = {0, 1000, (1 << 23) + 3};
    for (int i = 0; i < 3; i++) {
        char *array = memory_alloc_wide(counts[i], 1, &e);
        assert_non_null(array);
        memset(array, 7, (size_t)counts[i]);
        assert_true(counts[i] < 1 << 22 || (uintptr_t)array % (2u << 20) == 0);
        free(array);
    }
    assert_null(memory_alloc_wide(INT64_MAX / 2, 16, &e));
    assert_int_equal(e.code, ERROR_MEMORY);
}

static void absurd_allocations_are_errors(void **state)
{
    (void)state;
    Error e = {0};
    assert_null(memory_alloc(INT64_MAX / 2, 16, &e));
    assert_int_equal(e.code, ERROR_MEMORY);
    float *array = NULL;
    int64_t capacity = 0;
    assert_true(memory_reserve(&array, &capacity, 10, sizeof *array, &e));
    assert_true(capacity >= 10);
    float *before = array;
    assert_false(memory_reserve(&array, &capacity, INT64_MAX / 4, sizeof *array, &e));
    assert_ptr_equal(array, before);
    free(array);
}

static void errors_name_their_place(void **state)
{
    (void)state;
    Error e = {0};
    char text[256];
    assert_false(error_set(&e, ERROR_INPUT, "radius is %d; it must be positive", -1));
    error_prefix(&e, "object '%s': ", "oak");
    error_locate(&e, "oak.yaml", 3, 7);
    error_locate(&e, "other.yaml", 1, 1); // the first place stays
    error_format(&e, text, sizeof text);
    assert_string_equal(text, "oak.yaml:3:7: object 'oak': radius is -1; it must be positive");
    assert_false(error_set(NULL, ERROR_INPUT, "nobody listens"));
}

// Against a search through all samples, with cells that are not square.
static void test_distance_transform(void **state)
{
    (void)state;
    enum { COLUMNS = 23, ROWS = 17 };
    double squared[COLUMNS * ROWS];
    bool wanted[COLUMNS * ROWS];
    for (int sparse = 0; sparse < 3; sparse++) { // none at all last
        for (int i = 0; i < COLUMNS * ROWS; i++) {
            const float share[] = {0.3f, 0.01f, 0.0f};
            wanted[i] = random_unit(random_key(17, (uint64_t)i)) < share[sparse];
            squared[i] = wanted[i] ? 0.0 : INFINITY;
        }
        assert_true(distance_transform(squared, COLUMNS, ROWS, 0.5, 1.25, NULL));
        for (int i = 0; i < COLUMNS * ROWS; i++) {
            double least = INFINITY;
            for (int j = 0; j < COLUMNS * ROWS; j++) {
                double x = 0.5 * (i % COLUMNS - j % COLUMNS),
                       y = 1.25 * (i / COLUMNS - j / COLUMNS);
                least = wanted[j] && x * x + y * y < least ? x * x + y * y : least;
            }
            assert_true(squared[i] == least || fabs(squared[i] - least) < 1e-9);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exact_functions_agree_with_libm),
        cmocka_unit_test(exact_functions_have_values_everywhere),
        cmocka_unit_test(normal_numbers_have_mean_0_and_variance_1),
        cmocka_unit_test(uniform_numbers_fill_every_bin),
        cmocka_unit_test(a_transform_and_its_inverse_cancel),
        cmocka_unit_test(rotations_go_counter_clockwise),
        cmocka_unit_test(noise_is_smooth_and_zero_on_the_lattice),
        cmocka_unit_test(wide_arrays_lie_on_large_pages),
        cmocka_unit_test(absurd_allocations_are_errors),
        cmocka_unit_test(test_distance_transform),
        cmocka_unit_test(errors_name_their_place),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
