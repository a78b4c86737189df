// The night sky: stars keep their light at any resolution, the moon lights what it should.
#include "tiny_world.h"

#include "render/light/lights.h"
#include "render/sky/night.h"

#define ASSERT_NEAR(value, wanted, tolerance)                                             \
    do {                                                                                  \
        double v_ = (double)(value), w_ = (double)(wanted);                               \
        if (!(fabs(v_ - w_) <= (double)(tolerance))) {                                    \
            fail_msg("%s = %.6g, not %.6g +- %.2g", #value, v_, w_, (double)(tolerance)); \
        }                                                                                 \
    } while (0)

// All light of the stars in a patch of the sky, smoothed over two widths, by fine summing.
static double patch_light(const Sky *sky, float spread)
{
    enum { N = 1200 };
    const float width = 0.25f;
    double sum = 0.0;
    for (int i = 0; i < N * N; i++) {
        float x = (((float)(i % N) + 0.5f) / N - 0.5f) * width;
        float z = (((float)(i / N) + 0.5f) / N - 0.5f) * width;
        Vec3 light = night_stars(sky, vec3_normalize(vec3(x, 1.0f, z)), spread);
        sum += (double)(luminance(light) * width * width / (N * N));
    }
    return sum;
}

static void stars_keep_their_light(void **state)
{
    (void)state;
    Sky sky = {.kind = SKY_NIGHT, .stars = 1.0f, .strength = 1.0f};
    double fine = patch_light(&sky, 8e-4f), coarse = patch_light(&sky, 2.4e-3f);
    assert_true(fine > 1e-6);
    ASSERT_NEAR(coarse / fine, 1.0, 0.1);
    sky.stars = 2.0f;
    ASSERT_NEAR(patch_light(&sky, 2.4e-3f) / coarse, 2.0, 1e-4);
    Vec3 below = night_stars(&sky, vec3_normalize(vec3(0.3f, -0.1f, 0.2f)), 1e-3f);
    ASSERT_NEAR(luminance(below), 0.0, 0.0);
}

// A white floor under the moon alone has its irradiance over pi.
static void moon_lights_the_ground(void **state)
{
    (void)state;
    double mean[2];
    for (int k = 0; k < 2; k++) {
        World *world = tiny_world(8, 8, 64, 1.0f);
        world->render.max_depth = 1;
        world->sky.kind = SKY_NIGHT;
        world->sky.moon = k ? 3.0f : 0.0f;
        world->sky.moon_elevation = 90.0f;
        world->sky.moon_size = 2.0f;
        world->camera =
            (Camera){.position = {0, 1, 0}, .target = {0, 0, 0}, .up = {0, 0, 1}, .fov = 0.01f};
        add_mesh(world, quad_mesh(vec3(-4, 0, 4), vec3(8, 0, 0), vec3(0, 0, -8)), 0, 0);
        Film *film = trace(world, 2, NULL);
        mean[k] = (double)film->color[27].x;
        film_free(film);
        world_free(world);
    }
    assert_true(mean[0] > 0.001 && mean[0] < 0.05);
    ASSERT_NEAR(mean[1] * (double)PI_F / 3.0, 1.0, 0.15); // with the sky that the moon lights
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stars_keep_their_light),
        cmocka_unit_test(moon_lights_the_ground),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
