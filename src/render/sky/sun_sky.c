#include "render/sky/sun_sky.h"

#include "render/warp.h"

#include <stddef.h>

enum { SKY_COLUMNS = 384, SKY_ROWS = 256 };

// The depression below the horizon, radians, over which haze blends into the ground.
static const float HORIZON_SOFTNESS = 0.035f;

static Vec3 sun_direction(const Sky *sky)
{
    float elevation = sky->sun_elevation * RADIANS_PER_DEGREE;
    float azimuth = sky->sun_azimuth * RADIANS_PER_DEGREE;
    return vec3(cosf(elevation) * sinf(azimuth), sinf(elevation), cosf(elevation) * cosf(azimuth));
}

// The irradiance of the disc does not depend on its drawn size.
static Sun make_sun(const Sky *sky, const Atmosphere *atmosphere)
{
    float half = 0.5f * fmaxf(sky->sun_size, 0.01f) * RADIANS_PER_DEGREE;
    float s = sinf(0.5f * half);
    Sun sun = {.direction = sun_direction(sky), .one_minus_cos = 2.0f * s * s};
    sun.solid_angle = 2.0f * PI_F * sun.one_minus_cos;
    Spectrum light = atmosphere_sun_transmittance(atmosphere, sun.direction.y);
    Spectrum solar = atmosphere_solar_irradiance();
    for (int i = 0; i < SPECTRUM_BANDS; i++) {
        light.v[i] *= solar.v[i];
    }
    float scale = sky->strength * sky->sun_strength / (SKY_CANDELA_PER_UNIT * sun.solid_angle);
    sun.radiance = vec3_scale(spectrum_to_rgb(&light), scale);
    return sun;
}

// Row by row from the zenith to the horizon; the two halves beside the sun are symmetric.
static void bake_upper_half(Dome *dome, const Atmosphere *atmosphere, float sine, float scale,
                            const Run *run)
{
    Vec3 sun = vec3(0.0f, sine, sqrtf(fmaxf(0.0f, 1.0f - sine * sine)));
    BandColors colors = spectrum_band_colors();
#pragma omp parallel for schedule(dynamic) num_threads(run->threads)
    for (int row = 0; row < SKY_ROWS / 2; row++) {
        float elevation = dome_elevation(true, ((float)row + 0.5f) / SKY_ROWS);
        DomeEntry *line = dome->entry + row * SKY_COLUMNS;
        Vec3 direction[SKY_COLUMNS / 2];
        Spectrum light[SKY_COLUMNS / 2];
        for (int i = 0; i < SKY_COLUMNS / 2; i++) {
            float azimuth = (0.5f - ((float)i + 0.5f) / SKY_COLUMNS) * 2.0f * PI_F;
            direction[i] = vec3(cosf(elevation) * sinf(azimuth), sinf(elevation),
                                cosf(elevation) * cosf(azimuth));
        }
        atmosphere_radiance_level(atmosphere, direction, SKY_COLUMNS / 2, sun, light);
        for (int i = 0; i < SKY_COLUMNS / 2; i++) {
            line[i].radiance = vec3_scale(spectrum_color(&light[i], &colors), scale);
            line[SKY_COLUMNS - 1 - i] = line[i];
        }
    }
}

// Irradiance of flat ground from the upper half of the dome.
static Vec3 dome_irradiance(const Dome *dome)
{
    Vec3 sum = vec3_splat(0.0f);
    for (int row = 0; row < dome->rows / 2; row++) {
        float rows = (float)dome->rows;
        float a = sinf(dome_elevation(true, (float)row / rows));
        float b = sinf(dome_elevation(true, (float)(row + 1) / rows));
        float weight = 0.5f * (a * a - b * b) * 2.0f * PI_F / (float)dome->columns;
        for (int i = 0; i < dome->columns; i++) {
            sum = vec3_madd(sum, weight, dome->entry[row * dome->columns + i].radiance);
        }
    }
    return sum;
}

static void bake_lower_half(Dome *dome, Vec3 ground)
{
    const DomeEntry *horizon = dome->entry + (SKY_ROWS / 2 - 1) * SKY_COLUMNS;
    for (int row = SKY_ROWS / 2; row < SKY_ROWS; row++) {
        float depression = -dome_elevation(true, ((float)row + 0.5f) / SKY_ROWS);
        float share = 1.0f - expf(-depression / HORIZON_SOFTNESS);
        for (int i = 0; i < SKY_COLUMNS; i++) {
            dome->entry[row * SKY_COLUMNS + i].radiance =
                vec3_lerp(horizon[i].radiance, ground, share);
        }
    }
}

Atmosphere *sky_atmosphere(const Sky *sky, const Run *run, Error *e)
{
    return atmosphere_new(sky->turbidity, sky->ground_albedo, sky->altitude, sun_direction(sky).y,
                          run, e);
}

Dome *sky_dome(const Sky *sky, const Atmosphere *atmosphere, Sun *sun, const Run *run, Error *e)
{
    *sun = make_sun(sky, atmosphere);
    Dome *dome = dome_new(SKY_COLUMNS, SKY_ROWS, true, sky->sun_azimuth * RADIANS_PER_DEGREE, e);
    if (dome) {
        bake_upper_half(dome, atmosphere, sun->direction.y, sky->strength / SKY_CANDELA_PER_UNIT,
                        run);
        Vec3 light = vec3_madd(dome_irradiance(dome),
                               fmaxf(sun->direction.y, 0.0f) * sun->solid_angle, sun->radiance);
        bake_lower_half(dome, vec3_scale(light, sky->ground_albedo / PI_F));
        dome_prepare(dome);
    }
    return dome;
}

static float one_minus_cos_to(const Sun *sun, Vec3 direction)
{
    Vec3 d = vec3_sub(direction, sun->direction);
    return 0.5f * vec3_dot(d, d); // exact for small angles, where a cosine is not
}

bool sun_covers(const Sun *sun, Vec3 direction)
{
    return one_minus_cos_to(sun, direction) < sun->one_minus_cos;
}

// Linear limb darkening with coefficient 0.6 (visible light), of mean 1.
Vec3 sun_radiance(const Sun *sun, Vec3 direction)
{
    float off = one_minus_cos_to(sun, direction);
    if (off >= sun->one_minus_cos) {
        return vec3_splat(0.0f);
    }
    if (sun->even) {
        return sun->radiance;
    }
    float mu = sqrtf(1.0f - off / sun->one_minus_cos);
    return vec3_scale(sun->radiance, (0.4f + 0.6f * mu) / 0.8f);
}

Vec3 sun_sample(const Sun *sun, float u, float v)
{
    float off = u * sun->one_minus_cos;
    return warp_cone(sun->direction, 1.0f - off, sqrtf(off * (2.0f - off)), v);
}
