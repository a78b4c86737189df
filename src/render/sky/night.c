#include "render/sky/night.h"

#include "render/material/pattern_noise.h"
#include "render/sky/stars.h"

#include <stddef.h>

enum { COLUMNS = 384, ROWS = 256 };

// What the Earth sends to the dark part of the moon, of what the sun sends to the other.
static const float EARTHSHINE = 1e-4f;

// ---- what glows

// On the celestial sphere: the galaxy's north pole, and its centre.
static const Vec3 GALAXY = {-0.8677f, -0.1981f, 0.4560f}, CENTER = {-0.0549f, -0.8734f, -0.4838f};

// d: on the celestial sphere.
static Vec3 milky_way(Vec3 d)
{
    float off = vec3_dot(d, GALAXY),
          bulge = 0.7f + 0.6f * smoothstepf(-0.3f, 1.0f, vec3_dot(d, CENTER));
    float cloud = noise_fractal(vec3_scale(d, 3.0f), 5, 71);
    float rift = noise_fractal(vec3_scale(d, 7.0f), 4, 72);
    float bent = off + 0.05f * cloud;
    float band = expf(-bent * bent / 0.030f) * clampf(0.75f + 0.7f * cloud, 0.0f, 2.0f);
    float dark = expf(-off * off / 0.003f) * clampf(0.5f + rift, 0.0f, 1.0f);
    return vec3_scale(vec3(0.0055f, 0.0053f, 0.0060f), band * bulge * (1.0f - 0.7f * dark));
}

// Airglow brightens toward the horizon, where the layer is seen edge-on, until extinction dims it.
static Vec3 glow_at(const Sky *sky, Vec3 d)
{
    float rise = fmaxf(d.y, 0.0f);
    float layer = 1.0f / sqrtf(1.0f - 0.96f * (1.0f - rise * rise));
    float clear = expf(-0.12f / (rise + 0.06f));
    Vec3 light = vec3_scale(vec3(0.0022f, 0.0040f, 0.0062f), 0.5f + 0.5f * layer * clear);
    light = vec3_madd(light, clear, milky_way(star_sphere(sky, d)));
    light = vec3_madd(light, 0.06f * sky->moon * (0.4f + 0.6f * expf(-3.0f * rise)),
                      vec3(0.30f, 0.55f, 1.0f));
    float town = noise_fractal(vec3(3.0f * d.x, 0.0f, 3.0f * d.z), 3, 73);
    float city = sky->city_glow * expf(-rise / 0.09f) * clampf(0.6f + 0.8f * town, 0.1f, 2.0f);
    return vec3_madd(light, city, vec3(0.055f, 0.032f, 0.015f));
}

static Vec3 direction_at(float elevation_degrees, float azimuth_degrees)
{
    float elevation = elevation_degrees * RADIANS_PER_DEGREE;
    float azimuth = azimuth_degrees * RADIANS_PER_DEGREE;
    return vec3(cosf(elevation) * sinf(azimuth), sinf(elevation), cosf(elevation) * cosf(azimuth));
}

// ---- the moon

// Cosine of the angle at the moon between sun and eye: 1 = full moon, also of a sky without a time.
static float phase_cosine(const Sky *sky, Vec3 moon)
{
    Vec3 sun = direction_at(sky->sun_elevation, sky->sun_azimuth);
    return sky->time ? clampf(-vec3_dot(sun, moon), -1.0f, 1.0f) : 1.0f;
}

// Share of the full moon's light (Krisciunas and Schaefer 1991).
static float phase_light(float cosine)
{
    float angle = acosf(cosine) / RADIANS_PER_DEGREE, square = angle * angle;
    return powf(10.0f, -0.4f * (0.026f * angle + 4e-9f * square * square));
}

static Sun make_moon(const Sky *sky)
{
    float half = 0.5f * fmaxf(sky->moon_size, 0.01f) * RADIANS_PER_DEGREE, s = sinf(0.5f * half);
    Sun moon = {.direction = direction_at(sky->moon_elevation, sky->moon_azimuth),
                .one_minus_cos = 2.0f * s * s,
                .even = true};
    moon.solid_angle = 2.0f * PI_F * moon.one_minus_cos;
    float reddening = expf(-0.15f / fmaxf(moon.direction.y + 0.05f, 0.02f));
    Vec3 light = vec3(1.0f, 0.75f + 0.25f * reddening, 0.97f * reddening);
    if (moon.direction.y > -0.02f) {
        float share = phase_light(phase_cosine(sky, moon.direction));
        moon.radiance = vec3_scale(light, share * sky->moon * sky->strength / moon.solid_angle);
    }
    return moon;
}

Dome *night_dome(const Sky *sky, Sun *moon, Error *e)
{
    *moon = make_moon(sky);
    Dome *dome = dome_new(COLUMNS, ROWS, true, 0.0f, e);
    if (!dome) {
        return NULL;
    }
    for (int row = 0; row < ROWS; row++) {
        float elevation = dome_elevation(true, ((float)row + 0.5f) / ROWS);
        for (int i = 0; i < COLUMNS; i++) {
            float azimuth = (0.5f - ((float)i + 0.5f) / COLUMNS) * 2.0f * PI_F;
            Vec3 d = vec3(cosf(elevation) * sinf(azimuth), sinf(elevation),
                          cosf(elevation) * cosf(azimuth));
            float ground = elevation < 0.0f ? 0.25f + 0.75f * expf(elevation / 0.03f) : 1.0f;
            dome->entry[row * COLUMNS + i].radiance =
                vec3_scale(glow_at(sky, d), sky->strength * ground);
        }
    }
    dome_prepare(dome);
    return dome;
}

// The part of the moon's face that the sun lights, 1 in its mean over the disc.
static float lit_part(const Sky *sky, const Sun *moon, Vec3 off)
{
    float cosine = phase_cosine(sky, moon->direction);
    if (cosine >= 1.0f) {
        return 1.0f;
    }
    Vec3 aside = vec3_madd(off, -vec3_dot(off, moon->direction), moon->direction);
    float front = sqrtf(fmaxf(0.0f, 1.0f - vec3_dot(aside, aside)));
    Vec3 normal = vec3_madd(aside, -front, moon->direction);
    Vec3 sun = direction_at(sky->sun_elevation, sky->sun_azimuth);
    float lit = smoothstepf(-0.03f, 0.1f, vec3_dot(normal, sun));
    return (lit + EARTHSHINE) / (0.5f * (1.0f + cosine) + EARTHSHINE);
}

float night_moon_face(const Sky *sky, const Sun *moon, Vec3 direction)
{
    float size = sqrtf(2.0f * moon->one_minus_cos);
    Vec3 off = vec3_scale(vec3_sub(direction, moon->direction), 1.0f / size);
    float sea = noise_fractal(vec3_scale(off, 1.7f), 3, 81);
    float small = noise_fractal(vec3_scale(off, 6.0f), 3, 82);
    float maria = 1.0f - 0.45f * smoothstepf(0.0f, 0.25f, sea) + 0.18f * small + 0.2f;
    return maria * lit_part(sky, moon, off);
}
