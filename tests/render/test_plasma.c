// Glowing gas: what a ray gathers in balls and curves, tints of tips, and light that goes through.
#include "render/tiny_world.h"

#include "render/material/plasma.h"

#include <math.h>

// A surface whose normal has this cosine to a ray along -z.
static SurfacePoint met_at(float cosine)
{
    Vec3 normal = vec3(sqrtf(1.0f - cosine * cosine), 0.0f, cosine);
    return (SurfacePoint){.geometric_normal = normal, .normal = normal};
}

static float gathered(const Material *m, const SurfacePoint *point)
{
    return plasma_radiance(m, point, vec3(0, 0, -1)).y;
}

static void ball_gathers_its_chord(void **state)
{
    (void)state;
    Material m = material_default(MATERIAL_PLASMA);
    m.radiance = vec3_splat(3.0f);
    SurfacePoint point = met_at(0.6f);
    m.roughness = 0.0f;
    assert_float_equal(gathered(&m, &point), 1.8f, 1e-5f);
    m.roughness = 1.0f;
    assert_float_equal(gathered(&m, &point), 3.0f * powf(0.6f, 8.0f), 1e-5f);
    point.backface = true;
    assert_float_equal(gathered(&m, &point), 0.0f, 0.0f);
}

// The ray meets the curve's axis at 60 degrees: through the middle its chord is 1 / sin 60 as long
// as from the side.
static void slanted_curve_is_deeper(void **state)
{
    (void)state;
    Material m = material_default(MATERIAL_PLASMA);
    float sine = sqrtf(0.75f);
    SurfacePoint point = met_at(sine);
    point.radius = 0.01f;
    point.tangent_v = vec3(-sine, 0.0f, 0.5f);
    assert_float_equal(gathered(&m, &point), 1.0f / sine, 1e-4f);
    point.tangent_v = vec3(0, 0, 1); // along the ray, it is not endless
    assert_true(gathered(&m, &point) <= 4.0f);
}

static void tips_are_tinted(void **state)
{
    (void)state;
    Material m = material_default(MATERIAL_PLASMA);
    m.radiance = vec3(2, 4, 8);
    m.color2 = vec3(0.5f, 0.25f, 2.0f);
    SurfacePoint point = met_at(1.0f);
    assert_float_equal(gathered(&m, &point), 4.0f, 1e-5f);
    point.birth = 0.5f;
    assert_float_equal(gathered(&m, &point), 2.5f, 1e-5f);
    point.birth = 1.0f;
    assert_float_equal(gathered(&m, &point), 1.0f, 1e-5f);
}

// A matt wall under a lamp, and a sheet of gas that glows so before both.
static double seen_through(float radiance, float albedo)
{
    World *world = tiny_world(16, 16, 128, albedo);
    world->camera.fov = 4.0f;
    world->material_count = 2;
    world->material[1] = material_default(MATERIAL_PLASMA);
    world->material[1].radiance = vec3_splat(fmaxf(radiance, 0.0f));
    add_mesh(world, quad_mesh(vec3(-2, -2, 0), vec3(4, 0, 0), vec3(0, 4, 0)), 0, 0);
    add_light(world, (Light){.kind = LIGHT_SPHERE,
                             .radiance = vec3_splat(40.0f),
                             .center = vec3(2.0f, 2.2f, 3.0f),
                             .radius = 0.3f});
    if (radiance >= 0.0f) {
        add_mesh(world, quad_mesh(vec3(-9, -9, 1), vec3(18, 0, 0), vec3(0, 18, 0)), 1, 1);
    }
    Film *film = trace(world, 2, NULL);
    double mean = mean_luminance(film);
    film_free(film);
    world_free(world);
    return mean;
}

static void lamp_and_eye_look_through(void **state)
{
    (void)state;
    double bare = seen_through(-1.0f, 0.5f);
    assert_true(bare > 0.03);
    assert_true(fabs(seen_through(0.0f, 0.5f) / bare - 1.0) < 0.01);
}

static void light_is_added(void **state)
{
    (void)state;
    assert_float_equal(seen_through(0.7f, 0.0f), 0.7f, 0.002f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ball_gathers_its_chord), cmocka_unit_test(slanted_curve_is_deeper),
        cmocka_unit_test(tips_are_tinted),        cmocka_unit_test(lamp_and_eye_look_through),
        cmocka_unit_test(light_is_added),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
