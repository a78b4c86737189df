// The sky against what photometers read under the real one, and the dome it is baked into.
#include "tiny_world.h"

#include "render/light/lights.h"
#include "render/sky/atmosphere.h"
#include "render/sky/sun_sky.h"

static Dome *make_sky(float elevation, float turbidity, Sun *sun)
{
    World *world = world_new(NULL);
    assert_non_null(world);
    world->sky.sun_elevation = elevation;
    world->sky.sun_azimuth = 0.0f;
    world->sky.turbidity = turbidity;
    Run run = run_default();
    Atmosphere *atmosphere = sky_atmosphere(&world->sky, &run, NULL);
    assert_non_null(atmosphere);
    Dome *dome = sky_dome(&world->sky, atmosphere, sun, &run, NULL);
    assert_non_null(dome);
    atmosphere_free(atmosphere);
    world_free(world);
    return dome;
}

static float candela(const Dome *dome, float elevation, float azimuth)
{
    float e = elevation * RADIANS_PER_DEGREE, a = azimuth * RADIANS_PER_DEGREE;
    Vec3 d = vec3(cosf(e) * sinf(a), sinf(e), cosf(e) * cosf(a));
    return luminance(dome_lookup(dome, d)) * SKY_CANDELA_PER_UNIT;
}

// Light from the whole upper half on level ground, lux.
static float sky_lux(const Dome *dome)
{
    double sum = 0.0;
    for (int row = 0; row < dome->rows / 2; row++) {
        double a = (double)dome->edge[row], b = (double)dome->edge[row + 1];
        for (int i = 0; i < dome->columns; i++) {
            sum += (double)luminance(dome->entry[row * dome->columns + i].radiance) * 0.5 *
                   (a * a - b * b) * 2.0 * (double)PI_F / dome->columns;
        }
    }
    return (float)sum * SKY_CANDELA_PER_UNIT;
}

static float sun_lux(const Sun *sun) // facing it
{
    return luminance(sun->radiance) * sun->solid_angle * SKY_CANDELA_PER_UNIT;
}

#define ASSERT_BETWEEN(value, low, high)                                                     \
    do {                                                                                     \
        double v_ = (double)(value);                                                         \
        if (!(v_ >= (double)(low) && v_ <= (double)(high))) {                                \
            fail_msg("%s = %g, not in %g .. %g", #value, v_, (double)(low), (double)(high)); \
        }                                                                                    \
    } while (0)

// The solar illuminance constant: 128 to 134 klx by different spectra.
static void solar_constant_in_lux(void **state)
{
    (void)state;
    Spectrum solar = atmosphere_solar_irradiance();
    ASSERT_BETWEEN(luminance(spectrum_to_rgb(&solar)), 124e3, 136e3);
}

// Clear-day readings: IES and CIE tables of direct and diffuse illuminance, zenith luminance after
// CIE 110-1994. Wide, because days differ.
static void luminance_in_published_ranges(void **state)
{
    (void)state;
    Sun sun;
    Dome *noon = make_sky(60.0f, 2.5f, &sun);
    ASSERT_BETWEEN(sun_lux(&sun), 80e3, 112e3);
    ASSERT_BETWEEN(sky_lux(noon), 9e3, 26e3);
    ASSERT_BETWEEN(candela(noon, 90, 0), 1.5e3, 9e3);
    ASSERT_BETWEEN(candela(noon, 5, 180), 3e3, 16e3);
    dome_free(noon);
    Dome *afternoon = make_sky(20.0f, 2.5f, &sun);
    ASSERT_BETWEEN(sun_lux(&sun), 45e3, 85e3);
    ASSERT_BETWEEN(sky_lux(afternoon), 5e3, 14e3);
    ASSERT_BETWEEN(candela(afternoon, 90, 0), 0.8e3, 3.5e3);
    dome_free(afternoon);
    Dome *low = make_sky(5.0f, 2.5f, &sun);
    ASSERT_BETWEEN(sun_lux(&sun), 8e3, 40e3);
    ASSERT_BETWEEN(sky_lux(low), 1.5e3, 7e3);
    dome_free(low);
    Dome *dusk = make_sky(-4.0f, 2.5f, &sun);
    assert_true(sun_lux(&sun) == 0.0f);
    ASSERT_BETWEEN(sky_lux(dusk), 5, 120); // civil twilight
    dome_free(dusk);
}

static void sky_is_blue_and_the_low_sun_red(void **state)
{
    (void)state;
    Sun high, low;
    Dome *dome = make_sky(45.0f, 2.0f, &high);
    Vec3 zenith = dome_lookup(dome, vec3(0, 1, 0));
    ASSERT_BETWEEN(zenith.z / zenith.x, 2.0, 6.0);
    Vec3 horizon = dome_lookup(dome, vec3_normalize(vec3(0, 0.03f, -1)));
    assert_true(horizon.z / horizon.x < zenith.z / zenith.x); // paler
    assert_true(luminance(horizon) > luminance(zenith));
    dome_free(dome);
    dome = make_sky(3.0f, 2.0f, &low);
    assert_true(low.radiance.z / low.radiance.x < 0.4f * high.radiance.z / high.radiance.x);
    assert_true(low.radiance.y / low.radiance.x < 0.9f * high.radiance.y / high.radiance.x);
    assert_true(candela(dome, 3, 0) > 4.0f * candela(dome, 3, 90)); // brighter about the sun
    Vec3 right = dome_lookup(dome, vec3_normalize(vec3(0.5f, 0.2f, 1)));
    Vec3 left = dome_lookup(dome, vec3_normalize(vec3(-0.5f, 0.2f, 1)));
    assert_true(fabsf(luminance(right) - luminance(left)) < 1e-3f * luminance(left));
    dome_free(dome);
}

static void haze_and_strength(void **state)
{
    (void)state;
    Sun clear, hazy;
    Dome *a = make_sky(40.0f, 2.0f, &clear), *b = make_sky(40.0f, 6.0f, &hazy);
    assert_true(sun_lux(&hazy) < 0.75f * sun_lux(&clear));
    assert_true(candela(b, 40, 10) > 1.5f * candela(a, 40, 10)); // the aureole
    assert_true(sky_lux(b) > 1.3f * sky_lux(a));
    dome_free(a);
    dome_free(b);
}

// The disc's light is the same whatever size it is drawn with, and its mean is the stated radiance.
static void sun_disc(void **state)
{
    (void)state;
    Sun sun;
    dome_free(make_sky(30.0f, 2.5f, &sun));
    double mean = 0.0;
    for (int i = 0; i < 1000; i++) {
        Vec3 d = sun_sample(&sun, ((float)i + 0.5f) / 1000.0f, (float)(i * 37 % 100) / 100.0f);
        mean += (double)luminance(sun_radiance(&sun, d)) / 1000.0;
    }
    assert_true(fabs(mean / (double)luminance(sun.radiance) - 1.0) < 0.01);
    Vec3 aside = vec3_normalize(vec3_add(sun.direction, vec3(0.006f, 0, 0)));
    assert_false(sun_covers(&sun, aside));
    assert_true(sun_covers(&sun, sun.direction));
}

enum { BINS_AROUND = 12, BINS_UP = 8, BINS = BINS_AROUND * BINS_UP };

static int bin_of(Vec3 d)
{
    int across = (int)((atan2f(d.x, d.z) / (2.0f * PI_F) + 0.5f) * (float)BINS_AROUND);
    int up = (int)((0.5f * d.y + 0.5f) * (float)BINS_UP);
    return (up < BINS_UP ? up : BINS_UP - 1) * BINS_AROUND +
           (across < BINS_AROUND ? across : BINS_AROUND - 1);
}

static DomeLight light_toward(const Dome *dome, Vec3 direction)
{
    DomePlace place = dome_find(dome, direction);
    return dome_at(dome, &place);
}

// Drawn directions fall into parts of the sphere in proportion to the integral over them of the
// density that dome_at tells, carry its radiance and density, and are drawn where the luminance
// exceeds its mean alone.
static void check_dome_sampling(const Dome *dome)
{
    enum { N = 768 };
    double drawn[BINS] = {0.0}, wanted[BINS] = {0.0}, total = 0.0, mean = 0.0;
    for (int i = 0; i < N * N; i++) {
        float u = ((float)(i % N) + 0.5f) / N, v = ((float)(i / N) + 0.5f) / N;
        DomeLight light;
        Vec3 d = dome_sample(dome, u, v, &light);
        assert_float_equal(vec3_length(d), 1.0f, 1e-5f);
        assert_true(light.density > 0.0f);
        DomeLight near = light_toward(dome, d);
        assert_float_equal(near.density, light.density, 5e-3f * light.density + 1e-3f);
        assert_float_equal(near.radiance.y, light.radiance.y, 5e-3f * light.radiance.y + 1e-3f);
        drawn[bin_of(d)] += 1.0 / (N * N);
        float z = 2.0f * v - 1.0f, r = sqrtf(1.0f - z * z), a = 2.0f * PI_F * u;
        Vec3 even = vec3(r * sinf(a), z, r * cosf(a));
        double share = (double)light_toward(dome, even).density * 4.0 * (double)PI_F / (N * N);
        mean += (double)luminance(dome_lookup(dome, even)) / (N * N);
        wanted[bin_of(even)] += share;
        total += share;
    }
    assert_true(fabs(total - 1.0) < 2e-3);
    for (int i = 0; i < BINS; i++) {
        assert_true(fabs(drawn[i] - wanted[i]) < 1e-3);
    }
    for (int64_t i = 0; i < (int64_t)dome->rows * dome->columns; i++) {
        double excess = (double)luminance(dome->entry[i].radiance) - mean;
        assert_true(fabs((double)dome->entry[i].weight - fmax(excess, 0.0)) < 2e-3 * mean);
    }
}

static void directions_are_drawn_as_the_sky_shines(void **state)
{
    (void)state;
    Sun sun;
    Dome *dome = make_sky(10.0f, 3.0f, &sun);
    check_dome_sampling(dome);
    dome_free(dome);
}

// Few entries, most of them black: the light between them is that of the bilinear lookup.
static void directions_are_drawn_as_a_coarse_picture_shines(void **state)
{
    (void)state;
    Error e = {0};
    Dome *dome = dome_new(8, 4, false, 0.7f, &e);
    assert_non_null(dome);
    dome->entry[1 * 8 + 2].radiance = vec3(3, 1, 0.5f);
    dome->entry[0 * 8 + 7].radiance = vec3(0, 0, 2);
    dome->entry[3 * 8 + 0].radiance = vec3(1, 1, 1);
    dome_prepare(dome);
    check_dome_sampling(dome);
    dome_free(dome);
}

// BSDF sampling finds even light as well, so no direction is drawn.
static void a_dome_of_one_colour_has_no_power(void **state)
{
    (void)state;
    Error e = {0};
    Dome *dome = dome_new(16, 8, false, 0.0f, &e);
    assert_non_null(dome);
    for (int color = 0; color < 2; color++) {
        for (int i = 0; i < 16 * 8; i++) {
            dome->entry[i].radiance = vec3_scale(vec3(0.3f, 0.7f, 0.9f), (float)color);
        }
        dome_prepare(dome);
        assert_true(dome->power == 0.0f);
        assert_true(light_toward(dome, vec3(0, 1, 0)).density == 0.0f);
        assert_float_equal(light_toward(dome, vec3(0, 1, 0)).radiance.y, 0.7f * (float)color,
                           1e-6f);
    }
    dome_free(dome);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solar_constant_in_lux),
        cmocka_unit_test(luminance_in_published_ranges),
        cmocka_unit_test(sky_is_blue_and_the_low_sun_red),
        cmocka_unit_test(haze_and_strength),
        cmocka_unit_test(sun_disc),
        cmocka_unit_test(directions_are_drawn_as_the_sky_shines),
        cmocka_unit_test(directions_are_drawn_as_a_coarse_picture_shines),
        cmocka_unit_test(a_dome_of_one_colour_has_no_power),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
