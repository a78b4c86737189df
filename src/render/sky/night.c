#include "render/sky/night.h"

#include "base/random.h"
#include "render/material/pattern_noise.h"

#include <stddef.h>

enum { STAR_SEED = 0x57a2 }; // the same stars in every scene
enum { STREAM_U = 0, STREAM_V = 1, STREAM_MAGNITUDE = 2, STREAM_COLOR = 3 }; // of a star

enum { COLUMNS = 384, ROWS = 256, STAR_CELLS = 64, STARS_A_CELL = 2 };

// Irradiance of a star of magnitude 0, and the faintest magnitude.
static const float STAR_LIGHT = 2.4e-5f, FAINTEST = 8.2f;

// ---- what glows

// The plane of the galaxy, as on a summer evening.
static const Vec3 GALAXY = {0.62f, 0.42f, -0.66f};

static Vec3 milky_way(Vec3 d)
{
    float off = vec3_dot(d, GALAXY) / vec3_length(GALAXY);
    float cloud = noise_fractal(vec3_scale(d, 3.0f), 5, 71);
    float rift = noise_fractal(vec3_scale(d, 7.0f), 4, 72);
    float bent = off + 0.05f * cloud;
    float band = expf(-bent * bent / 0.030f) * clampf(0.75f + 0.7f * cloud, 0.0f, 2.0f);
    float dark = expf(-off * off / 0.003f) * clampf(0.5f + rift, 0.0f, 1.0f);
    return vec3_scale(vec3(0.0055f, 0.0053f, 0.0060f), band * (1.0f - 0.7f * dark));
}

// Airglow brightens toward the horizon, where the layer is seen edge-on, until extinction dims it.
static Vec3 glow_at(const Sky *sky, Vec3 d)
{
    float rise = fmaxf(d.y, 0.0f);
    float layer = 1.0f / sqrtf(1.0f - 0.96f * (1.0f - rise * rise));
    float clear = expf(-0.12f / (rise + 0.06f));
    Vec3 light = vec3_scale(vec3(0.0022f, 0.0040f, 0.0062f), 0.5f + 0.5f * layer * clear);
    light = vec3_madd(light, clear, milky_way(d));
    light = vec3_madd(light, 0.06f * sky->moon * (0.4f + 0.6f * expf(-3.0f * rise)),
                      vec3(0.30f, 0.55f, 1.0f));
    float town = noise_fractal(vec3(3.0f * d.x, 0.0f, 3.0f * d.z), 3, 73);
    float city = sky->city_glow * expf(-rise / 0.09f) * clampf(0.6f + 0.8f * town, 0.1f, 2.0f);
    return vec3_madd(light, city, vec3(0.055f, 0.032f, 0.015f));
}

static Sun make_moon(const Sky *sky)
{
    float elevation = sky->moon_elevation * RADIANS_PER_DEGREE;
    float azimuth = sky->moon_azimuth * RADIANS_PER_DEGREE;
    float half = 0.5f * fmaxf(sky->moon_size, 0.01f) * RADIANS_PER_DEGREE, s = sinf(0.5f * half);
    Sun moon = {.direction = vec3(cosf(elevation) * sinf(azimuth), sinf(elevation),
                                  cosf(elevation) * cosf(azimuth)),
                .one_minus_cos = 2.0f * s * s,
                .even = true};
    moon.solid_angle = 2.0f * PI_F * moon.one_minus_cos;
    float reddening = expf(-0.15f / fmaxf(moon.direction.y + 0.05f, 0.02f));
    Vec3 light = vec3(1.0f, 0.75f + 0.25f * reddening, 0.97f * reddening);
    if (moon.direction.y > -0.02f) {
        moon.radiance = vec3_scale(light, sky->moon * sky->strength / moon.solid_angle);
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

// ---- stars: cells on the faces of a cube, each with a few

typedef struct CubePlace {
    int face;
    float u, v; // -1..1
} CubePlace;

static CubePlace cube_place(Vec3 d)
{
    float x = fabsf(d.x), y = fabsf(d.y), z = fabsf(d.z);
    if (x >= y && x >= z) {
        return (CubePlace){d.x > 0.0f ? 0 : 1, d.y / x, d.z / x};
    }
    if (y >= z) {
        return (CubePlace){d.y > 0.0f ? 2 : 3, d.x / y, d.z / y};
    }
    return (CubePlace){d.z > 0.0f ? 4 : 5, d.x / z, d.y / z};
}

static Vec3 cube_direction(CubePlace p)
{
    float side = p.face & 1 ? -1.0f : 1.0f;
    Vec3 d = p.face < 2   ? vec3(side, p.u, p.v)
             : p.face < 4 ? vec3(p.u, side, p.v)
                          : vec3(p.u, p.v, side);
    return vec3_normalize(d);
}

// From orange giants to blue-white stars; most are near white.
static Vec3 star_color(float u)
{
    const Vec3 warm = {1.25f, 0.95f, 0.65f}, cold = {0.80f, 0.97f, 1.30f};
    return vec3_lerp(warm, cold, smoothstepf(0.0f, 1.0f, u));
}

// A star of cell (i, j) smoothed over sigma. There are ten times as many stars for each two
// magnitudes.
static Vec3 star_light(int face, int i, int j, int number, Vec3 direction, float sigma)
{
    uint64_t key = random_key(
        random_key(random_key(STAR_SEED, (uint64_t)face), (uint64_t)j * STAR_CELLS + (uint64_t)i),
        (uint64_t)number);
    float u = ((float)i + random_unit(random_key(key, STREAM_U))) * (2.0f / STAR_CELLS) - 1.0f;
    float v = ((float)j + random_unit(random_key(key, STREAM_V))) * (2.0f / STAR_CELLS) - 1.0f;
    Vec3 off = vec3_sub(cube_direction((CubePlace){face, u, v}), direction);
    float square = vec3_dot(off, off) / (sigma * sigma);
    if (square > 12.0f) {
        return vec3_splat(0.0f);
    }
    float magnitude =
        FAINTEST + 2.0f * log10f(fmaxf(random_unit(random_key(key, STREAM_MAGNITUDE)), 1e-6f));
    float light = STAR_LIGHT * powf(10.0f, -0.4f * fmaxf(magnitude, -1.0f));
    float density = expf(-0.5f * square) / (2.0f * PI_F * sigma * sigma);
    return vec3_scale(star_color(random_unit(random_key(key, STREAM_COLOR))), light * density);
}

Vec3 night_stars(const Sky *sky, Vec3 direction, float spread)
{
    Vec3 sum = vec3_splat(0.0f);
    if (direction.y <= 0.0f || sky->stars <= 0.0f) {
        return sum;
    }
    CubePlace place = cube_place(direction);
    float sigma = clampf(0.55f * spread, 1e-4f, 4e-3f);
    float x = (0.5f * place.u + 0.5f) * STAR_CELLS - 0.5f;
    float y = (0.5f * place.v + 0.5f) * STAR_CELLS - 0.5f;
    for (int k = 0; k < 4 * STARS_A_CELL; k++) {
        int i = (int)floorf(x) + (k & 1), j = (int)floorf(y) + (k >> 1 & 1);
        if (i >= 0 && j >= 0 && i < STAR_CELLS && j < STAR_CELLS) {
            sum = vec3_add(sum, star_light(place.face, i, j, k >> 2, direction, sigma));
        }
    }
    float air = expf(-0.12f / (direction.y + 0.02f));
    return vec3_scale(sum, sky->stars * sky->strength * air);
}

float night_moon_face(const Sun *moon, Vec3 direction)
{
    float size = sqrtf(2.0f * moon->one_minus_cos);
    Vec3 off = vec3_scale(vec3_sub(direction, moon->direction), 1.0f / size);
    float sea = noise_fractal(vec3_scale(off, 1.7f), 3, 81);
    float small = noise_fractal(vec3_scale(off, 6.0f), 3, 82);
    return 1.0f - 0.45f * smoothstepf(0.0f, 0.25f, sea) + 0.18f * small + 0.2f;
}
