#include "render/sky/stars.h"

#include "base/random.h"
#include "render/sky/star_catalog.h"

#include <math.h>

enum { STAR_SEED = 0x57a2 }; // the same faint stars in every scene
enum { STREAM_U = 0, STREAM_V = 1, STREAM_MAGNITUDE = 2, STREAM_COLOR = 3 }; // of a star
enum { STAR_CELLS = 64, STARS_A_CELL = 2 };

// Irradiance of a star of magnitude 0, the faintest magnitude, and how many times sigma a star is
// wide.
static const float STAR_LIGHT = 2.4e-5f, FAINTEST = 8.2f, REACH = 3.5f;

// ---- faint stars: cells on the faces of a cube, each with a few

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

// From orange giants (0) to blue-white stars (1); most are near white.
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
    if (magnitude < STAR_CATALOG_FAINTEST) { // those are the catalogue's
        return vec3_splat(0.0f);
    }
    float light = STAR_LIGHT * powf(10.0f, -0.4f * magnitude);
    float density = expf(-0.5f * square) / (2.0f * PI_F * sigma * sigma);
    return vec3_scale(star_color(random_unit(random_key(key, STREAM_COLOR))), light * density);
}

static Vec3 faint_stars(Vec3 d, float sigma)
{
    Vec3 sum = vec3_splat(0.0f);
    CubePlace place = cube_place(d);
    float x = (0.5f * place.u + 0.5f) * STAR_CELLS - 0.5f;
    float y = (0.5f * place.v + 0.5f) * STAR_CELLS - 0.5f;
    for (int k = 0; k < 4 * STARS_A_CELL; k++) {
        int i = (int)floorf(x) + (k & 1), j = (int)floorf(y) + (k >> 1 & 1);
        if (i >= 0 && j >= 0 && i < STAR_CELLS && j < STAR_CELLS) {
            sum = vec3_add(sum, star_light(place.face, i, j, k >> 2, d, sigma));
        }
    }
    return sum;
}

// ---- stars of the catalogue

// The first star at or above a declination, degrees.
static int first_above(float declination)
{
    int low = 0, high = star_catalog_count;
    while (low < high) {
        int middle = (low + high) / 2;
        if ((float)star_catalog[middle].declination * 1e-3f < declination) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

static Vec3 catalog_light(const CatalogStar *star, Vec3 d, float sigma)
{
    float dec = (float)star->declination * 1e-3f * RADIANS_PER_DEGREE;
    float ra = (float)star->right_ascension * 1e-3f * RADIANS_PER_DEGREE;
    Vec3 at = vec3(cosf(dec) * cosf(ra), cosf(dec) * sinf(ra), sinf(dec));
    Vec3 off = vec3_sub(at, d);
    float square = vec3_dot(off, off) / (sigma * sigma);
    if (square > REACH * REACH) {
        return vec3_splat(0.0f);
    }
    float light = STAR_LIGHT * powf(10.0f, -0.004f * (float)star->magnitude);
    float density = expf(-0.5f * square) / (2.0f * PI_F * sigma * sigma);
    float u = ((float)star->temperature - 3500.0f) / 9000.0f;
    return vec3_scale(star_color(clampf(u, 0.0f, 1.0f)), light * density);
}

static Vec3 bright_stars(Vec3 d, float sigma)
{
    float declination = asinf(clampf(d.z, -1.0f, 1.0f)) / RADIANS_PER_DEGREE;
    float reach = REACH * sigma / RADIANS_PER_DEGREE;
    Vec3 sum = vec3_splat(0.0f);
    for (int i = first_above(declination - reach); i < star_catalog_count; i++) {
        if ((float)star_catalog[i].declination * 1e-3f > declination + reach) {
            break;
        }
        sum = vec3_add(sum, catalog_light(&star_catalog[i], d, sigma));
    }
    return sum;
}

// ---- the sky

Vec3 star_sphere(const Sky *sky, Vec3 d)
{
    float latitude = sky->latitude * RADIANS_PER_DEGREE;
    float turn = sky->sidereal * RADIANS_PER_DEGREE;
    float meridian = d.y * cosf(latitude) + d.z * sinf(latitude);
    float pole = d.y * sinf(latitude) - d.z * cosf(latitude);
    return vec3(meridian * cosf(turn) - d.x * sinf(turn), meridian * sinf(turn) + d.x * cosf(turn),
                pole);
}

Vec3 night_stars(const Sky *sky, Vec3 direction, float spread)
{
    if (direction.y <= 0.0f || sky->stars <= 0.0f) {
        return vec3_splat(0.0f);
    }
    float sigma = clampf(0.55f * spread, 1e-4f, 4e-3f);
    Vec3 d = star_sphere(sky, direction);
    Vec3 sum = vec3_add(faint_stars(d, sigma), bright_stars(d, sigma));
    float air = expf(-0.12f / (direction.y + 0.02f));
    return vec3_scale(sum, sky->stars * sky->strength * air);
}
