// Media against closed forms, numerical integrals and furnaces.
#include "tiny_world.h"

#include "base/random.h"
#include "mesh/curves.h"
#include "render/medium/medium.h"

#define ASSERT_NEAR(value, wanted, tolerance)                                             \
    do {                                                                                  \
        double v_ = (double)(value), w_ = (double)(wanted);                               \
        if (!(fabs(v_ - w_) <= (double)(tolerance))) {                                    \
            fail_msg("%s = %.6g, not %.6g +- %.2g", #value, v_, w_, (double)(tolerance)); \
        }                                                                                 \
    } while (0)

static Material glowing(float radiance)
{
    Material m = material_default(MATERIAL_EMISSION);
    m.radiance = vec3_splat(radiance);
    return m;
}

static Material clear_body(Vec3 scattering, Vec3 absorption, float anisotropy)
{
    Material m = material_default(MATERIAL_DIELECTRIC);
    m.ior = 1.0f;
    m.scattering = scattering;
    m.absorption = absorption;
    m.anisotropy = anisotropy;
    return m;
}

static Medium everywhere(float scattering, float absorption, float anisotropy, float extent)
{
    return (Medium){.kind = MEDIUM_EVERYWHERE,
                    .scattering = vec3_splat(scattering),
                    .absorption = vec3_splat(absorption),
                    .anisotropy = anisotropy,
                    .extent = extent};
}

// ---- lines

// Lengths along rays through a layer equal sums over small steps; a length leads back to its place.
static void layer_lengths_equal_sums(void **state)
{
    (void)state;
    Medium layer = {.kind = MEDIUM_LAYER, .height = 1.0f, .falloff = 2.0f};
    for (int i = 0; i < 60; i++) {
        uint64_t key = random_key(3, (uint64_t)i);
        Vec3 origin = vec3(0, random_range(random_key(key, 0), -3, 8), 0);
        Vec3 direction = i % 6 ? random_direction(random_key(key, 1)) : vec3(1, 0, 0);
        float far = random_range(random_key(key, 2), 1, 12);
        MediumLine line = medium_line(&layer, vec3_splat(0), 0, origin, direction, far);
        double sum = 0.0;
        enum { STEPS = 20000 };
        for (int k = 0; k < STEPS; k++) {
            float t = ((float)k + 0.5f) / STEPS * far;
            double above = fmax(0.0, (double)(origin.y + t * direction.y) - 1.0);
            sum += exp(-above / 2.0) * (double)far / STEPS;
            if (k % 5000 == 4000) {
                ASSERT_NEAR(medium_line_length(&line, t), sum, 2e-3);
                ASSERT_NEAR(medium_line_density(&line, t), exp(-above / 2.0), 1e-4);
                ASSERT_NEAR(medium_line_at(&line, medium_line_length(&line, t)), t,
                            2e-5 / exp(-above / 2.0));
            }
        }
        ASSERT_NEAR(line.length, sum, 2e-3);
    }
}

// Drawn lengths have the density that is told: its integral is 1, and so is that of the transmitted
// rest.
static void drawn_lengths_have_their_density(void **state)
{
    (void)state;
    Vec3 extinction = vec3(0.2f, 1.0f, 3.0f), weight = vec3(0.5f, 0.3f, 0.2f);
    double within = 0.0, passed = 0.0, mean = 0.0, wanted = 0.0;
    enum { STEPS = 20000 };
    for (int i = 0; i < STEPS; i++) {
        float x = ((float)i + 0.5f) / STEPS, pdf;
        double density = (double)medium_density_within(extinction, weight, 2.0f, 2.0f * x);
        within += density * 2.0 / STEPS;
        wanted += density * 2.0 / STEPS * (double)(2.0f * x);
        float choice = random_unit(random_key(9, (uint64_t)i));
        mean += (double)medium_draw_within(extinction, weight, 2.0f, choice, x) / STEPS;
        passed += medium_draw_length(extinction, weight, 2.0f, choice, x, &pdf) >= 2.0f
                      ? 1.0 / STEPS
                      : 0.0;
    }
    ASSERT_NEAR(within, 1.0, 1e-3);
    ASSERT_NEAR(mean, wanted, 0.01);
    ASSERT_NEAR(passed, vec3_dot(weight, medium_transmittance(extinction, 2.0f)), 0.01);
}

static void phase_function_is_drawn_as_it_is(void **state)
{
    (void)state;
    const float g[] = {0.0f, 0.7f, -0.4f};
    for (int k = 0; k < 3; k++) {
        double integral = 0.0, mean = 0.0, drawn = 0.0;
        enum { STEPS = 20000 };
        for (int i = 0; i < STEPS; i++) {
            float x = ((float)i + 0.5f) / STEPS, cosine = 2.0f * x - 1.0f;
            double p = (double)phase_density(g[k], cosine) * 4.0 * (double)PI_F / STEPS;
            integral += p;
            mean += p * (double)cosine;
            drawn += (double)phase_draw(g[k], vec3(0, 0, 1), x, 0.3f).z / STEPS;
        }
        ASSERT_NEAR(integral, 1.0, 1e-4);
        ASSERT_NEAR(mean, g[k], 1e-4);
        ASSERT_NEAR(drawn, g[k], 1e-3);
    }
}

// ---- what the camera sees

static void light_fades_by_beer_lambert(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        World *world = tiny_world(8, 8, 4, 0.5f);
        world->material[0] = glowing(2.0f);
        add_mesh(world, quad_mesh(vec3(-9, -9, -3), vec3(18, 0, 0), vec3(0, 18, 0)), 0, 0);
        world->camera.fov = 0.01f;
        if (k == 0) { // 8 m through the scene's medium
            world->medium = everywhere(0.0f, 0.0f, 0.0f, 100.0f);
            world->medium.absorption = vec3(0.05f, 0.2f, 0.5f);
        } else { // 2 m through a body without surface, in another
            world->material[1] = clear_body(vec3_splat(0), vec3(0.2f, 0.8f, 2.0f), 0.0f);
            world->material[2] = clear_body(vec3_splat(0), vec3_splat(0), 0.0f);
            world->material_count = 3;
            add_mesh(world, sphere_mesh(vec3(0, 0, 0), 1.0f, 64, true), 1, 1);
            add_mesh(world, sphere_mesh(vec3(0, 0, 0), 1.5f, 64, true), 2, 2);
        }
        Film *film = trace(world, 1, NULL);
        Vec3 c = film->color[36];
        ASSERT_NEAR(c.x, 2.0 * exp(-0.4), 2e-3);
        ASSERT_NEAR(c.y, 2.0 * exp(-1.6), 2e-3);
        ASSERT_NEAR(c.z, 2.0 * exp(-4.0), 2e-3);
        film_free(film);
        world_free(world);
    }
}

// A surface or a lamp of radiance 2 that fills the picture, 8 m away in a medium that scatters; or
// as far behind the camera, which looks into a mirror 0.1 m away.
static World *glow_in_fog(bool lamp, bool mirrored)
{
    World *world = tiny_world(4, 4, 16, 0.5f);
    world->camera.fov = 0.01f;
    world->medium = everywhere(0.3f, 0.1f, 0.2f, 100.0f);
    world->render.max_depth = mirrored ? 1 : 0; // no scattering
    world->material[0] = glowing(2.0f);
    Vec3 corner = vec3(-9, -9, -3), u = vec3(18, 0, 0), v = vec3(0, 18, 0);
    if (mirrored) {
        world->material[1] = material_default(MATERIAL_CONDUCTOR);
        world->material[1].color = vec3_splat(1.0f);
        world->material[1].roughness = 0.0f;
        world->material_count = 2;
        add_mesh(world, quad_mesh(vec3(-9, -9, 4.9f), u, v), 1, 1);
        corner = vec3(9, -9, 12.8f);
        u = vec3_neg(u);
    }
    if (lamp) {
        add_light(world, (Light){.kind = LIGHT_QUAD,
                                 .corner = corner,
                                 .edge_u = u,
                                 .edge_v = v,
                                 .radiance = vec3_splat(2.0f)});
    } else {
        add_mesh(world, quad_mesh(corner, u, v), 0, 0);
    }
    return world;
}

// Every sample sees it dimmed by exp(-depth), as far as it gets to the mirror.
static void what_glows_shines_through_without_chance(void **state)
{
    (void)state;
    for (int k = 0; k < 4; k++) {
        bool lamp = k & 1, mirrored = k & 2;
        World *world = glow_in_fog(lamp, mirrored);
        Film *film = trace(world, 1, NULL);
        double wanted = 2.0 * exp(-0.4 * 8.0);
        ASSERT_NEAR(mean_luminance(film), wanted, (mirrored ? 0.05 : 1e-3) * wanted);
        for (int i = 0; i < 16 && !mirrored; i++) {
            ASSERT_NEAR(luminance(film->color[i]), wanted, 1e-3 * wanted);
        }
        film_free(film);
        world_free(world);
    }
}

// Light of a ball of radiance 100 and radius 0.05, scattered once into a ray that passes it at 0.5
// m.
static double single_scattering(double scattering, double absorption, float g)
{
    double sum = 0.0, extinction = scattering + absorption;
    enum { STEPS = 200000 };
    for (int i = 0; i < STEPS; i++) {
        double t = 20.0 * (i + 0.5) / STEPS, z = 5.0 - t, d = sqrt(z * z + 0.25);
        double angle = 2.0 * (double)PI_F * (1.0 - sqrt(1.0 - 0.0025 / (d * d)));
        double cosine = z / d; // the ray goes toward -z
        sum += exp(-extinction * (t + d - 0.05 * 2.0 / 3.0)) *
               (double)phase_density(g, (float)cosine) * angle * 20.0 / STEPS;
    }
    return 100.0 * scattering * sum;
}

static void single_scattering_equals_the_integral(void **state)
{
    (void)state;
    const float scattering[] = {0.01f, 0.5f}, absorption[] = {0.0f, 0.3f}, g[] = {0.6f, -0.3f};
    for (int k = 0; k < 4; k++) {
        World *world = tiny_world(8, 8, 256, 0.5f);
        world->render.max_depth = 1;
        world->camera.fov = 0.01f;
        world->camera.target = vec3(0, 0, -20);
        world->medium = everywhere(scattering[k % 2], absorption[k % 2], g[k % 2], 100.0f);
        if (k < 2) {
            add_light(world, (Light){.kind = LIGHT_SPHERE,
                                     .radiance = vec3_splat(100.0f),
                                     .center = {0.3f, 0.4f, 0.0f},
                                     .radius = 0.05f});
        } else { // the same as geometry
            world->material[0] = glowing(100.0f);
            add_mesh(world, sphere_mesh(vec3(0.3f, 0.4f, 0.0f), 0.05f, 12, true), 0, 0);
        }
        Film *film = trace(world, 2, NULL);
        double wanted =
            single_scattering((double)scattering[k % 2], (double)absorption[k % 2], g[k % 2]);
        ASSERT_NEAR(mean_luminance(film) / wanted, 1.0,
                    (k < 2 ? 0.005 : 0.02) + 3.0 * mean_error(film) / wanted);
        assert_true(mean_error(film) < 0.03 * wanted);
        film_free(film);
        world_free(world);
    }
}

// A thin glowing curve across the ray's way, half a metre behind it: against an integral over both.
static double line_scattering(double scattering)
{
    double sum = 0.0;
    enum { STEPS = 2000, PARTS = 400 };
    for (int i = 0; i < STEPS; i++) {
        for (int k = 0; k < PARTS; k++) {
            double t = 20.0 * (i + 0.5) / STEPS, z = 5.0 - t, y = -2.0 + 4.0 * (k + 0.5) / PARTS;
            double d = sqrt(z * z + 0.25 + y * y), across = sqrt(z * z + 0.25) / d;
            double angle = 2.0 * 0.01 * across * (4.0 / PARTS) / (d * d);
            sum += exp(-scattering * (t + d)) / (4.0 * (double)PI_F) * angle * 20.0 / STEPS;
        }
    }
    return 1000.0 * scattering * sum;
}

// The film of such a channel, with weak lamps far away or without.
static Film *trace_channel(bool lamps)
{
    World *world = tiny_world(8, 8, 256, 0.5f);
    world->render.max_depth = 1;
    world->camera.fov = 0.01f;
    world->camera.target = vec3(0, 0, -20);
    world->medium = everywhere(0.02f, 0.0f, 0.0f, 100.0f);
    world->material[0] = glowing(1000.0f);
    enum { POINTS = 41 };
    CurveSet *curves = curves_new(POINTS, 1, NULL);
    assert_non_null(curves);
    curves->first[1] = POINTS;
    for (int i = 0; i < POINTS; i++) {
        curves->position[i] = vec3(0.5f, -2.0f + 0.1f * (float)i, 0.0f);
        curves->radius[i] = 0.01f;
    }
    add_part(world, (Part){.kind = PART_CURVES, .curves = curves, .material = 0});
    for (int i = 0; i < (lamps ? 3 : 0); i++) {
        add_light(world, (Light){.kind = LIGHT_SPHERE,
                                 .radiance = vec3_splat(1.0f),
                                 .center = {30.0f - 30.0f * (float)i, 20.0f, -10.0f},
                                 .radius = 0.05f});
    }
    Film *film = trace(world, 2, NULL);
    world_free(world);
    return film;
}

static void a_channel_glows_in_fog(void **state)
{
    (void)state;
    Film *film = trace_channel(false);
    double wanted = line_scattering(0.02);
    ASSERT_NEAR(mean_luminance(film) / wanted, 1.0, 0.01 + 3.0 * mean_error(film) / wanted);
    assert_true(mean_error(film) < 0.02 * wanted);
    film_free(film);
}

// They bring a millionth of the light, and must not take samples from the channel.
static void weak_lamps_far_away_add_no_noise(void **state)
{
    (void)state;
    Film *film = trace_channel(false), *lamps = trace_channel(true);
    double wanted = line_scattering(0.02);
    ASSERT_NEAR(mean_luminance(lamps) / wanted, 1.0, 0.01 + 3.0 * mean_error(lamps) / wanted);
    assert_true(mean_error(lamps) < 1.15 * mean_error(film)); // 2.03 times by powers alone
    film_free(film);
    film_free(lamps);
}

// ---- furnaces: what only scatters cannot be seen where light is even

static void scattering_keeps_energy(void **state)
{
    (void)state;
    for (int k = 0; k < 4; k++) {
        World *world = tiny_world(8, 8, 256, 1.0f);
        world->render.max_depth = world->render.roulette_depth = 400;
        world->render.samples = k == 2 ? 128 : 256;
        if (k < 3) {
            world->sky.kind = SKY_CONSTANT;
            world->sky.color = vec3_splat(1.0f);
        }
        Vec3 scattering = vec3(1.0f, 2.0f, 4.0f);
        world->material[1] = clear_body(scattering, vec3_splat(0), 0.5f);
        world->material_count = 2;
        if (k == 0) { // the scene's medium
            world->medium = everywhere(0.0f, 0.0f, 0.5f, 2.0f);
            world->medium.scattering = scattering;
        } else if (k < 3) { // a body, with and without a surface, and something white in it
            world->material[1].ior = k == 1 ? 1.0f : 1.4f;
            add_mesh(world, sphere_mesh(vec3(0, 0, 0), 1.0f, 24, true), 1, 0);
            add_mesh(world, sphere_mesh(vec3(0.2f, 0, 0), 0.3f, 16, true), 0, 0);
        } else { // lit by a shell that is sampled
            world->material[2] = glowing(1.0f);
            world->material_count = 3;
            add_mesh(world, sphere_mesh(vec3(0, 0, 0), 8.0f, 8, true), 2, 0);
            add_mesh(world, sphere_mesh(vec3(0, 0, 0), 1.0f, 24, true), 1, 0);
            world->medium = everywhere(0.1f, 0.0f, 0.3f, 100.0f);
        }
        Film *film = trace(world, 2, NULL);
        ASSERT_NEAR(mean_luminance(film), 1.0, 0.006 + 3.0 * mean_error(film));
        assert_true(mean_error(film) < 0.01);
        film_free(film);
        world_free(world);
    }
}

// What guides a denoiser knows how much a medium hides, not how many of a pixel's few paths
// scattered in it: albedo and normal of every pixel are those of the closed form.
static void guides_see_through_media_without_chance(void **state)
{
    (void)state;
    World *world = tiny_world(8, 8, 2, 0.5f);
    world->camera.fov = 0.01f;
    world->medium = everywhere(0.2f, 0.0f, 0.6f, 100.0f);
    add_mesh(world, quad_mesh(vec3(-2, -2, 0), vec3(4, 0, 0), vec3(0, 4, 0)), 0, 0);
    Film *film = trace(world, 2, NULL);
    double clear = exp(-0.2 * 5.0);
    for (int i = 0; i < 8 * 8; i++) {
        ASSERT_NEAR(film->albedo[i].x, 1.0 - 0.5 * clear, 1e-4);
        ASSERT_NEAR(film->normal[i].z, clear, 1e-4);
    }
    film_free(film);
    world_free(world);
}

// A lamp above a clear, absorbing slab lights the floor under it through the slab.
static void light_is_sampled_through_clear_bodies(void **state)
{
    (void)state;
    double mean[2];
    for (int k = 0; k < 2; k++) {
        World *world = tiny_world(8, 8, 64, 0.5f);
        world->render.max_depth = 1;
        world->camera =
            (Camera){.position = {0, 0.2f, 0}, .target = {0, 0, 0}, .up = {0, 0, 1}, .fov = 0.01f};
        add_mesh(world, quad_mesh(vec3(-4, 0, 4), vec3(8, 0, 0), vec3(0, 0, -8)), 0, 0);
        add_light(world, (Light){.kind = LIGHT_SPHERE,
                                 .radiance = vec3_splat(100.0f),
                                 .center = {0, 4, 0},
                                 .radius = 0.1f});
        world->material[1] = clear_body(vec3_splat(0), vec3_splat(0.7f), 0.0f);
        world->material_count = 2;
        if (k) {
            add_mesh(world, quad_mesh(vec3(-4, 1, -4), vec3(8, 0, 0), vec3(0, 0, 8)), 1, 1);
            add_mesh(world, quad_mesh(vec3(-4, 3, 4), vec3(8, 0, 0), vec3(0, 0, -8)), 1, 1);
        }
        Film *film = trace(world, 2, NULL);
        mean[k] = mean_luminance(film);
        film_free(film);
        world_free(world);
    }
    ASSERT_NEAR(mean[1] / mean[0], exp(-1.4), 0.003);
}

static void same_bits_for_any_thread_count(void **state)
{
    (void)state;
    World *world = tiny_world(24, 24, 8, 0.5f);
    world->medium = everywhere(0.2f, 0.05f, 0.4f, 0.0f);
    world->material[1] = glowing(10.0f);
    world->material[2] = clear_body(vec3(3, 5, 8), vec3_splat(0.2f), 0.6f);
    world->material_count = 3;
    add_mesh(world, sphere_mesh(vec3(0.9f, 1, 0), 0.1f, 8, true), 1, 0);
    add_mesh(world, sphere_mesh(vec3(0, 0, 0), 0.8f, 12, true), 2, 0);
    add_mesh(world, sphere_mesh(vec3(0, 0, 0), 0.3f, 12, true), 0, 0);
    Film *one = trace(world, 1, NULL), *three = trace(world, 3, NULL);
    assert_memory_equal(one->color, three->color, sizeof(Vec3) * 24 * 24);
    assert_true(mean_luminance(one) > 0.01);
    film_free(one);
    film_free(three);
    world_free(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(layer_lengths_equal_sums),
        cmocka_unit_test(drawn_lengths_have_their_density),
        cmocka_unit_test(phase_function_is_drawn_as_it_is),
        cmocka_unit_test(light_fades_by_beer_lambert),
        cmocka_unit_test(what_glows_shines_through_without_chance),
        cmocka_unit_test(single_scattering_equals_the_integral),
        cmocka_unit_test(a_channel_glows_in_fog),
        cmocka_unit_test(weak_lamps_far_away_add_no_noise),
        cmocka_unit_test(scattering_keeps_energy),
        cmocka_unit_test(guides_see_through_media_without_chance),
        cmocka_unit_test(light_is_sampled_through_clear_bodies),
        cmocka_unit_test(same_bits_for_any_thread_count),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
