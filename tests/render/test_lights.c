// Lights against closed forms; sampling lights and meeting them by chance must agree.
#include "tiny_world.h"

#include "base/random.h"
#include "image/image.h"
#include "render/light/lights.h"

#include <stdio.h>
#include <unistd.h>

#define ASSERT_NEAR(value, wanted, tolerance)                                             \
    do {                                                                                  \
        double v_ = (double)(value), w_ = (double)(wanted);                               \
        if (!(fabs(v_ - w_) <= (double)(tolerance))) {                                    \
            fail_msg("%s = %.6g, not %.6g +- %.2g", #value, v_, w_, (double)(tolerance)); \
        }                                                                                 \
    } while (0)

static Light sphere_light(Vec3 center, float radius, float radiance)
{
    return (Light){
        .kind = LIGHT_SPHERE, .radiance = vec3_splat(radiance), .center = center, .radius = radius};
}

// Looks straight down at one point of a plane through a very long lens.
static World *plane_world(int samples, float albedo)
{
    World *world = tiny_world(8, 8, samples, albedo);
    world->camera = (Camera){
        .position = {0.0f, 50.0f, 0.0f}, .target = {0, 0, 0}, .up = {0, 0, 1}, .fov = 0.01f};
    add_mesh(world, quad_mesh(vec3(-4, 0, 4), vec3(8, 0, 0), vec3(0, 0, -8)), 0, 0);
    return world;
}

// A sphere of radiance L, radius r at distance d in direction cos t lights a plane with
// pi L (r/d)^2 cos t as long as it is all above the horizon.
static void sphere_irradiance_closed_form(void **state)
{
    (void)state;
    const Vec3 centers[] = {{3, 4, 0}, {0.5f, 1.5f, 0.5f}, {2, 1, -2}};
    for (int i = 0; i < 3; i++) {
        World *world = plane_world(64, 0.5f);
        world->render.max_depth = 1;
        add_light(world, sphere_light(centers[i], 0.4f, 10.0f));
        Film *film = trace(world, 2, NULL);
        double d = (double)vec3_length(centers[i]);
        double wanted = 0.5 * 10.0 * 0.16 / (d * d) * (double)centers[i].y / d;
        ASSERT_NEAR(mean_luminance(film), wanted, 0.002 * wanted + 3.0 * mean_error(film));
        film_free(film);
        world_free(world);
    }
}

// Unit square one metre above, facing down: form factor of a parallel square seen from below its
// corner, times four for a point below the middle of a 2 x 2 square.
static void quad_irradiance_closed_form(void **state)
{
    (void)state;
    World *world = plane_world(256, 1.0f);
    world->render.max_depth = 1;
    add_light(world, (Light){.kind = LIGHT_QUAD,
                             .radiance = {1, 1, 1},
                             .corner = {-1, 1, -1},
                             .edge_u = {2, 0, 0},
                             .edge_v = {0, 0, 2}});
    // The camera looks through the light's dark side otherwise.
    world->camera.position = vec3(0.0f, 0.5f, 0.0f);
    Film *film = trace(world, 2, NULL);
    double a = 1.0 / sqrt(2.0), corner = 2.0 * a * atan(a) / (2.0 * (double)PI_F);
    ASSERT_NEAR(mean_luminance(film), 4.0 * corner, 0.004);
    film_free(film);
    // Turned round it lights nothing.
    world->light[0].edge_u = vec3(0, 0, 2);
    world->light[0].edge_v = vec3(2, 0, 0);
    film = trace(world, 1, NULL);
    assert_true(mean_luminance(film) == 0.0);
    film_free(film);
    world_free(world);
}

// A lit lamp seen by the camera has its own radiance.
static void lights_are_seen(void **state)
{
    (void)state;
    World *world = tiny_world(8, 8, 4, 0.5f);
    add_light(world, sphere_light(vec3(0, 0, 0), 20.0f, 3.0f));
    world->camera.position = vec3(0, 0, 100);
    world->camera.fov = 5.0f;
    Film *film = trace(world, 1, NULL);
    ASSERT_NEAR(mean_luminance(film), 3.0, 1e-5);
    ASSERT_NEAR(film->alpha[0], 1.0, 0.0);
    film_free(film);
    world_free(world);
}

// Radiance |cos| over uniform directions, as found with the density bsdf_pdf (0: unweighted).
static double summed_irradiance(const Lights *lights, Vec3 normal, float bsdf_pdf, int n)
{
    double sum = 0.0;
    for (int i = 0; i < n * n; i++) {
        float z = 1.0f - 2.0f * ((float)(i / n) + 0.5f) / (float)n, r = sqrtf(1.0f - z * z);
        float a = 2.0f * PI_F * ((float)(i % n) + 0.5f) / (float)n;
        Vec3 d = vec3(r * sinf(a), z, r * cosf(a));
        sum += (double)(luminance(lights_background(lights, vec3(0, 0, 0), d, bsdf_pdf, 1e-3f)) *
                        fmaxf(0.0f, vec3_dot(normal, d))) *
               4.0 * (double)PI_F / ((double)n * n);
    }
    return sum;
}

// The integral of radiance |cos| at a point by light sampling and uniform directions, weighted
// against each other: domes are sampled where they exceed their mean alone.
static double sampled_irradiance(const Lights *lights, Vec3 point, Vec3 normal, int n)
{
    const float even = 0.25f / PI_F;
    double sum = summed_irradiance(lights, normal, even, 4 * n);
    for (int i = 0; i < n * n; i++) {
        float u[3] = {((float)(i % n) + 0.5f) / (float)n, ((float)(i / n) + 0.5f) / (float)n,
                      (float)((i * 7919) % (n * n)) / (float)(n * n)};
        LightSample s;
        if (lights_sample(lights, &(LightReceiver){.position = point}, u, &s)) {
            float cosine = fmaxf(0.0f, vec3_dot(normal, s.direction));
            float weight = power_heuristic(s.pdf, even);
            sum += (double)(weight * luminance(s.radiance) * cosine / s.pdf) / (n * n);
        }
    }
    return sum;
}

static double brute_irradiance(const Lights *lights, Vec3 normal, int n)
{
    return summed_irradiance(lights, normal, 0.0f, n);
}

// A lamp at hand and three weak ones far away, before the sky: what is sampled of lamps has the
// mean of the closed form, radiance times the solid angle of a cone, and the far ones add no noise.
static void near_lights_are_chosen_by_place(void **state)
{
    (void)state;
    World *world = tiny_world(8, 8, 1, 0.5f);
    world->sky.kind = SKY_SUN_SKY;
    const Vec3 center[] = {{1, 2, 0}, {400, 30, 0}, {-300, 20, 50}, {0, 40, 500}};
    double wanted = 0.0;
    for (int i = 0; i < 4; i++) {
        float radiance = i == 0 ? 50.0f : 3.0f, radius = i == 0 ? 0.1f : 2.0f;
        double sine = (double)(radius / vec3_length(center[i]));
        add_light(world, sphere_light(center[i], radius, radiance));
        wanted += 2.0 * (double)PI_F * (1.0 - sqrt(1.0 - sine * sine)) * (double)radiance;
    }
    Run run = run_default();
    Lights *lights = lights_new(world, 600.0f, &run, NULL);
    assert_non_null(lights);
    const float near[] = {NEAR_BY_POWER, 0.4f, 1.0f};
    for (int k = 0; k < 3; k++) {
        enum { N = 40000 };
        double mean = 0.0, square = 0.0, hits = 0.0;
        for (int i = 0; i < N; i++) {
            const float u[3] = {random_unit(random_key(1, (uint64_t)i)),
                                random_unit(random_key(2, (uint64_t)i)), ((float)i + 0.5f) / N};
            LightSample s;
            const LightReceiver at = {.position = {0, 0, 0}};
            if (lights_sample_mixed(lights, &at, near[k], u, &s) && isfinite(s.distance)) {
                double light = (double)(luminance(s.radiance) / s.pdf);
                mean += light / N;
                square += light * light;
                hits += 1.0;
            }
        }
        ASSERT_NEAR(mean / wanted, 1.0, 2e-3);
        // without the place 3.9: three of four samples find next to nothing
        ASSERT_NEAR(square * hits / (mean * mean * N * N), 1.12, 0.1);
    }
    lights_free(lights);
    world_free(world);
}

// A picture with one very bright and some dim places.
static char *write_environment(void)
{
    Image *image = image_new(64, 32, 3, NULL);
    assert_non_null(image);
    for (int i = 0; i < 64 * 32; i++) {
        image->pixel[3 * i] = 0.2f + 0.001f * (float)(i % 64);
        image->pixel[3 * i + 1] = 0.3f;
        image->pixel[3 * i + 2] = i / 64 < 16 ? 0.9f : 0.1f;
    }
    for (int k = 0; k < 3; k++) {
        image->pixel[3 * (10 * 64 + 16) + k] = 400.0f; // row 10 of 32, a quarter from the left: +X
    }
    char name[] = "/tmp/ramify_test_XXXXXX.exr";
    int file = mkstemps(name, 4);
    assert_true(file >= 0);
    close(file);
    ImageLayer layer = {"", "RGB", image};
    assert_true(image_write_exr(name, &layer, 1, NULL, NULL));
    image_free(image);
    return strdup(name);
}

static void environment_is_where_it_should_be(void **state)
{
    (void)state;
    char *file = write_environment();
    World *world = tiny_world(8, 8, 1, 0.5f);
    world->sky = (Sky){.kind = SKY_ENVIRONMENT, .file = file, .strength = 2.0f, .visible = true};
    Run run = run_default();
    Lights *lights = lights_new(world, 1.0f, &run, NULL);
    assert_non_null(lights);
    float elevation = (0.5f - 10.5f / 32.0f) * PI_F, azimuth = (0.5f - 16.5f / 64.0f) * 2.0f * PI_F;
    Vec3 lamp =
        vec3(cosf(elevation) * sinf(azimuth), sinf(elevation), cosf(elevation) * cosf(azimuth));
    assert_true(lamp.x > 0.8f);
    ASSERT_NEAR(lights_background(lights, vec3(0, 0, 0), lamp, 0.0f, 1e-3f).x, 800.0, 1.0);
    lights_free(lights);
    world->sky.rotation = 90.0f; // from +X on toward -Z
    lights = lights_new(world, 1.0f, &run, NULL);
    assert_non_null(lights);
    ASSERT_NEAR(
        lights_background(lights, vec3(0, 0, 0), vec3(lamp.z, lamp.y, -lamp.x), 0.0f, 1e-3f).x,
        800.0, 1.0);
    lights_free(lights);
    world_free(world);
    unlink(file);
    free(file);
}

static void sampling_agrees_with_brute_force(void **state)
{
    (void)state;
    char *file = write_environment();
    for (int k = 0; k < 2; k++) {
        World *world = tiny_world(8, 8, 1, 0.5f);
        if (k == 0) {
            world->sky = (Sky){.kind = SKY_ENVIRONMENT, .file = file, .strength = 1.0f};
        } else {
            world->sky.kind = SKY_SUN_SKY;
            world->sky.sun_elevation = 25.0f;
            world->sky.sun_size = 8.0f; // large enough for brute force
        }
        Run run = run_default();
        Lights *lights = lights_new(world, 1.0f, &run, NULL);
        assert_non_null(lights);
        Vec3 normal = vec3_normalize(vec3(0.3f, 0.8f, -0.4f));
        double brute = brute_irradiance(lights, normal, 1500);
        double sampled = sampled_irradiance(lights, vec3(0, 0, 0), normal, 300);
        ASSERT_NEAR(sampled / brute, 1.0, 0.01);
        lights_free(lights);
        world_free(world);
    }
    unlink(file);
    free(file);
}

// A whole path tracing under the environment, next to a sum over uniform directions: a convex
// diffuse body sees the environment only, so a pixel's radiance is albedo / pi times the
// irradiance.
static void path_tracing_agrees_with_brute_force(void **state)
{
    (void)state;
    char *file = write_environment();
    World *world = tiny_world(8, 8, 512, 0.8f);
    world->sky = (Sky){.kind = SKY_ENVIRONMENT, .file = file, .strength = 1.0f, .visible = false};
    world->camera.position = vec3(0, 0, 500);
    world->camera.fov = 0.005f;
    add_mesh(world, sphere_mesh(vec3(0, 0, 0), 1.0f, 64, true), 0, 0);
    Run run = run_default();
    Lights *lights = lights_new(world, 1.0f, &run, NULL);
    assert_non_null(lights);
    double wanted = 0.8 / (double)PI_F * brute_irradiance(lights, vec3(0, 0, 1), 1500);
    Film *film = trace(world, 2, NULL);
    ASSERT_NEAR(mean_luminance(film), wanted, 0.004 * wanted + 3.0 * mean_error(film));
    film_free(film);
    lights_free(lights);
    world_free(world);
    unlink(file);
    free(file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sphere_irradiance_closed_form),
        cmocka_unit_test(quad_irradiance_closed_form),
        cmocka_unit_test(lights_are_seen),
        cmocka_unit_test(near_lights_are_chosen_by_place),
        cmocka_unit_test(environment_is_where_it_should_be),
        cmocka_unit_test(sampling_agrees_with_brute_force),
        cmocka_unit_test(path_tracing_agrees_with_brute_force),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
