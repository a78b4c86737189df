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
    SamplePlan plan;
    sample_plan_fill(&plan, 42, COUNT);
    for (uint32_t pixel = 0; pixel < 5; pixel++) {
        for (uint32_t set = 0; set < 4; set++) {
            Sampler at[COUNT];
            for (uint32_t i = 0; i < COUNT; i++) {
                at[i] = sampler_at(&plan, 3 * pixel, 7, i + COUNT * pixel);
            }
            check_elementary_intervals(at, set);
        }
    }
}

// A square of 4 pixels with 16 samples each has one point in every elementary interval as well.
static void neighbours_complete_each_other(void **state)
{
    (void)state;
    SamplePlan plan;
    sample_plan_fill(&plan, 42, 16);
    for (uint32_t set = 0; set < 4; set++) {
        Sampler at[COUNT];
        for (uint32_t i = 0; i < COUNT; i++) {
            at[i] = sampler_at(&plan, 20 + i % 4, 36 + i / 4 % 4, i / 16);
        }
        check_elementary_intervals(at, set);
    }
}

static void stratifies_each_of_four_dimensions(void **state)
{
    (void)state;
    SamplePlan plan;
    sample_plan_fill(&plan, 3, COUNT);
    for (int dimension = 0; dimension < 4; dimension++) {
        bool taken[COUNT] = {false};
        for (uint32_t i = 0; i < COUNT; i++) {
            Sampler at = sampler_at(&plan, 11, 0, i);
            float u[4];
            sampler_draw(&at, 9, u);
            int cell = (int)(u[dimension] * COUNT);
            assert_false(taken[cell]);
            taken[cell] = true;
        }
    }
}

// Products of numbers from different sets must average as if the sets knew nothing of each other;
// so must those of pixels of different blocks, and of samples beyond the planned ones.
static void sets_and_blocks_are_independent(void **state)
{
    (void)state;
    SamplePlan plan;
    enum { PIXELS = 2000, SAMPLES = 4 };
    sample_plan_fill(&plan, 1, SAMPLES);
    double across[3] = {0.0};
    for (uint32_t p = 0; p < PIXELS; p++) {
        for (uint32_t i = 0; i < SAMPLES; i++) {
            float here[4], other[3][4];
            Sampler at = sampler_at(&plan, p, 5, i), block = sampler_at(&plan, p, 21, i);
            Sampler later = sampler_at(&plan, p, 5, i + SAMPLES);
            sampler_draw(&at, 0, here);
            sampler_draw(&at, 1, other[0]);
            sampler_draw(&block, 0, other[1]);
            sampler_draw(&later, 0, other[2]);
            for (int k = 0; k < 3; k++) {
                across[k] += ((double)here[0] - 0.5) * ((double)other[k][0] - 0.5);
            }
        }
    }
    double limit = 5.0 / 12.0 / sqrt((double)PIXELS * SAMPLES); // five standard deviations
    for (int k = 0; k < 3; k++) {
        assert_true(fabs(across[k] / (PIXELS * SAMPLES)) < limit);
    }
}

// Across the end of a pixel's stretch, where a new sequence begins.
static void samplers_of_a_pixel_are_those_of_its_samples(void **state)
{
    (void)state;
    SamplePlan plan;
    sample_plan_fill(&plan, 9, 8);
    Sampler together[20];
    samplers_at(&plan, 35, 17, 5, 20, together);
    for (uint32_t i = 0; i < 20; i++) {
        Sampler alone = sampler_at(&plan, 35, 17, 5 + i);
        assert_int_equal(together[i].key, alone.key);
        assert_int_equal(together[i].reversed, alone.reversed);
        assert_int_equal(together[i].lowest, alone.lowest);
    }
    assert_int_not_equal(together[2].key, together[3].key); // samples 7 and 8
}

// The error of a pixel for a smooth integrand and one with an edge.
static double pixel_error(const SamplePlan *plan, uint32_t x, uint32_t y, int samples, bool edge)
{
    double sum = 0.0;
    for (int i = 0; i < samples; i++) {
        float u[4];
        Sampler at = sampler_at(plan, x, y, (uint32_t)i);
        sampler_draw(&at, 2, u);
        double value = edge ? (u[0] + 0.7f * u[1] < 0.6f) : (double)(u[0] * u[1] * u[1]);
        sum += value / samples;
    }
    double mean = edge ? 0.6 * 0.6 / 1.4 : 1.0 / 6.0;
    return sum - mean;
}

// Blue noise: the mean error of a square of pixels is far below that of as many independent ones,
// whose variance would be a pixel's over their number.
static void noise_is_blue_on_the_screen(void **state)
{
    (void)state;
    enum { WIDTH = 128, SAMPLES = 4 };
    SamplePlan plan;
    sample_plan_fill(&plan, 9, SAMPLES);
    for (int edge = 0; edge < 2; edge++) {
        for (int square = 2; square <= 8; square *= 2) {
            double pixels = 0.0, squares = 0.0;
            int across = WIDTH / square, corners = across * across;
            for (int corner = 0; corner < corners; corner++) {
                double mean = 0.0;
                for (int k = 0; k < square * square; k++) {
                    int x = corner % across * square + k % square;
                    int y = corner / across * square + k / square;
                    double error = pixel_error(&plan, (uint32_t)x, (uint32_t)y, SAMPLES, edge == 1);
                    pixels += error * error / (WIDTH * WIDTH);
                    mean += error / (square * square);
                }
                squares += mean * mean / corners;
            }
            double independent = pixels / (square * square);
            assert_true(squares < (square == 2 ? 0.7 : 0.5) * independent);
        }
    }
}

static double root_mean_square_error(int samples, bool edge)
{
    enum { PIXELS = 1024 };
    SamplePlan plan;
    sample_plan_fill(&plan, 4, samples);
    double sum = 0.0;
    for (uint32_t i = 0; i < PIXELS; i++) {
        double error = pixel_error(&plan, i % 32, i / 32, samples, edge);
        sum += error * error / PIXELS;
    }
    return sqrt(sum);
}

// Error ~ samples^slope. Random samples have -0.5; an Owen-scrambled net -1.5 but for a logarithm
// for a smooth integrand (Owen 1997) and -0.75 across an edge in two dimensions.
static void error_falls_faster_than_random(void **state)
{
    (void)state;
    for (int edge = 0; edge < 2; edge++) {
        double few = root_mean_square_error(4, edge), many = root_mean_square_error(256, edge);
        double slope = log(many / few) / log(256.0 / 4.0);
        print_message("slope of the error %s an edge: %.2f\n", edge ? "across" : "without", slope);
        assert_true(slope < (edge ? -0.7 : -1.3));
    }
}

// Many samplers at once draw what each draws alone, bit for bit.
static void lanes_draw_as_one(void **state)
{
    (void)state;
    SamplePlan plan;
    sample_plan_fill(&plan, 77, 100);
    SamplerLanes lanes;
    for (int round = 0; round < 200; round++) {
        Sampler at[SAMPLER_LANES];
        int count = 1 + round % SAMPLER_LANES;
        sampler_lanes_clear(&lanes);
        for (int i = 0; i < count; i++) {
            uint32_t n = (uint32_t)(round * SAMPLER_LANES + i);
            at[i] = sampler_at(&plan, n % 37, n % 23, round == 0 ? 0 : n % 300);
            sampler_lanes_put(&lanes, i, &at[i], n % 19);
        }
        sampler_lanes_draw(&plan.table, &lanes);
        for (int i = 0; i < count; i++) {
            float alone[4], together[4];
            sampler_draw(&at[i], (uint32_t)(round * SAMPLER_LANES + i) % 19, alone);
            sampler_lanes_get(&lanes, i, together);
            assert_memory_equal(alone, together, sizeof alone);
        }
    }
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
        cmocka_unit_test(neighbours_complete_each_other),
        cmocka_unit_test(sets_and_blocks_are_independent),
        cmocka_unit_test(samplers_of_a_pixel_are_those_of_its_samples),
        cmocka_unit_test(noise_is_blue_on_the_screen),
        cmocka_unit_test(error_falls_faster_than_random),
        cmocka_unit_test(lanes_draw_as_one),
        cmocka_unit_test(filter_samples_follow_the_profile),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
