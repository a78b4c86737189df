// Edges of bright lights in the developed picture: filtered after their highlights are compressed,
// while the film's radiance stays the mean of all samples.
#include "image/highlights.h"
#include "image/tone_curve.h"
#include "render/medium/water.h"
#include "tiny_world.h"

enum { WIDTH = 24, HEIGHT = 16, SUBPIXELS = 64 };

static const float BRIGHT = 1000.0f, DIM = 0.1f;

static ToneParams plain(void)
{
    ToneParams p = tone_params_default();
    p.bloom = p.vignette = 0.0f;
    return p;
}

static World *sky_world(void)
{
    World *world = tiny_world(WIDTH, HEIGHT, 1024, 0.5f);
    world->sky.kind = SKY_CONSTANT;
    world->sky.color = vec3_splat(DIM);
    world->sky.visible = true;
    return world;
}

static const Vec3 CORNER = {0.05f - 1.5f, -10, 0}, ACROSS = {20, 0, 0}, UP = {3, 20, 0};

// A glowing half plane, x > 0.05 + 0.15 y in the plane z = 0, against the sky.
static World *edge_world(void)
{
    World *world = sky_world();
    world->material[1] = material_default(MATERIAL_EMISSION);
    world->material[1].radiance = vec3_splat(BRIGHT);
    world->material_count = 2;
    add_mesh(world, quad_mesh(CORNER, ACROSS, UP), 1, 0);
    return world;
}

// The same, but a lamp against a diffuse wall of radiance DIM, which it does not light.
static World *lamp_world(void)
{
    World *world = sky_world();
    world->sky.color = vec3_splat(2.0f * DIM);
    add_mesh(world, quad_mesh(vec3(-40, -40, -1e-4f), vec3(80, 0, 0), vec3(0, 80, 0)), 0, 1);
    add_light(world, (Light){.kind = LIGHT_QUAD,
                             .radiance = vec3_splat(BRIGHT),
                             .corner = CORNER,
                             .edge_u = ACROSS,
                             .edge_v = UP});
    return world;
}

// Calm water in place of the half plane, which it mirrors: three times as large and as far away,
// and so bright that the mirrored one has the radiance BRIGHT.
static World *mirror_world(void)
{
    const float sine = (WATER_INDEX - 1.0f) / (WATER_INDEX + 1.0f); // Fresnel, straight on
    World *world = sky_world();
    world->material[0] = material_default(MATERIAL_WATER);
    world->material[0].ior = WATER_INDEX;
    world->material[1] = material_default(MATERIAL_EMISSION);
    world->material[1].radiance = vec3_splat(BRIGHT / (sine * sine));
    world->material_count = 2;
    Vec3 corner = vec3_scale(CORNER, 3.0f);
    corner.z = 10.0f;
    add_mesh(world, quad_mesh(corner, vec3_scale(ACROSS, 3.0f), vec3_scale(UP, 3.0f)), 1, 0);
    add_mesh(world, quad_mesh(vec3(-40, -40, 0), vec3(80, 0, 0), vec3(0, 80, 0)), 0, 1);
    return world;
}

// The share of a pixel's area that the half plane covers.
static float coverage(int x, int y)
{
    float pixel = 2.0f * 5.0f * tanf(15.0f * RADIANS_PER_DEGREE) / (float)HEIGHT;
    int inside = 0;
    for (int i = 0; i < SUBPIXELS * SUBPIXELS; i++) {
        float fx = (float)x + ((float)(i % SUBPIXELS) + 0.5f) / SUBPIXELS - 0.5f * WIDTH;
        float fy = (float)y + ((float)(i / SUBPIXELS) + 0.5f) / SUBPIXELS - 0.5f * HEIGHT;
        inside += fx * pixel > 0.05f - 0.15f * fy * pixel;
    }
    return (float)inside / (SUBPIXELS * SUBPIXELS);
}

static HighlightParts parts_of(const Film *film)
{
    return (HighlightParts){film->light, film->sky, film->light_share, film->sky_share};
}

static Image *radiance_of(const Film *film)
{
    Image *image = image_new(film->width, film->height, 4, NULL);
    assert_non_null(image);
    for (int i = 0; i < film->width * film->height; i++) {
        memcpy(image->pixel + 4 * i, &film->color[i], sizeof(Vec3));
        image->pixel[4 * i + 3] = film->alpha[i];
    }
    return image;
}

// Display values, made linear.
static Image *shown(const Film *film, bool compressed, const ToneParams *params)
{
    Image *image = radiance_of(film), *excess = image_new(film->width, film->height, 3, NULL);
    const HighlightParts parts = parts_of(film);
    if (compressed) {
        highlights_compress(image, excess, &parts, params);
    }
    Image *display = tone_map(image, compressed ? excess : NULL, params, NULL);
    assert_non_null(display);
    for (int i = 0; i < film->width * film->height * 4; i++) {
        display->pixel[i] = tone_linear_from_srgb(display->pixel[i]);
    }
    image_free(image);
    image_free(excess);
    return display;
}

// The largest distance of the picture from the mean of what is shown over each pixel's area. The
// rows must rise from the dark side to the bright one.
static float worst_edge(const Film *film, bool compressed)
{
    ToneParams params = plain();
    AgxFit curve = agx_fit(params.look, params.contrast);
    Image *display = shown(film, compressed, &params);
    float worst = 0.0f;
    for (int y = 0; y < HEIGHT; y++) {
        float last = 0.0f;
        for (int x = 0; x < WIDTH; x++) {
            float covered = coverage(x, y), value = display->pixel[4 * (y * WIDTH + x)];
            float mean = lerpf(agx_curve(&curve, DIM), agx_curve(&curve, BRIGHT), covered);
            worst = fmaxf(worst, fabsf(value - mean));
            assert_true(value >= last - 5e-3f); // the wall is noisy
            last = value;
        }
    }
    image_free(display);
    return worst;
}

static void test_edges_are_means_of_what_is_shown(void **state)
{
    (void)state;
    for (int lamp = 0; lamp < 2; lamp++) {
        World *world = lamp ? lamp_world() : edge_world();
        Film *film = trace(world, 2, NULL);
        assert_true(worst_edge(film, true) < 0.02f);
        assert_true(worst_edge(film, false) > 0.7f); // staircases
        double sum = 0.0, expected = 0.0;            // the film stays linear
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            sum += (double)film->color[i].y;
            expected += (double)lerpf(DIM, BRIGHT, coverage(i % WIDTH, i / WIDTH));
        }
        assert_true(fabs(sum / expected - 1.0) < 2e-3);
        film_free(film);
        world_free(world);
    }
}

// A lamp in calm water is as thin as the lamp itself, although few samples are those of the mirror.
static void test_mirrored_edges_are_such_means_too(void **state)
{
    (void)state;
    World *world = mirror_world();
    Film *film = trace(world, 2, NULL);
    assert_true(worst_edge(film, true) < 0.02f);
    assert_true(worst_edge(film, false) > 0.6f);
    film_free(film);
    world_free(world);
}

// What one kind of thing fills keeps its bits; of the light that a mixed pixel lost, all is left
// for bloom.
static void test_only_mixed_pixels_change(void **state)
{
    (void)state;
    World *world = edge_world();
    Film *film = trace(world, 2, NULL);
    Image *image = radiance_of(film), *excess = image_new(WIDTH, HEIGHT, 3, NULL);
    const HighlightParts parts = parts_of(film);
    const ToneParams params = plain();
    highlights_compress(image, excess, &parts, &params);
    int mixed = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        bool pure = film->light_share[i] <= 0.0f || film->light_share[i] >= 1.0f;
        assert_true((memcmp(image->pixel + 4 * i, &film->color[i], sizeof(Vec3)) == 0) == pure);
        assert_float_equal(image->pixel[4 * i] + excess->pixel[3 * i], film->color[i].x, 1e-3f);
        mixed += !pure;
    }
    assert_in_range(mixed, HEIGHT, 3 * HEIGHT);
    image_free(image);
    image_free(excess);
    film_free(film);
    world_free(world);
}

// Edges between things too dark to be shown stay as dark as they are.
static void test_black_edges_stay_black(void **state)
{
    (void)state;
    const ToneParams params = plain();
    const Vec3 light = {0}, sky = vec3_splat(1e-7f);
    const float light_share = 0.0f, sky_share = 0.5f;
    const HighlightParts parts = {&light, &sky, &light_share, &sky_share};
    Image *image = image_new(1, 1, 4, NULL), *excess = image_new(1, 1, 3, NULL);
    assert_true(image && excess);
    image->pixel[0] = image->pixel[1] = image->pixel[2] = 1e-7f;
    image->pixel[3] = 1.0f;
    highlights_compress(image, excess, &parts, &params);
    for (int c = 0; c < 3; c++) {
        assert_float_equal(image->pixel[c], 1e-7f, 1e-12f);
        assert_float_equal(excess->pixel[c], 0.0f, 1e-12f);
    }
    image_free(image);
    image_free(excess);
}

// Where the lens blurs, light mixes before it is shown: a lamp out of focus stays a bright disc.
static void test_blurred_lights_stay_linear(void **state)
{
    (void)state;
    World *world = edge_world();
    world->camera.aperture = 0.5f;
    world->camera.focus_distance = 1.0f;
    world->render.samples = 16;
    Film *film = trace(world, 2, NULL);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        assert_true(film->light_share[i] <= 0.0f && film->sky_share[i] <= 0.0f);
    }
    film_free(film);
    world->camera.focus_distance = 5.0f; // in focus: the lens changes nothing
    world->render.samples = 1024;
    film = trace(world, 2, NULL);
    ToneParams params = plain();
    Image *display = shown(film, true, &params);
    float half = display->pixel[4 * (HEIGHT / 2 * WIDTH + WIDTH / 2)];
    assert_float_equal(half, coverage(WIDTH / 2, HEIGHT / 2), 0.12f);
    image_free(display);
    film_free(film);
    world_free(world);
}

// Before a transparent background only the lamp's own colour is left, at the alpha of its share.
static void test_transparent_background(void **state)
{
    (void)state;
    World *world = edge_world();
    world->sky.visible = false;
    Film *film = trace(world, 2, NULL);
    ToneParams params = plain();
    Image *display = shown(film, true, &params);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        assert_float_equal(film->alpha[i], film->light_share[i], 1e-6f);
        assert_float_equal(display->pixel[4 * i], film->alpha[i] > 0.0f ? 1.0f : 0.0f, 1e-3f);
    }
    image_free(display);
    film_free(film);
    world_free(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_edges_are_means_of_what_is_shown),
        cmocka_unit_test(test_mirrored_edges_are_such_means_too),
        cmocka_unit_test(test_only_mixed_pixels_change),
        cmocka_unit_test(test_black_edges_stay_black),
        cmocka_unit_test(test_blurred_lights_stay_linear),
        cmocka_unit_test(test_transparent_background),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
