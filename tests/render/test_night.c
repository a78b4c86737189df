// The night sky: stars keep their light at any resolution, the moon lights what it should.
#include "tiny_world.h"

#include "render/light/lights.h"
#include "render/sky/ephemeris.h"
#include "render/sky/night.h"
#include "render/sky/stars.h"

#include <stdio.h>

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

static Vec3 toward(double elevation, double azimuth)
{
    double e = elevation / 57.29577951, a = azimuth / 57.29577951;
    return vec3((float)(cos(e) * sin(a)), (float)sin(e), (float)(cos(e) * cos(a)));
}

// The brightest radiance within a third of a degree.
static float brightest(const Sky *sky, Vec3 at)
{
    float best = 0.0f;
    Vec3 side = vec3_normalize(vec3_cross(at, vec3(0.3f, 0.9f, 0.1f))), up = vec3_cross(side, at);
    for (int i = 0; i < 121 * 121; i++) {
        float x = (float)(i % 121 - 60) * 1e-4f, y = (float)(i / 121 - 60) * 1e-4f;
        Vec3 d = vec3_normalize(vec3_madd(vec3_madd(at, x, side), y, up));
        best = fmaxf(best, luminance(night_stars(sky, d, 1e-3f)));
    }
    return best;
}

// Greenwich at noon of 2000-01-01: the sidereal time is 18 h 41.8 min, so Vega (18 h 36.9
// min, 38.78 degrees) has just passed the meridian at 90 - 51.48 + 38.78 degrees. Polaris is within
// a degree of the pole.
static void bright_stars_stand_where_they_do(void **state)
{
    (void)state;
    double days;
    bool zoned;
    assert_true(ephemeris_days("2000-01-01T12:00Z", &days, &zoned));
    double sidereal = ephemeris_sidereal(days, 0.0);
    ASSERT_NEAR(sidereal, 280.46, 0.01);
    Sky sky = {.kind = SKY_NIGHT,
               .stars = 1.0f,
               .strength = 1.0f,
               .latitude = 51.4788f,
               .sidereal = (float)sidereal};
    float vega = brightest(&sky, toward(77.26, -4.3)); // west of south
    float aside = brightest(&sky, toward(77.26, 0.0));
    float polaris = brightest(&sky, toward(51.48 - 0.25, 180.0 - 1.1));
    ASSERT_NEAR(log10((double)(vega / polaris)) / 0.4, 1.98 - 0.03, 0.15);
    assert_true(vega > 50.0f * aside);
}

// The mean of the moon's face over its disc, and the share of the full moon's light at a time.
static double moon_share(const char *time, double *face)
{
    double days;
    bool zoned;
    assert_true(ephemeris_days(time, &days, &zoned));
    double longitude = -180.0;
    SkyPlace moon = ephemeris_moon(days, 0.0, longitude);
    while (moon.elevation < 55.0 && longitude < 180.0) {
        longitude += 5.0;
        moon = ephemeris_moon(days, 0.0, longitude);
    }
    SkyPlace sun = ephemeris_sun(days, 0.0, longitude);
    char text[32];
    snprintf(text, sizeof text, "%s", time);
    Sky sky = {.kind = SKY_NIGHT,
               .strength = 1.0f,
               .moon = 1.0f,
               .moon_size = 0.53f,
               .moon_elevation = (float)moon.elevation,
               .moon_azimuth = (float)moon.azimuth,
               .sun_elevation = (float)sun.elevation,
               .sun_azimuth = (float)sun.azimuth,
               .time = text};
    Sun disc, full;
    dome_free(night_dome(&sky, &disc, NULL));
    double sum = 0.0, inside = 0.0;
    float radius = sqrtf(2.0f * disc.one_minus_cos);
    Vec3 side = vec3_normalize(vec3_cross(disc.direction, vec3(0.3f, 0.9f, 0.1f)));
    Vec3 up = vec3_cross(side, disc.direction);
    for (int i = 0; i < 101 * 101; i++) {
        float x = (float)(i % 101 - 50) / 50.0f, y = (float)(i / 101 - 50) / 50.0f;
        if (x * x + y * y < 1.0f) {
            Vec3 d = vec3_madd(vec3_madd(disc.direction, x * radius, side), y * radius, up);
            sum += (double)night_moon_face(&sky, &disc, vec3_normalize(d));
            inside += 1.0;
        }
    }
    *face = sum / inside;
    sky.time = NULL;
    dome_free(night_dome(&sky, &full, NULL));
    return (double)(disc.radiance.x / full.radiance.x);
}

// The lunar eclipse of 2026-03-03 and the quarter of 2026-02-24; a quarter moon has a twelfth of
// the light of a full one (Krisciunas and Schaefer 1991).
static void moon_has_phases(void **state)
{
    (void)state;
    double face, full, quarter = moon_share("2026-02-24T12:28Z", &face);
    ASSERT_NEAR(quarter, 0.084, 0.012);
    ASSERT_NEAR(face, 1.05, 0.25); // the seas are dark
    full = moon_share("2026-03-03T11:34Z", &face);
    assert_true(full > 0.93 && full <= 1.0);
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
        cmocka_unit_test(bright_stars_stand_where_they_do),
        cmocka_unit_test(moon_has_phases),
        cmocka_unit_test(moon_lights_the_ground),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
