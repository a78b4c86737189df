// The water's surface from below: refraction against closed forms, the network of light against its
// mean, sampling against brute force.
#include "tiny_world.h"

#include "base/random.h"
#include "render/light/lights.h"
#include "render/material/bsdf_ggx.h"

#define ASSERT_NEAR(value, wanted, tolerance)                                             \
    do {                                                                                  \
        double v_ = (double)(value), w_ = (double)(wanted);                               \
        if (!(fabs(v_ - w_) <= (double)(tolerance))) {                                    \
            fail_msg("%s = %.6g, not %.6g +- %.2g", #value, v_, w_, (double)(tolerance)); \
        }                                                                                 \
    } while (0)

static Medium clear_water(float height)
{
    Medium water = medium_default(MEDIUM_WATER);
    water.height = height;
    water.scattering = water.absorption = vec3_splat(0.0f);
    return water;
}

static void light_bends_both_ways_alike(void **state)
{
    (void)state;
    for (int i = 0; i < 200; i++) {
        Vec3 d = random_direction(random_key(1, (uint64_t)i));
        d.y = fabsf(d.y) + 0.01f;
        d = vec3_normalize(d);
        WaterPassage in, out;
        assert_true(water_enter(d, &in));
        assert_true(water_leave(in.direction, vec3(0, 1, 0), &out));
        ASSERT_NEAR(vec3_distance(out.direction, d), 0.0, 1e-3);
        ASSERT_NEAR(out.share, in.share, 1e-3);
        ASSERT_NEAR(out.shrink / in.shrink, 1.0, 0.02);
        // Snell
        float sine_air = sqrtf(1 - d.y * d.y), sine = sqrtf(1 - in.direction.y * in.direction.y);
        ASSERT_NEAR(sine_air, WATER_INDEX * sine, 1e-5);
    }
    WaterPassage none;
    assert_false(water_leave(vec3_normalize(vec3(1, 0.5f, 0)), vec3(0, 1, 0), &none));
}

// What the waves focus they take from elsewhere.
static void network_has_mean_one(void **state)
{
    (void)state;
    Medium medium = clear_water(5.0f);
    Run run = run_default();
    Water *water =
        water_new(&medium, vec3_normalize(vec3(0.5f, 0.8f, 0.2f)), 0.00465f, 5.0f, 1, &run, NULL);
    assert_non_null(water);
    enum { N = 200000 };
    for (int depth = 0; depth < 12; depth++) {
        double mean = 0.0, square = 0.0;
        for (int i = 0; i < N; i++) {
            uint64_t key = random_key(5, (uint64_t)i);
            Vec3 p = vec3(random_range(random_key(key, 0), 0, 120), 5.0f - (float)depth,
                          random_range(random_key(key, 1), 0, 120));
            double light = (double)water_caustic(water, p);
            mean += light / N;
            square += light * light / N;
        }
        ASSERT_NEAR(mean, 1.0, 0.02);
        if (depth == 5) { // sharp where it was asked to be
            assert_true(square - mean * mean > 0.3);
        } else if (depth == 0) {
            assert_true(square - mean * mean < 0.02);
        }
    }
    water_free(water);
}

// A white floor in calm clear water under a white sky: what the surface lets through, by
// integration of Fresnel's equations.
static void sky_lights_the_bottom_by_fresnel(void **state)
{
    (void)state;
    World *world = tiny_world(8, 8, 256, 1.0f);
    world->render.max_depth = 1;
    world->sky.kind = SKY_CONSTANT;
    world->sky.color = vec3_splat(1.0f);
    world->medium = clear_water(3.0f);
    world->camera =
        (Camera){.position = {0, 1, 0}, .target = {0, 0, 0}, .up = {0, 0, 1}, .fov = 0.01f};
    add_mesh(world, quad_mesh(vec3(-40, 0, 40), vec3(80, 0, 0), vec3(0, 0, -80)), 0, 0);
    double through = 0.0;
    enum { STEPS = 10000 };
    for (int i = 0; i < STEPS; i++) {
        double c = (i + 0.5) / STEPS;
        WaterPassage p;
        if (water_enter(vec3((float)sqrt(1 - c * c), (float)c, 0), &p)) {
            through += 2.0 * c * (double)p.share / STEPS;
        }
    }
    assert_true(through > 0.92 && through < 0.94); // 0.934 in the literature
    Film *film = trace(world, 2, NULL);
    // directions that the waves turn around are seen by chance alone, as calm water
    ASSERT_NEAR(mean_luminance(film), through, 0.01 + 3.0 * mean_error(film));
    film_free(film);
    world_free(world);
}

static void sampling_agrees_with_brute_force(void **state)
{
    (void)state;
    World *world = tiny_world(8, 8, 1, 0.5f);
    world->sky.kind = SKY_SUN_SKY;
    world->sky.sun_elevation = 40.0f;
    world->sky.sun_size = 8.0f;
    world->medium = clear_water(4.0f);
    Run run = run_default();
    Lights *lights = lights_new(world, 1.0f, &run, NULL);
    assert_non_null(lights);
    for (int k = 0; k < 3; k++) {
        LightReceiver at = {{(float)k * 1.7f, (float)k * 0.5f, 0.3f}, {0, 0, 0}};
        double sampled = 0.0, brute = 0.0; // sampled: by lights and by even directions, weighted
        const float even = 0.5f / PI_F;
        enum { N = 300, M = 1200 };
        for (int i = 0; i < N * N; i++) {
            float u[3] = {((float)(i % N) + 0.5f) / N, ((float)(i / N) + 0.5f) / N,
                          (float)((i * 7919) % (N * N)) / (float)(N * N)};
            LightSample s;
            if (lights_sample(lights, &at, u, &s)) {
                float weight = power_heuristic(s.pdf, even);
                sampled +=
                    (double)(weight * luminance(s.radiance) * s.direction.y / s.pdf) / (N * N);
            }
        }
        for (int i = 0; i < M * M; i++) {
            float z = ((float)(i / M) + 0.5f) / M, r = sqrtf(1.0f - z * z);
            float a = 2.0f * PI_F * ((float)(i % M) + 0.5f) / M;
            Vec3 d = vec3(r * sinf(a), z, r * cosf(a));
            double share = (double)z * 2.0 * (double)PI_F / ((double)M * M);
            // a weight of 1: the surface's density is far higher
            brute +=
                share * (double)luminance(lights_background(lights, at.position, d, 1e15f, 1e-3f));
            sampled +=
                share * (double)luminance(lights_background(lights, at.position, d, even, 1e-3f));
        }
        ASSERT_NEAR(sampled / brute, 1.0, 0.015);
    }
    lights_free(lights);
    world_free(world);
}

// Longer waves tilt the surface that is seen by as much as they are said to, over distances that
// the tile's waves do not have; the network stays as it is.
static void swell_is_seen_but_casts_nothing(void **state)
{
    (void)state;
    Run run = run_default();
    Medium medium = medium_default(MEDIUM_WATER);
    medium.caustics = 1.0f;
    medium.wavelength = 0.5f;
    Vec3 sun = vec3_normalize(vec3(0.5f, 0.8f, 0.2f));
    Water *plain = water_new(&medium, sun, 0.00465f, 5.0f, 1, &run, NULL);
    medium.swell = 8.0f;
    Water *swell = water_new(&medium, sun, 0.00465f, 5.0f, 1, &run, NULL);
    double squares = 0.0, far_apart = 0.0;
    const int count = 4000;
    for (int i = 0; i < count; i++) {
        Vec3 p = vec3(0.37f * (float)i, -1.0f, 0.23f * (float)i), q = vec3_add(p, vec3(4, 0, 0));
        assert_float_equal(water_caustic(plain, p), water_caustic(swell, p), 0.0f);
        assert_true(vec3_distance(water_normal(plain, p), water_normal(plain, q)) < 1e-3f);
        Vec3 a = water_normal(plain, p), b = water_normal(swell, p), c = water_normal(swell, q);
        squares +=
            pow((double)(b.x / b.y - a.x / a.y), 2) + pow((double)(b.z / b.y - a.z / a.y), 2);
        far_apart += (double)vec3_distance(b, c);
    }
    assert_float_equal((float)sqrt(squares / count), 0.12f, 0.01f);
    assert_true(far_apart / count > 0.05);
    water_free(plain);
    water_free(swell);
}

// A lake without wind, seen at 10 degrees, mirrors a dark wall: the guides for a denoiser hold the
// wall by Fresnel's share, the same in every sample. Rough water's hold its own colour alone.
static void still_water_guides_by_what_it_mirrors(void **state)
{
    (void)state;
    for (int rough = 0; rough < 2; rough++) {
        World *world = tiny_world(8, 8, 4, 0.2f);
        const float sine = 0.173648178f; // of 10 degrees
        world->material_count = 2;
        world->material[1] = material_default(MATERIAL_WATER);
        world->material[1].roughness = rough ? 0.4f : 0.0f;
        world->camera = (Camera){.position = {0, 10.0f * sine, 10.0f * 0.984807753f},
                                 .target = {0, 0, 0},
                                 .up = {0, 1, 0},
                                 .fov = 0.2f};
        add_mesh(world, quad_mesh(vec3(-40, 0, 40), vec3(80, 0, 0), vec3(0, 0, -80)), 1, 0);
        add_mesh(world, quad_mesh(vec3(-40, 0.1f, -30), vec3(80, 0, 0), vec3(0, 40, 0)), 0, 1);
        Film *film = trace(world, 1, NULL);
        float share = fresnel_dielectric(sine, world->material[1].ior, NULL);
        assert_true(share > 0.2f && share < 0.6f);
        for (int i = 0; i < 64; i++) {
            ASSERT_NEAR(film->albedo[i].x, rough ? 1.0f : lerpf(1.0f, 0.2f, share), 0.01);
            ASSERT_NEAR(film->normal[i].z, rough ? 0.0f : share, 0.02); // the wall's
        }
        film_free(film);
        world_free(world);
    }
}

// A small white plate under open water in a white sky: straight through the surface it gathers what
// passes, by Fresnel's equations. The rest is mirrored back past the plate to the sky below, where
// no shadow ray goes: a bound on indirect light holds it, else a lamp met there is a firefly.
static void what_is_mirrored_within_water_is_indirect(void **state)
{
    (void)state;
    double mean[2], error[2];
    for (int bounded = 0; bounded < 2; bounded++) {
        World *world = tiny_world(8, 8, 256, 1.0f);
        world->render.clamp = bounded ? 1e-6f : 0.0f;
        world->sky.kind = SKY_CONSTANT;
        world->sky.color = vec3_splat(1.0f);
        world->material_count = 2;
        world->material[1] = material_default(MATERIAL_WATER);
        world->camera =
            (Camera){.position = {0, 0.2f, 0}, .target = {0, 0, 0}, .up = {0, 0, 1}, .fov = 1};
        add_mesh(world, quad_mesh(vec3(-0.2f, 0, 0.2f), vec3(0.4f, 0, 0), vec3(0, 0, -0.4f)), 0, 0);
        add_mesh(world, quad_mesh(vec3(-400, 1, 400), vec3(800, 0, 0), vec3(0, 0, -800)), 1, 1);
        Film *film = trace(world, 2, NULL);
        mean[bounded] = mean_luminance(film);
        error[bounded] = mean_error(film);
        film_free(film);
        world_free(world);
    }
    const double ior = (double)material_default(MATERIAL_WATER).ior;
    double passes = 0.0;
    enum { STEPS = 2000 };
    for (int i = 0; i < STEPS; i++) {
        float c = ((float)i + 0.5f) / STEPS;
        double fresnel = (double)fresnel_dielectric(c, (float)ior, NULL);
        passes += 2.0 * (double)c * (1.0 - fresnel) / (ior * ior) / STEPS;
    }
    assert_true(passes > 0.5 && passes < 0.54);
    ASSERT_NEAR(mean[1], passes, 0.003 + 4.0 * error[1]);
    ASSERT_NEAR(mean[0], 1.0, 0.003 + 4.0 * error[0]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_bends_both_ways_alike),
        cmocka_unit_test(swell_is_seen_but_casts_nothing),
        cmocka_unit_test(network_has_mean_one),
        cmocka_unit_test(sky_lights_the_bottom_by_fresnel),
        cmocka_unit_test(sampling_agrees_with_brute_force),
        cmocka_unit_test(still_water_guides_by_what_it_mirrors),
        cmocka_unit_test(what_is_mirrored_within_water_is_indirect),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
