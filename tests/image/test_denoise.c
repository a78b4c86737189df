// The denoiser on a made scene: a striped wall, a checkered floor and a field of thin bars.
#include "image/denoise.h"

#include "base/random.h"
#include "image/compare.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 160, HEIGHT = 120 };

typedef struct Scene {
    Image *truth, *noisy, *albedo, *normal, *depth, *variance;
} Scene;

static void set_pixel(Image *image, int x, int y, float a, float b, float c)
{
    float v[3] = {a, b, c};
    memcpy(image->pixel + (y * image->width + x) * image->channels, v,
           (size_t)image->channels * sizeof(float));
}

// What is at a pixel: sky above, a wall, a floor, and bars one pixel wide in front of the sky.
static void describe(Scene *s, int x, int y)
{
    bool sky = y < 40, bar = sky && x % 4 == 0, wall = !sky && y < 80;
    float light = 0.5f + 0.5f * (float)x / WIDTH;
    if (sky && !bar) {
        set_pixel(s->albedo, x, y, 1, 1, 1);
        set_pixel(s->normal, x, y, 0, 0, 0);
        set_pixel(s->depth, x, y, INFINITY, 0, 0);
        set_pixel(s->truth, x, y, 0.6f, 0.8f, 1.2f);
        return;
    }
    float a = bar ? 0.1f : wall ? (x / 3 % 2 ? 0.6f : 0.3f) : ((x / 5 + y / 5) % 2 ? 0.7f : 0.2f);
    set_pixel(s->albedo, x, y, a, 0.8f * a, 0.5f * a);
    set_pixel(s->normal, x, y, 0, wall || bar ? 0.0f : 1.0f, wall || bar ? 1.0f : 0.0f);
    set_pixel(s->depth, x, y, bar ? 4.0f : wall ? 8.0f : 6.0f, 0, 0);
    float lit = light * (wall ? 1.0f : 0.7f);
    set_pixel(s->truth, x, y, a * lit, 0.8f * a * lit, 0.5f * a * lit);
}

// Noise in proportion to the pixel, but for the sky, which is clean, as a renderer's is.
static Scene make_scene(float noise)
{
    Scene s = {image_new(WIDTH, HEIGHT, 3, NULL), image_new(WIDTH, HEIGHT, 3, NULL),
               image_new(WIDTH, HEIGHT, 3, NULL), image_new(WIDTH, HEIGHT, 3, NULL),
               image_new(WIDTH, HEIGHT, 1, NULL), image_new(WIDTH, HEIGHT, 1, NULL)};
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            describe(&s, x, y);
            int64_t i = y * WIDTH + x;
            const float *t = s.truth->pixel + 3 * i;
            float level = isinf(s.depth->pixel[i]) ? 0.0f : noise;
            float n = 1.0f + level * random_normal(random_key(5, (uint64_t)i));
            set_pixel(s.noisy, x, y, t[0] * n, t[1] * n, t[2] * n);
            float bright = (0.2126f * t[0] + 0.7152f * t[1] + 0.0722f * t[2]) * level;
            s.variance->pixel[i] = bright * bright;
        }
    }
    return s;
}

static void free_scene(Scene *s)
{
    image_free(s->truth);
    image_free(s->noisy);
    image_free(s->albedo);
    image_free(s->normal);
    image_free(s->depth);
    image_free(s->variance);
}

static Image *denoise(const Scene *s, float strength, int threads)
{
    Run run = run_default();
    run.threads = threads;
    return image_denoise(
        &(DenoiseInput){s->noisy, s->albedo, s->normal, s->depth, s->variance, NULL, NULL},
        strength, &run, NULL);
}

static double rmse(const Image *a, const Image *b)
{
    ImageDifference d;
    assert_true(image_compare(a, b, 0.0, &d, NULL));
    return d.rmse;
}

static void test_less_noise(void **state)
{
    (void)state;
    Scene s = make_scene(0.3f);
    Image *out = denoise(&s, 1.0f, 1);
    assert_non_null(out);
    double before = rmse(s.noisy, s.truth), after = rmse(out, s.truth);
    if (after > 0.3 * before) {
        fail_msg("rmse %g before, %g after", before, after);
    }
    image_free(out);
    free_scene(&s);
}

// Fog of few samples: noise as large as the light itself. What is left is judged by the means of
// blocks wider than the filter's window reaches from their middles, where it would show as
// blotches. One scale alone leaves 0.021.
static void test_no_blotches_in_fog(void **state)
{
    (void)state;
    enum { BLOCK = 20 };
    Scene s = make_scene(0.0f);
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            int64_t i = y * WIDTH + x;
            float light = 0.4f + 0.1f * (float)x / WIDTH,
                  n = random_normal(random_key(6, (uint64_t)i));
            float seen = light * (1.0f + n);
            set_pixel(s.truth, x, y, light, light, light);
            set_pixel(s.noisy, x, y, seen, seen, seen);
            set_pixel(s.albedo, x, y, 1, 1, 1);
            set_pixel(s.normal, x, y, 0, 0, 0);
            set_pixel(s.depth, x, y, INFINITY, 0, 0);
            s.variance->pixel[i] = light * light;
        }
    }
    Image *out = denoise(&s, 1.0f, 2);
    assert_non_null(out);
    double square = 0.0, mean = 0.0;
    for (int block = 0; block < WIDTH / BLOCK * (HEIGHT / BLOCK); block++) {
        double off = 0.0;
        for (int k = 0; k < BLOCK * BLOCK; k++) {
            int x = block % (WIDTH / BLOCK) * BLOCK + k % BLOCK;
            int y = block / (WIDTH / BLOCK) * BLOCK + k / BLOCK;
            int64_t i = 3 * (int64_t)(y * WIDTH + x);
            off += (double)(out->pixel[i] - s.truth->pixel[i]) / (BLOCK * BLOCK);
        }
        square += off * off;
        mean += off;
    }
    double blocks = WIDTH / BLOCK * (HEIGHT / BLOCK);
    double blotches = sqrt(square / blocks - mean * mean / (blocks * blocks));
    if (blotches > 0.016 || fabs(mean / blocks) > 0.005) {
        fail_msg("blotches of %g about %g", blotches, mean / blocks);
    }
    image_free(out);
    free_scene(&s);
}

// A lit body before a dark sky: no pixel of its outline, part body and part sky, comes out brighter
// than the body.
static void test_silhouettes_do_not_glow(void **state)
{
    (void)state;
    Scene s = make_scene(0.0f);
    const float sky = 0.03f, body = 0.3f;
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            int64_t i = y * WIDTH + x;
            float edge = 60.0f + 0.3f * (float)y;
            float share = fminf(fmaxf((float)x - edge, 0.0f), 1.0f); // of the pixel that is body
            float n = random_normal(random_key(9, (uint64_t)i));
            float seen = sky + (body * (1.0f + 0.2f * n) - sky) * share;
            float a = 1.0f + (0.2f - 1.0f) * share;
            set_pixel(s.noisy, x, y, seen, seen, seen);
            set_pixel(s.albedo, x, y, a, a, a);
            set_pixel(s.normal, x, y, 0, 0, share);
            set_pixel(s.depth, x, y, share > 0.0f ? 5.0f : INFINITY, 0, 0);
            float spread =
                0.2f * body * share + 0.25f * (body - sky) * share * (1.0f - share) * 4.0f;
            s.variance->pixel[i] = spread * spread;
        }
    }
    Image *out = denoise(&s, 1.0f, 1);
    for (int64_t i = 0; i < (int64_t)WIDTH * HEIGHT; i++) {
        if (out->pixel[3 * i] > 1.35f * body) {
            fail_msg("%g at %d, %d", (double)out->pixel[3 * i], (int)(i % WIDTH), (int)(i / WIDTH));
        }
    }
    image_free(out);
    free_scene(&s);
}

// Stripes, checks and bars keep their contrast: the mean over light ones and over dark ones.
static void test_keeps_edges(void **state)
{
    (void)state;
    Scene s = make_scene(0.3f);
    Image *out = denoise(&s, 1.0f, 1);
    double error = 0.0, reference = 0.0;
    for (int y = 2; y < HEIGHT - 2; y++) {
        for (int x = 1; x < WIDTH - 1; x++) {
            const float *p = out->pixel + 3 * (y * WIDTH + x);
            const float *t = s.truth->pixel + 3 * (y * WIDTH + x);
            double step = (double)(t[3] - t[0]);
            if (fabs(step) > 0.1) {
                error += ((double)(p[3] - p[0]) - step) / step;
                reference += 1.0;
            }
        }
    }
    assert_true(reference > 1000.0);
    assert_true(fabs(error / reference) < 0.03);
    image_free(out);
    free_scene(&s);
}

static void test_clean_stays(void **state)
{
    (void)state;
    Scene s = make_scene(0.0f);
    Image *out = denoise(&s, 1.0f, 1);
    assert_true(rmse(out, s.truth) < 1e-5);
    image_free(out);
    free_scene(&s);
}

static void test_threads_agree(void **state)
{
    (void)state;
    Scene s = make_scene(0.2f);
    Image *one = denoise(&s, 1.0f, 1), *three = denoise(&s, 1.0f, 3);
    assert_memory_equal(one->pixel, three->pixel, sizeof(float) * 3 * WIDTH * HEIGHT);
    image_free(one);
    image_free(three);
    free_scene(&s);
}

static void test_strength_zero_copies(void **state)
{
    (void)state;
    Scene s = make_scene(0.2f);
    Image *out = denoise(&s, 0.0f, 1);
    assert_memory_equal(out->pixel, s.noisy->pixel, sizeof(float) * 3 * WIDTH * HEIGHT);
    image_free(out);
    free_scene(&s);
}

static void test_refuses_and_stops(void **state)
{
    (void)state;
    Scene s = make_scene(0.2f);
    Run run = run_default();
    Error e = {0};
    assert_null(
        image_denoise(&(DenoiseInput){s.noisy, s.depth, s.normal, s.depth, s.variance, NULL, NULL},
                      1.0f, &run, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    volatile int cancelled = 1;
    run.cancelled = &cancelled;
    assert_null(
        image_denoise(&(DenoiseInput){s.noisy, s.albedo, s.normal, s.depth, s.variance, NULL, NULL},
                      1.0f, &run, &e));
    assert_int_equal(e.code, ERROR_CANCELLED);
    free_scene(&s);
}

// Few samples, of which some are twenty times as bright: the variance of a pixel without one comes
// out far too small. Told how few they are, the denoiser trusts it less. Non-local means alone
// leave 0.055, or 0.102 if they are not told.
static void test_variance_of_few_samples(void **state)
{
    (void)state;
    enum { SAMPLES = 8 };
    Scene s = make_scene(0.0f);
    Image *samples = image_new(WIDTH, HEIGHT, 1, NULL);
    for (int64_t i = 0; i < (int64_t)WIDTH * HEIGHT; i++) {
        float sum = 0.0f, squares = 0.0f;
        for (uint64_t k = 0; k < SAMPLES; k++) {
            float u = random_unit(random_key(random_key(11, (uint64_t)i), k));
            float sample = (u < 0.05f ? 20.0f : 1.0f) / 1.95f;
            sum += sample / SAMPLES;
            squares += sample * sample / SAMPLES;
        }
        const float *t = s.truth->pixel + 3 * i;
        set_pixel(s.noisy, (int)(i % WIDTH), (int)(i / WIDTH), t[0] * sum, t[1] * sum, t[2] * sum);
        float bright = 0.2126f * t[0] + 0.7152f * t[1] + 0.0722f * t[2];
        s.variance->pixel[i] = bright * bright * (squares - sum * sum) / (SAMPLES - 1);
        samples->pixel[i] = SAMPLES;
    }
    Run run = run_default();
    DenoiseInput input = {s.noisy, s.albedo, s.normal, s.depth, s.variance, NULL, NULL};
    Image *trusting = image_denoise(&input, 1.0f, &run, NULL);
    input.samples = samples;
    Image *wary = image_denoise(&input, 1.0f, &run, NULL);
    assert_true(trusting && wary);
    double before = rmse(trusting, s.truth), after = rmse(wary, s.truth);
    if (after > 0.044 || after > 0.9 * before) {
        fail_msg("rmse %g if the variance is trusted, %g if not", before, after);
    }
    image_free(trusting);
    image_free(wary);
    image_free(samples);
    free_scene(&s);
}

// Rare white glints on a grey leaf and on a green one of the same luminance, with the same noise.
// What is left of it must be the same: white light is bright in the channels that a green leaf
// absorbs, after it has been divided by the leaf's colour.
static double glints_left(const float albedo[3])
{
    enum { SAMPLES = 16 };
    Scene s = make_scene(0.0f);
    Image *samples = image_new(WIDTH, HEIGHT, 1, NULL);
    const float level = 0.02f, glint = 2.0f, share = 0.005f; // of a sample
    for (int64_t i = 0; i < (int64_t)WIDTH * HEIGHT; i++) {
        int x = (int)(i % WIDTH), y = (int)(i / WIDTH), glints = 0;
        for (uint64_t k = 0; k < SAMPLES; k++) {
            glints += random_unit(random_key(random_key(12, (uint64_t)i), k)) < share;
        }
        float met = (float)glints / SAMPLES, white = glint * met, mean = glint * share;
        float variance = glint * glint * met * (1.0f - met) / (SAMPLES - 1);
        set_pixel(s.noisy, x, y, level * albedo[0] + white, level * albedo[1] + white,
                  level * albedo[2] + white);
        set_pixel(s.truth, x, y, level * albedo[0] + mean, level * albedo[1] + mean,
                  level * albedo[2] + mean);
        set_pixel(s.albedo, x, y, albedo[0], albedo[1], albedo[2]);
        set_pixel(s.normal, x, y, 0, 0, 1);
        set_pixel(s.depth, x, y, 3.0f, 0, 0);
        s.variance->pixel[i] = variance;
        samples->pixel[i] = SAMPLES;
    }
    Run run = run_default();
    DenoiseInput input = {s.noisy, s.albedo, s.normal, s.depth, s.variance, samples, NULL};
    Image *out = image_denoise(&input, 1.0f, &run, NULL);
    assert_non_null(out);
    double left = rmse(out, s.truth) / rmse(s.noisy, s.truth);
    image_free(out);
    image_free(samples);
    free_scene(&s);
    return left;
}

static void test_white_glints_on_colour(void **state)
{
    (void)state;
    double grey = glints_left((float[3]){0.24f, 0.24f, 0.24f});
    double green = glints_left((float[3]){0.13f, 0.29f, 0.05f});
    double red = glints_left((float[3]){0.7f, 0.12f, 0.07f});
    if (green > 1.6 * grey || red > 1.6 * grey) {
        fail_msg("noise left: %g on grey, %g on green, %g on red", grey, green, red);
    }
}

// Glints of the sun on water: of few samples some pixels have met many and most have met none.
static Scene make_glints(int samples, float share, float bright)
{
    Scene s = make_scene(0.0f);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        int x = i % WIDTH, y = i / WIDTH, glints = 0;
        for (int k = 0; k < samples; k++) {
            glints += random_unit(random_key(11, (uint64_t)(i * samples + k))) < share;
        }
        float part = (float)glints / (float)samples, color = 0.06f + bright * part;
        set_pixel(s.albedo, x, y, 1, 1, 1);
        set_pixel(s.normal, x, y, 0, 1, 0);
        set_pixel(s.noisy, x, y, color, color, color);
        s.variance->pixel[i] = 1e-5f + bright * bright * part * (1.0f - part) / (float)samples;
        s.depth->pixel[i] = 5.0f;
    }
    return s;
}

// What lies between glints gets no darker than it is without any.
static void test_no_holes_beside_glints(void **state)
{
    (void)state;
    Scene s = make_glints(6, 0.05f, 200.0f);
    Image *out = denoise(&s, 1.0f, 2);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        assert_true(out->pixel[3 * i] >= 0.06f);
    }
    image_free(out);
    free_scene(&s);
}

// Smaller than the search window, with broken pixels and alpha.
// A wood out of focus beside a striped wall: samples meet leaves or sky at random, so that albedo,
// normal and colour of a pixel share the noise of what it happened to meet.
static Scene make_blurred(int samples)
{
    Scene s = make_scene(0.0f);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        int x = i % WIDTH, y = i / WIDTH;
        if (x < WIDTH / 2) {
            float wall = y / 3 % 2 ? 0.6f : 0.3f;
            set_pixel(s.albedo, x, y, wall, wall, wall);
            set_pixel(s.normal, x, y, 0, 0, 1);
            set_pixel(s.truth, x, y, wall, wall, wall);
            set_pixel(s.noisy, x, y, wall, wall, wall);
            s.variance->pixel[i] = 0.0f;
        } else {
            int leaves = 0;
            for (int k = 0; k < samples; k++) {
                leaves += random_unit(random_key(9, (uint64_t)(i * samples + k))) < 0.5f;
            }
            float share = (float)leaves / (float)samples, albedo = 1.0f - 0.8f * share;
            float color = 1.0f - 0.9f * share, n = (float)(samples - 1);
            set_pixel(s.albedo, x, y, albedo, albedo, albedo);
            set_pixel(s.normal, x, y, 0, share, 0);
            set_pixel(s.noisy, x, y, color, color, color);
            set_pixel(s.truth, x, y, 0.55f, 0.55f, 0.55f);
            s.variance->pixel[i] = 0.81f * share * (1.0f - share) / n;
        }
        s.depth->pixel[i] = 5.0f;
    }
    return s;
}

static double error_of(const Image *image, const Image *truth, int from, int to)
{
    double sum = 0.0;
    for (int y = 4; y < HEIGHT - 4; y++) {
        for (int x = from; x < to; x++) {
            double d =
                (double)(image->pixel[3 * (y * WIDTH + x)] - truth->pixel[3 * (y * WIDTH + x)]);
            sum += d * d / ((HEIGHT - 8.0) * (to - from));
        }
    }
    return sqrt(sum);
}

// With the variance of its guides the blurred wood is smooth, where it kept its stipple; the wall,
// whose guides have none, keeps its stripes.
static void test_noise_of_guides(void **state)
{
    (void)state;
    Scene s = make_blurred(12);
    Image *guide_variance = image_new(WIDTH, HEIGHT, 2, NULL);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        float share = s.normal->pixel[3 * i + 1], spread = share * (1.0f - share) / 11.0f;
        bool wood = i % WIDTH >= WIDTH / 2;
        guide_variance->pixel[2 * i] = wood ? 0.64f * spread : 0.0f;
        guide_variance->pixel[2 * i + 1] = wood ? spread : 0.0f;
    }
    const Run run = run_default();
    DenoiseInput input = {.color = s.noisy,
                          .albedo = s.albedo,
                          .normal = s.normal,
                          .depth = s.depth,
                          .variance = s.variance};
    Image *plain = image_denoise(&input, 1.0f, &run, NULL);
    input.guide_variance = guide_variance;
    Image *guided = image_denoise(&input, 1.0f, &run, NULL);
    Run one = run;
    one.threads = 1;
    Image *alone = image_denoise(&input, 1.0f, &one, NULL);
    double before = error_of(plain, s.truth, WIDTH / 2 + 8, WIDTH);
    double after = error_of(guided, s.truth, WIDTH / 2 + 8, WIDTH);
    assert_true(before > 0.12); // all of it
    assert_true(after < 0.45 * before);
    assert_true(error_of(guided, s.truth, 0, WIDTH / 2 - 4) < 1e-3);
    assert_memory_equal(guided->pixel, alone->pixel, WIDTH * HEIGHT * 3 * sizeof(float));
    image_free(plain);
    image_free(guided);
    image_free(alone);
    image_free(guide_variance);
    free_scene(&s);
}

static void test_tiny_image(void **state)
{
    (void)state;
    Image *color = image_new(3, 2, 4, NULL), *albedo = image_new(3, 2, 3, NULL);
    Image *normal = image_new(3, 2, 3, NULL), *depth = image_new(3, 2, 1, NULL);
    Image *variance = image_new(3, 2, 1, NULL);
    for (int i = 0; i < 6; i++) {
        color->pixel[4 * i] = i == 2 ? NAN : 1.0f;
        color->pixel[4 * i + 3] = 0.5f;
        variance->pixel[i] = i == 4 ? INFINITY : 0.1f;
        depth->pixel[i] = 1.0f;
    }
    Run run = run_default();
    Image *out = image_denoise(&(DenoiseInput){color, albedo, normal, depth, variance, NULL, NULL},
                               1.0f, &run, NULL);
    assert_non_null(out);
    for (int i = 0; i < 6; i++) {
        assert_true(out->pixel[4 * i] >= 0.0f && out->pixel[4 * i] <= 1.0f);
        assert_true(out->pixel[4 * i + 3] == 0.5f);
    }
    image_free(color);
    image_free(albedo);
    image_free(normal);
    image_free(depth);
    image_free(variance);
    image_free(out);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_less_noise),
        cmocka_unit_test(test_no_blotches_in_fog),
        cmocka_unit_test(test_keeps_edges),
        cmocka_unit_test(test_clean_stays),
        cmocka_unit_test(test_threads_agree),
        cmocka_unit_test(test_strength_zero_copies),
        cmocka_unit_test(test_refuses_and_stops),
        cmocka_unit_test(test_variance_of_few_samples),
        cmocka_unit_test(test_white_glints_on_colour),
        cmocka_unit_test(test_no_holes_beside_glints),
        cmocka_unit_test(test_noise_of_guides),
        cmocka_unit_test(test_tiny_image),
        cmocka_unit_test(test_silhouettes_do_not_glow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
