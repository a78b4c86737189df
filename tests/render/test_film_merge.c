// A film's sums are exact: of any order and division, of any magnitudes, of as many samples as a
// scene may ask for.
#include "base/memory.h"
#include "base/random.h"
#include "render/film_merge.h"
#include "testing.h"

#include <math.h>
#include <string.h>

enum { SAMPLES = 1000 };

// Radiances of 1e-9 to 1e5 beside each other.
static PathResult path_of(int k)
{
    uint64_t key = random_key(7, (uint64_t)k);
    float scale = exp10f(-9.0f + 14.0f * random_unit(random_key(key, 1)));
    Vec3 v = vec3(random_unit(random_key(key, 2)), random_unit(random_key(key, 3)),
                  random_unit(random_key(key, 4)));
    return (PathResult){.color = vec3_scale(v, scale),
                        .alpha = v.x,
                        .rays = 1,
                        .seen = (SeenKind)(k % 3),
                        .sharpness = v.y,
                        .hit = k % 4 != 0,
                        .albedo = v,
                        .normal = vec3_sub(vec3_splat(0.5f), v),
                        .position = vec3_scale(vec3_sub(v, vec3_splat(0.5f)), 1e4f * scale),
                        .depth = 100.0f * v.z,
                        .object = k % 5};
}

static void add(Film *film, int64_t pixel, int begin, int end)
{
    while (begin < end) {
        PathSum paths = {.samples = 0};
        for (int k = 0; k < MOST_ADDED && begin < end; k++) {
            PathResult path = path_of(begin++);
            path_sum_add(&paths, &path, 1);
        }
        PixelSum sum;
        film_sum(film, pixel, &sum);
        pixel_sum_add(&sum, &paths);
        film_set(film, pixel, &sum);
    }
}

static void assert_same_pixels(const Film *film, int64_t a, int64_t b)
{
    FilmPlane plane[FILM_PLANES];
    film_planes(film, plane);
    for (int i = 0; i < FILM_PLANES; i++) {
        size_t channels = strlen(plane[i].channels);
        if (memcmp(plane[i].value + a * (int64_t)channels, plane[i].value + b * (int64_t)channels,
                   channels * sizeof(float)) != 0) {
            fail_msg("plane %s differs", plane[i].layer);
        }
    }
}

static void order_and_division_change_no_bit(void **state)
{
    (void)state;
    Film *film = film_new(4, 1, NULL);
    assert_non_null(film);
    add(film, 0, 0, SAMPLES);
    for (int split = 1; split < SAMPLES; split += 97) {
        film_forget(film, (const float[4]){0.25f, 0.0f, 1.0f, 1.0f});
        add(film, 1, 0, split);
        add(film, 1, split, SAMPLES); // in passes that end elsewhere
        assert_same_pixels(film, 0, 1);
        add(film, 2, 0, split);
        add(film, 3, split, SAMPLES);
        PixelSum a, b;
        film_sum(film, 2, &a);
        film_sum(film, 3, &b);
        int object = a.hits > 0 ? a.object : b.object;
        pixel_sum_join(&b, &a); // the later first
        b.object = object;
        film_set(film, 3, &b);
        assert_same_pixels(film, 0, 3);
    }
    film_free(film);
}

static void means_and_variance_are_right(void **state)
{
    (void)state;
    Film *film = film_new(1, 1, NULL);
    assert_non_null(film);
    add(film, 0, 0, SAMPLES);
    long double red = 0.0L, squares = 0.0L, luminance = 0.0L, depth = 0.0L;
    int hits = 0;
    for (int k = 0; k < SAMPLES; k++) {
        PathResult path = path_of(k);
        long double l = 0.2126L * (long double)path.color.x + 0.7152L * (long double)path.color.y +
                        0.0722L * (long double)path.color.z;
        red += (long double)path.color.x;
        luminance += l;
        squares += l * l;
        depth += path.hit ? (long double)path.depth : 0.0L;
        hits += path.hit;
    }
    long double n = SAMPLES;
    double variance = (double)((squares - luminance * luminance / n) / (n * (n - 1.0L)));
    assert_true(fabs((double)film->color[0].x * SAMPLES / (double)red - 1.0) < 1e-7);
    assert_true(fabs((double)film->depth[0] * hits / (double)depth - 1.0) < 1e-7);
    assert_true(fabs((double)film->variance[0] / variance - 1.0) < 1e-6);
    assert_true(film->hits[0] == (float)hits && film->samples[0] == (float)SAMPLES);
    film_free(film);
}

static void equal_samples_have_no_variance(void **state)
{
    (void)state;
    Film *film = film_new(1, 1, NULL);
    assert_non_null(film);
    PathResult path = {.color = {0.3f, 1.7f, 0.01f}, .albedo = {1, 1, 1}};
    PathSum paths = {.samples = 0};
    PixelSum sum = {.samples = 0};
    for (int k = 0; k < MOST_ADDED; k++) {
        path_sum_add(&paths, &path, 1);
    }
    pixel_sum_add(&sum, &paths);
    film_set(film, 0, &sum);
    assert_true(film->variance[0] < 1e-15f);
    assert_true(fabsf(film->color[0].x - 0.3f) < 1e-8f);
    film_free(film);
}

// What is brighter than the limit counts as the limit; nothing overflows.
static void fireflies_are_limited(void **state)
{
    (void)state;
    const float bright[] = {1e6f, 1e30f, INFINITY};
    Film *film = film_new(1, 1, NULL);
    assert_non_null(film);
    for (int i = 0; i < 3; i++) {
        PathResult path = {.color = vec3_splat(bright[i])}, dark = {.color = vec3_splat(0.5f)};
        PathSum paths = {.samples = 0};
        PixelSum sum = {.samples = 0};
        path_sum_add(&paths, &path, 1);
        path_sum_add(&paths, &dark, 1);
        pixel_sum_add(&sum, &paths);
        film_set(film, 0, &sum);
        assert_true(film->color[0].y == 0x1p18f + 0.25f);
        assert_true(isfinite(film->variance[0]) && film_is_sound(film, 0));
    }
    film_free(film);
}

// Sums of 2^24 samples at the limits come back as they were.
static void the_greatest_sums_are_kept(void **state)
{
    (void)state;
    Film *film = film_new(1, 1, NULL);
    assert_non_null(film);
    for (int less = 0; less < 200; less++) {
        PixelSum sum = {.samples = 1 << 24, .hits = (1 << 24) - less}, back;
        for (int c = 0; c < FILM_CHANNELS - 2; c++) {
            uint64_t noise = random_key((uint64_t)less, (uint64_t)c);
            WideInt wide = ((WideInt)1 << (24 + 19 + 28)) - (WideInt)(noise >> 1);
            WideInt unit = ((WideInt)1 << (24 + 24)) - (WideInt)(noise >> 20);
            bool is_wide = c < 13, of_hits = c >= 9 && c < 13;
            sum.mean[c] = (is_wide ? wide : unit) - (of_hits ? (WideInt)less << 47 : 0);
            sum.mean[c] = less % 2 ? -sum.mean[c] : sum.mean[c];
        }
        sum.squares = ((WideUint)1 << 110) + random_key(3, (uint64_t)less);
        film_set(film, 0, &sum);
        assert_true(film_is_sound(film, 0));
        film_sum(film, 0, &back);
        assert_memory_equal(sum.mean, back.mean, sizeof sum.mean);
        assert_true(sum.squares == back.squares && sum.samples == back.samples &&
                    sum.hits == back.hits && sum.object == back.object);
    }
    film_free(film);
}

static void damage_is_seen(void **state)
{
    (void)state;
    Film *film = film_new(1, 1, NULL);
    assert_non_null(film);
    add(film, 0, 0, 100);
    float *const value[] = {&film->samples[0],
                            &film->hits[0],
                            &film->object[0],
                            &film->color[0].y,
                            &film->depth[0],
                            &film->rest[MEAN_SKY][1][2],
                            &film->rest[MEAN_ALPHA][0][0],
                            &film->squares[4]};
    for (size_t i = 0; i < sizeof value / sizeof *value; i++) {
        const float wrong[] = {NAN, INFINITY, -0x1p60f, 0x1p60f};
        float right = *value[i];
        assert_true(film_is_sound(film, 0));
        for (int k = 0; k < 4; k++) {
            *value[i] = wrong[k];
            assert_false(film_is_sound(film, 0));
        }
        *value[i] = right;
    }
    film->rest[MEAN_COLOR][0][0] = 0.5f; // quanta are whole
    assert_false(film_is_sound(film, 0));
    film_free(film);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(order_and_division_change_no_bit),
        cmocka_unit_test(means_and_variance_are_right),
        cmocka_unit_test(equal_samples_have_no_variance),
        cmocka_unit_test(fireflies_are_limited),
        cmocka_unit_test(the_greatest_sums_are_kept),
        cmocka_unit_test(damage_is_seen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
