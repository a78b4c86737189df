// The sampler is a (0, 2)-sequence whatever the scrambling; filters are sampled as they look.
#include "tiny_world.h"

#include "render/filter.h"
#include "render/sampler.h"

enum { BITS = 8, COUNT = 1 << BITS };

// Every elementary interval of area 1 / COUNT, of any shape, holds exactly one of COUNT points.
static void check_elementary_intervals(const Sampler *at, uint32_t set)
{
    for (int wide = 0; wide <= BITS; wide++) {
        bool taken[COUNT] = {false};
        for (int i = 0; i < COUNT; i++) {
            float u[4];
            sampler_draw(&at[i], set, u);
            assert_in_range((int)(u[0] * 65536.0f), 0, 65535);
            int x = (int)(u[0] * (float)(1 << wide)), y = (int)(u[1] * (float)(COUNT >> wide));
            int cell = y * (1 << wide) + x;
            assert_false(taken[cell]);
            taken[cell] = true;
        }
    }
}

static void fills_every_elementary_interval_once(void **state)
{
    (void)state;
    SobolTable table;
    sobol_table_fill(&table);
    for (uint32_t pixel = 0; pixel < 5; pixel++) {
        for (uint32_t set = 0; set < 4; set++) {
            Sampler at[COUNT];
            for (uint32_t i = 0; i < COUNT; i++) {
                at[i] = sampler_at(&table, 42, pixel, i + COUNT * pixel);
            }
            check_elementary_intervals(at, set);
        }
    }
}

static void stratifies_each_of_four_dimensions(void **state)
{
    (void)state;
    SobolTable table;
    sobol_table_fill(&table);
    for (int dimension = 0; dimension < 4; dimension++) {
        bool taken[COUNT] = {false};
        for (uint32_t i = 0; i < COUNT; i++) {
            Sampler at = sampler_at(&table, 3, 11, i);
            float u[4];
            sampler_draw(&at, 9, u);
            int cell = (int)(u[dimension] * COUNT);
            assert_false(taken[cell]);
            taken[cell] = true;
        }
    }
}

// Products of numbers from different sets must average as if the sets knew nothing of each other.
static void sets_and_pixels_are_independent(void **state)
{
    (void)state;
    SobolTable table;
    sobol_table_fill(&table);
    double across_sets = 0.0, across_pixels = 0.0;
    enum { PIXELS = 2000, SAMPLES = 4 };
    for (uint32_t p = 0; p < PIXELS; p++) {
        for (uint32_t i = 0; i < SAMPLES; i++) {
            float a[4], b[4], c[4];
            Sampler here = sampler_at(&table, 1, p, i), next = sampler_at(&table, 1, p + 1, i);
            sampler_draw(&here, 0, a);
            sampler_draw(&here, 1, b);
            sampler_draw(&next, 0, c);
            across_sets += ((double)a[0] - 0.5) * ((double)b[0] - 0.5);
            across_pixels += ((double)a[0] - 0.5) * ((double)c[0] - 0.5);
        }
    }
    double limit = 5.0 / 12.0 / sqrt((double)PIXELS * SAMPLES); // five standard deviations
    assert_true(fabs(across_sets / (PIXELS * SAMPLES)) < limit);
    assert_true(fabs(across_pixels / (PIXELS * SAMPLES)) < limit);
}

// Offsets drawn at even numbers make the filter's own profile: compared by its variance and by its
// share in the middle half, both integrated independently.
static void filter_samples_follow_the_profile(void **state)
{
    (void)state;
    const FilterKind kinds[] = {FILTER_BLACKMAN_HARRIS, FILTER_BOX, FILTER_GAUSSIAN};
    for (int k = 0; k < 3; k++) {
        Filter filter;
        filter_fill(&filter, kinds[k], 1.5f);
        double total = 0.0, second = 0.0, middle = 0.0, drawn_second = 0.0, drawn_middle = 0.0;
        enum { N = 20000 };
        for (int i = 0; i < N; i++) {
            float x = (2.0f * (float)i + 1.0f) / N - 1.0f;
            double w = (double)filter_profile(kinds[k], x);
            total += w;
            second += w * (double)x * (double)x;
            middle += fabsf(x) < 0.5f ? w : 0.0;
            float drawn = filter_sample(&filter, ((float)i + 0.5f) / N) / 1.5f;
            assert_true(fabsf(drawn) <= 1.0f);
            drawn_second += (double)drawn * (double)drawn / N;
            drawn_middle += fabsf(drawn) < 0.5f ? 1.0 / N : 0.0;
        }
        assert_true(fabs(drawn_second - second / total) < 0.002);
        assert_true(fabs(drawn_middle - middle / total) < 0.004);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fills_every_elementary_interval_once),
        cmocka_unit_test(stratifies_each_of_four_dimensions),
        cmocka_unit_test(sets_and_pixels_are_independent),
        cmocka_unit_test(filter_samples_follow_the_profile),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
