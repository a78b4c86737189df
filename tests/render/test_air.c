// Aerial perspective against the sky itself, Koschmieder's law and a path's own parts.
#include "tiny_world.h"

#include "render/light/lights.h"
#include "render/sky/air.h"
#include "render/sky/sun_sky.h"

static Sky sky_of(float turbidity, float scale, float sun_elevation)
{
    World *world = world_new(NULL);
    assert_non_null(world);
    Sky sky = world->sky;
    world_free(world);
    sky.turbidity = turbidity;
    sky.sun_elevation = sun_elevation;
    sky.aerial_perspective = scale;
    return sky;
}

static Air *make_air(const Sky *sky)
{
    Run run = run_default();
    Atmosphere *atmosphere = sky_atmosphere(sky, &run, NULL);
    assert_non_null(atmosphere);
    Air *air = air_new(atmosphere, sky, NULL);
    assert_non_null(air);
    return air;
}

static Vec3 toward(float elevation, float azimuth)
{
    float e = elevation * RADIANS_PER_DEGREE, a = azimuth * RADIANS_PER_DEGREE;
    return vec3(cosf(e) * sinf(a), sinf(e), cosf(e) * cosf(a));
}

// The mean over `at`.
static Vec3 veil(const Air *air, Vec3 from, Vec3 direction, float distance, Vec3 sun, Vec3 *clear)
{
    enum { DRAWS = 512 };
    Vec3 sum = vec3_splat(0.0f);
    for (int i = 0; i < DRAWS; i++) {
        AirView view = air_view(air, from, direction, distance, sun, ((float)i + 0.5f) / DRAWS);
        assert_in_range((long)view.at, 0, (long)distance);
        sum = vec3_madd(sum, 1.0f / DRAWS, vec3_add(view.glow, view.sunlit));
        *clear = view.clear;
    }
    return sum;
}

static void assert_near(Vec3 a, Vec3 b, float share)
{
    float scale = fmaxf(b.x, fmaxf(b.y, b.z));
    float off = vec3_length(vec3_sub(a, b));
    if (!(off <= share * scale)) {
        fail_msg("%g %g %g, not %g %g %g", (double)a.x, (double)a.y, (double)a.z, (double)b.x,
                 (double)b.y, (double)b.z);
    }
}

// All the air along a ray upward is the sky, but for the few steps that a view takes.
static void air_without_end_is_the_sky(void **state)
{
    (void)state;
    Sky sky = sky_of(2.0f, 1.0f, 35.0f);
    Air *air = make_air(&sky);
    Run run = run_default();
    Atmosphere *atmosphere = sky_atmosphere(&sky, &run, NULL);
    assert_non_null(atmosphere);
    Vec3 sun = toward(35.0f, 0.0f), clear;
    for (int i = 0; i < 4; i++) {
        Vec3 direction = toward(25.0f + 15.0f * (float)i, 50.0f * (float)i);
        Spectrum light = atmosphere_radiance(atmosphere, direction, sun);
        Vec3 whole = vec3_scale(spectrum_to_rgb(&light), 1.0f / SKY_CANDELA_PER_UNIT);
        float length = 60e3f / direction.y;
        assert_near(veil(air, vec3_splat(0.0f), direction, length, sun, &clear), whole, 0.08f);
    }
    atmosphere_free(atmosphere);
    air_free(air);
}

// Koschmieder: along level ground light fades by e^-distance/length; more of the blue is lost.
static void level_air_fades_by_its_length(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        float turbidity = 1.0f + 0.6f * (float)i;
        Sky sky = sky_of(turbidity, 1.0f, 40.0f);
        sky.altitude = 0.0f;
        Air *air = make_air(&sky);
        float length = 1000.0f * atmosphere_clear_length(turbidity);
        AirView view = air_view(air, vec3_splat(0.0f), vec3(1, 0, 0), 0.5f * length,
                                toward(40.0f, 0.0f), 0.5f);
        assert_in_range((int)(1000.0f * view.clear.y), 570, 650); // e^-0.5 = 0.607
        assert_true(view.clear.z < view.clear.y && view.clear.y < view.clear.x);
        air_free(air);
    }
}

// What two halves of a ray do one after the other is what the whole does.
static void halves_make_a_whole(void **state)
{
    (void)state;
    Sky sky = sky_of(1.6f, 1.0f, 20.0f);
    Air *air = make_air(&sky);
    Vec3 sun = toward(20.0f, 30.0f), direction = toward(4.0f, 80.0f), from = vec3(0, 300, 0);
    Vec3 clear, clear_near, clear_far;
    Vec3 whole = veil(air, from, direction, 20e3f, sun, &clear);
    Vec3 near = veil(air, from, direction, 10e3f, sun, &clear_near);
    Vec3 far = veil(air, vec3_madd(from, 10e3f, direction), direction, 10e3f, sun, &clear_far);
    assert_near(vec3_mul(clear_near, clear_far), clear, 0.02f);
    assert_near(vec3_add(near, vec3_mul(clear_near, far)), whole, 0.03f);
    air_free(air);
}

// A model of a land, built at a tenth of its size, with ten metres of air for a metre.
static void scale_counts_as_distance(void **state)
{
    (void)state;
    Sky large = sky_of(1.6f, 1.0f, 20.0f), small = sky_of(1.6f, 10.0f, 20.0f);
    Air *air = make_air(&large), *model = make_air(&small);
    Vec3 sun = toward(20.0f, 30.0f), direction = toward(-3.0f, 80.0f), clear, clear_model;
    Vec3 a = veil(air, vec3(0, 2000, 0), direction, 20e3f, sun, &clear);
    Vec3 b = veil(model, vec3(0, 200, 0), direction, 2e3f, sun, &clear_model);
    assert_near(b, a, 1e-4f);
    assert_near(clear_model, clear, 1e-4f);
    air_free(air);
    air_free(model);
}

static void high_air_is_thinner(void **state)
{
    (void)state;
    Sky sea = sky_of(2.0f, 1.0f, 40.0f), plateau = sea;
    plateau.altitude = 4000.0f;
    Air *air = make_air(&sea), *thin = make_air(&plateau);
    Vec3 sun = toward(40.0f, 0.0f), zero = vec3_splat(0.0f);
    AirView low = air_view(air, zero, vec3(1, 0, 0), 10e3f, sun, 0.5f);
    AirView high = air_view(thin, zero, vec3(1, 0, 0), 10e3f, sun, 0.5f);
    AirView hill = air_view(air, vec3(0, 3950, 0), vec3(1, 0, 0), 10e3f, sun, 0.5f);
    assert_true(high.clear.y > low.clear.y + 0.3f);
    assert_near(hill.clear, high.clear, 1e-4f);
    air_free(air);
    air_free(thin);
}

// Air in front of a black wall 8 km away; a roof of 3 km may shade it all.
static Vec3 air_before_wall(bool roof, bool clear_day)
{
    World *world = tiny_world(4, 4, 64, 0.0f);
    world->sky.kind = SKY_SUN_SKY;
    world->sky.sun_elevation = 60.0f;
    world->sky.sun_azimuth = 0.0f;
    world->sky.turbidity = 1.5f;
    world->sky.aerial_perspective = clear_day ? 0.0f : 1.0f;
    world->camera.position = vec3(0, 100, 0);
    world->camera.target = vec3(0, 100, -8000);
    world->camera.fov = 2.0f;
    add_mesh(world, quad_mesh(vec3(-900, 0, -8000), vec3(1800, 0, 0), vec3(0, 900, 0)), 0, 0);
    if (roof) {
        Vec3 corner = vec3(-20e3f, 400, 20e3f);
        add_mesh(world, quad_mesh(corner, vec3(40e3f, 0, 0), vec3(0, 0, -40e3f)), 0, 1);
    }
    Film *film = trace(world, 1, NULL);
    // the two about the middle: one looks a little up, one down
    Vec3 color = vec3_lerp(film->color[film->width + 2], film->color[2 * film->width + 2], 0.5f);
    film_free(film);
    world_free(world);
    return color;
}

static void shaded_air_is_dark(void **state)
{
    (void)state;
    Vec3 lit = air_before_wall(false, false), shaded = air_before_wall(true, false);
    assert_near(air_before_wall(false, true), vec3_splat(0.0f), 0.0f);
    assert_true(lit.z > 0.05f && lit.z > 1.2f * lit.x); // blue
    Sky sky = sky_of(1.5f, 1.0f, 60.0f);
    Air *air = make_air(&sky);
    Vec3 from = vec3(0, 100, 0), direction = vec3(0, 0, -1), sun = toward(60.0f, 0.0f), clear;
    assert_near(lit, veil(air, from, direction, 8000.0f, sun, &clear), 0.02f);
    assert_near(shaded, air_view(air, from, direction, 8000.0f, sun, 0.5f).glow, 0.01f);
    assert_true(lit.y > 1.2f * shaded.y);
    air_free(air);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(air_without_end_is_the_sky),
        cmocka_unit_test(level_air_fades_by_its_length),
        cmocka_unit_test(halves_make_a_whole),
        cmocka_unit_test(scale_counts_as_distance),
        cmocka_unit_test(high_air_is_thinner),
        cmocka_unit_test(shaded_air_is_dark),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
