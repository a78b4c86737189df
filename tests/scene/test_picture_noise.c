// The noise that a picture reports is the spread of its display values.
#include "base/random.h"
#include "render/film_merge.h"
#include "render/renderer.h"
#include "render/world.h"
#include "scene/picture.h"

#include "scene_fixture.h"

#include <math.h>

#define GROUND "objects: [{name: meadow, ground: {}}]\n"

static void assert_near(double found, double wanted, double within)
{
    if (!(fabs(found - wanted) <= within)) {
        fail_msg("%.9g, not %.9g within %g", found, wanted, within);
    }
}

static double noise_of(const Scene *scene, const Film *film)
{
    Error e = {0};
    double noise = -1.0;
    assert_true(picture_noise(scene, film, &noise, &e));
    return noise;
}

static Film *make_film(int width, int height)
{
    Error e = {0};
    Film *film = film_new(width, height, &e);
    assert_non_null(film);
    return film;
}

static void set_pixel(Film *film, int64_t i, float light, float error, int samples)
{
    film->color[i] = vec3_splat(light);
    film->alpha[i] = 1.0f;
    film->variance[i] = error * error;
    film->samples[i] = (float)samples;
}

// Without a view: the slope of sRGB's curve times the error.
static void is_the_error_as_shown(void **state)
{
    Scene *scene = fixture_read(*state, "film: {width: 2, height: 1, view: standard, exposure: 1, "
                                        "bloom: 0, vignette: 0}\n" GROUND);
    Film *film = make_film(2, 1);
    set_pixel(film, 0, 0.05f, 0.0005f, 16);
    set_pixel(film, 1, 0.3f, 0.002f, 16);
    double shown[2];
    for (int i = 0; i < 2; i++) { // twice as bright, by the exposure
        double light = 2.0 * (double)film->color[i].x;
        double slope = 1.055 / 2.4 * pow(light, 1.0 / 2.4 - 1.0);
        shown[i] = slope * 2.0 * sqrt((double)film->variance[i]);
    }
    assert_near(noise_of(scene, film), 0.5 * (shown[0] + shown[1]), 1e-5);
    film_free(film);
    scene_free(scene);
}

// Pixels outside the crop and those of one sample, whose variance is unknown, do not count.
static void counts_what_is_known(void **state)
{
    Scene *scene = fixture_read(*state, "film: {width: 4, height: 1, view: standard, bloom: 0, "
                                        "vignette: 0, crop: [0, 0, 0.75, 1]}\n" GROUND);
    Film *film = make_film(4, 1);
    set_pixel(film, 0, 0.5f, 0.0f, 1);
    assert_true(isnan(noise_of(scene, film)));
    set_pixel(film, 1, 0.5f, 0.01f, 2);
    double alone = noise_of(scene, film);
    assert_true(alone > 0.001);
    set_pixel(film, 3, 0.5f, 0.3f, 8);
    assert_near(noise_of(scene, film), alone, 1e-9);
    set_pixel(film, 2, 0.0f, 0.0f, 8); // black, without an error
    assert_near(noise_of(scene, film), 0.5 * alone, 1e-9);
    film_free(film);
    scene_free(scene);
}

// A metered picture looks the same in any light, and so does its noise.
static void is_that_of_the_metered_picture(void **state)
{
    Scene *scene =
        fixture_read(*state, "film: {width: 8, height: 8, auto_exposure: true}\n" GROUND);
    double noise[2];
    for (int k = 0; k < 2; k++) {
        Film *film = make_film(8, 8);
        float scale = k ? 4096.0f : 1.0f;
        for (int i = 0; i < 64; i++) {
            float light = scale * (1.0f + (float)i);
            set_pixel(film, i, light, 0.02f * light, 16);
        }
        noise[k] = noise_of(scene, film);
        film_free(film);
    }
    assert_true(noise[0] > 0.002);
    assert_near(noise[1] / noise[0], 1.0, 1e-4);
    scene_free(scene);
}

enum { WIDTH = 12, HEIGHT = 8, PIXELS = WIDTH * HEIGHT, PICTURES = 64 };

// Sums and squares of the display values of many pictures.
typedef struct Spread {
    double sum[3 * PIXELS], squares[3 * PIXELS];
    double told; // mean of what they report
} Spread;

static void spread_add(Spread *spread, const Scene *scene, const Film *film)
{
    Error e = {0};
    Image *shown = picture_develop(scene, film, false, NULL, &e);
    assert_non_null(shown);
    for (int i = 0; i < 3 * PIXELS; i++) {
        double x = (double)shown->pixel[i / 3 * 4 + i % 3];
        spread->sum[i] += x;
        spread->squares[i] += x * x;
    }
    spread->told += noise_of(scene, film) / PICTURES;
    image_free(shown);
}

// The standard deviation from picture to picture, mean over all display values.
static double spread_found(const Spread *spread)
{
    double found = 0.0;
    for (int i = 0; i < 3 * PIXELS; i++) {
        double mean = spread->sum[i] / PICTURES;
        found += sqrt(fmax(0.0, spread->squares[i] / PICTURES - mean * mean) * PICTURES /
                      (PICTURES - 1.0));
    }
    return found / (3 * PIXELS);
}

// One of many films with the same light: a grey surface under a lamp that flickers from sample to
// sample, from dark pixels to bright ones.
static Film *flickering_film(int picture)
{
    enum { SAMPLES = 64 };
    Film *film = make_film(WIDTH, HEIGHT);
    for (int i = 0; i < PIXELS; i++) {
        PathSum paths = {.samples = 0};
        PixelSum sum = {.samples = 0};
        uint64_t key = random_key(random_key(5, (uint64_t)picture), (uint64_t)i);
        for (int k = 0; k < SAMPLES; k++) {
            float light = exp2f(-5.0f + 6.0f * (float)i / PIXELS);
            light *= 2.0f * random_unit(random_key(key, (uint64_t)k));
            PathResult path = {.color = vec3(light, 0.8f * light, 0.5f * light),
                               .alpha = 1.0f,
                               .hit = true,
                               .seen = SEEN_SURFACE};
            path_sum_add(&paths, &path, 1);
        }
        pixel_sum_add(&sum, &paths);
        film_set(film, i, &sum);
    }
    return film;
}

// Independent samples: what is reported is what is found, in the standard view.
static void is_the_spread_of_independent_samples(void **state)
{
    Scene *scene = fixture_read(*state, "film: {width: 12, height: 8, bloom: 0}\n" GROUND);
    Spread spread = {.told = 0.0};
    for (int k = 0; k < PICTURES; k++) {
        Film *film = flickering_film(k);
        spread_add(&spread, scene, film);
        film_free(film);
    }
    // of the 96 x 63 degrees of freedom the standard deviation varies by 0.9 %
    assert_near(spread.told / spread_found(&spread), 1.0, 0.04);
    scene_free(scene);
}

// A rendering: its samples are laid out better than independent ones, so it is quieter than it
// reports, but not by far.
static void bounds_the_spread_of_renderings(void **state)
{
    Scene *scene = fixture_read(
        *state, "film: {width: 12, height: 8, bloom: 0, auto_exposure: true}\n"
                "render: {samples: 16}\n"
                "camera: {position: [0, 1, 4], target: [0, 0.5, 0]}\n"
                "sky: {kind: constant, color: [0.2, 0.3, 0.5]}\n"
                "lights: [{kind: sphere, center: [1, 2, 1], radius: 0.3, radiance: [90, 70, 50]}]\n"
                "objects:\n"
                "  - name: ball\n"
                "    shape: {envelope: [{shape: sphere, size: [2, 2, 2]}]}\n");
    Error e = {0};
    Run run = run_default();
    World *world = scene_build(scene, &run, NULL, &e);
    assert_non_null(world);
    Renderer *renderer = renderer_new(world, NULL, &run, &e);
    assert_non_null(renderer);
    Film *film = make_film(WIDTH, HEIGHT);
    Spread spread = {.told = 0.0};
    for (int k = 0; k < PICTURES; k++) {
        RenderStats stats;
        world->render.noise_seed = 100 + (uint64_t)k;
        assert_true(renderer_render(renderer, film, &run, NULL, NULL, &stats, &e));
        spread_add(&spread, scene, film);
    }
    double found = spread_found(&spread);
    if (!(found < 1.03 * spread.told && found > 0.35 * spread.told)) {
        fail_msg("found %g, reported %g", found, spread.told);
    }
    film_free(film);
    renderer_free(renderer);
    world_free(world);
    scene_free(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(is_the_error_as_shown, fixture_set_up, fixture_tear_down),
        cmocka_unit_test_setup_teardown(counts_what_is_known, fixture_set_up, fixture_tear_down),
        cmocka_unit_test_setup_teardown(is_that_of_the_metered_picture, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(is_the_spread_of_independent_samples, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(bounds_the_spread_of_renderings, fixture_set_up,
                                        fixture_tear_down),
    };
    return cmocka_run_group_tests_name("noise of a picture", tests, NULL, NULL);
}
