#include "render/medium/water.h"

#include "base/memory.h"
#include "base/random.h"

#include <stdlib.h>
#include <string.h>

enum { STREAM_WAVES = 0xca57, STREAM_SWELL = 0x53e1, STREAM_WIND = 0x3149 }; // of the scene's seed
enum { STREAM_OCTAVE = 0, STREAM_DIRECTION = 1, STREAM_PHASE = 2 };          // of a wave

enum {
    WAVES = 28,
    SWELLS = 14,
    TILE_WAVES = 8,   // wavelengths along a side of the tile
    TILE_CELLS = 512, // along a side of a layer
    GRID = 2 * TILE_CELLS,
    LAYERS = 20
};

// The deepest layer, in units of the depth of focus.
static const float DEEPEST = 2.5f;

typedef struct Wave {
    float kx, kz, height, phase; // radians per metre, metres, radians
} Wave;

struct Water {
    float level, strength;
    float tile;           // m: the waves repeat
    float deepest;        // m: of the last layer
    float lean_x, lean_z; // m that sunlight moves aside in a metre down
    Wave wave[WAVES];
    Wave swell[SWELLS]; // longer waves, which the tile does not hold
    int swells;
    float *layer; // owned: LAYERS of TILE_CELLS * TILE_CELLS; NULL without a sun
};

// ---- refraction

static float fresnel_share(float cos_air, float cos_water)
{
    const float n = WATER_INDEX;
    float s = (cos_air - n * cos_water) / (cos_air + n * cos_water);
    float p = (n * cos_air - cos_water) / (n * cos_air + cos_water);
    return 1.0f - 0.5f * (s * s + p * p);
}

bool water_enter(Vec3 air, WaterPassage *passage)
{
    const float n = WATER_INDEX;
    if (!(air.y > 1e-4f)) {
        return false;
    }
    float x = air.x / n, z = air.z / n, cosine = sqrtf(1.0f - x * x - z * z);
    *passage =
        (WaterPassage){vec3(x, cosine, z), fresnel_share(air.y, cosine), n * n * cosine / air.y};
    return true;
}

bool water_leave(Vec3 below, Vec3 normal, WaterPassage *passage)
{
    const float n = WATER_INDEX;
    float cos_water = vec3_dot(below, normal);
    float square = 1.0f - n * n * (1.0f - cos_water * cos_water);
    if (!(cos_water > 0.0f) || !(square > 1e-8f)) {
        return false;
    }
    float cos_air = sqrtf(square);
    Vec3 air = vec3_madd(vec3_scale(below, n), cos_air - n * cos_water, normal);
    *passage = (WaterPassage){vec3_normalize(air), fresnel_share(cos_air, cos_water),
                              n * n * cos_water / cos_air};
    return true;
}

// ---- waves

// Wave vectors on the tile's lattice in all directions, most of them across; short waves are lower.
// The mean square curvature is set so that the waves focus at `depth`.
static void make_waves(Water *water, float depth, uint64_t seed)
{
    double curvature = 0.0, steepness = 0.0;
    for (int i = 0; i < WAVES; i++) {
        uint64_t key = random_key(random_key(seed, STREAM_WAVES), (uint64_t)i);
        float octave = random_range(random_key(key, STREAM_OCTAVE), -0.7f, 1.3f);
        float count = TILE_WAVES * exp2f(octave);
        float angle =
            2.0f * PI_F * ((float)i + random_unit(random_key(key, STREAM_DIRECTION))) * 0.618034f;
        float kx = roundf(count * cosf(angle)), kz = roundf(count * sinf(angle));
        kx = kx == 0.0f && kz == 0.0f ? 1.0f : kx;
        Wave wave = {kx * 2.0f * PI_F / water->tile, kz * 2.0f * PI_F / water->tile, 0.0f,
                     2.0f * PI_F * random_unit(random_key(key, STREAM_PHASE))};
        float k = sqrtf(wave.kx * wave.kx + wave.kz * wave.kz);
        wave.height = powf(k * water->tile, -2.6f);
        curvature += 0.5 * (double)(wave.height * k * k * wave.height * k * k);
        steepness += 0.5 * (double)(wave.height * k * wave.height * k);
        water->wave[i] = wave;
    }
    float focus = 1.3f / ((1.0f - 1.0f / WATER_INDEX) * depth);
    float scale = fminf(focus / sqrtf((float)curvature), 0.25f / sqrtf((float)steepness));
    for (int i = 0; i < WAVES; i++) {
        water->wave[i].height *= scale;
    }
}

// Waves of lengths from twice the network's to the swell's, all as steep, within 60 degrees of the
// wind. They are too long to focus sunlight at the depth of the network.
static void make_swell(Water *water, float shortest, float longest, uint64_t seed)
{
    const float steep = 0.045f; // slope of each; root mean square of all: 0.12
    float wind = 2.0f * PI_F * random_unit(random_key(seed, STREAM_WIND));
    water->swells = longest > shortest ? SWELLS : 0;
    for (int i = 0; i < water->swells; i++) {
        uint64_t key = random_key(random_key(seed, STREAM_SWELL), (uint64_t)i);
        float step = random_range(random_key(key, STREAM_OCTAVE), 0.0f, 1.0f);
        float k = 2.0f * PI_F / (shortest * powf(longest / shortest, ((float)i + step) / SWELLS));
        float angle = wind + random_range(random_key(key, STREAM_DIRECTION), -1.05f, 1.05f);
        water->swell[i] = (Wave){k * cosf(angle), k * sinf(angle), steep / k,
                                 2.0f * PI_F * random_unit(random_key(key, STREAM_PHASE))};
    }
}

static void add_slopes(const Wave *wave, int count, Vec3 point, float *x, float *z)
{
    for (int i = 0; i < count; i++) {
        const Wave *w = &wave[i];
        float slope = w->height * cosf(w->kx * point.x + w->kz * point.z + w->phase);
        *x += slope * w->kx;
        *z += slope * w->kz;
    }
}

Vec3 water_normal(const Water *water, Vec3 point)
{
    float x = 0.0f, z = 0.0f;
    add_slopes(water->wave, WAVES, point, &x, &z);
    add_slopes(water->swell, water->swells, point, &x, &z);
    return vec3_normalize(vec3(-x, 1.0f, -z));
}

// Of the waves that the tile repeats.
static Vec3 tile_normal(const Water *water, Vec3 point)
{
    float x = 0.0f, z = 0.0f;
    add_slopes(water->wave, WAVES, point, &x, &z);
    return vec3_normalize(vec3(-x, 1.0f, -z));
}

// ---- the network

// One ray of the sun through a point of the waves: its sideways shift per metre of depth, relative
// to a calm surface, and the light that it carries.
typedef struct SunRay {
    float x, z, aside_x, aside_z, weight;
} SunRay;

static SunRay sun_ray(const Water *water, Vec3 sun, float x, float z)
{
    Vec3 normal = tile_normal(water, vec3(x, 0.0f, z));
    SunRay ray = {x, z, 0.0f, 0.0f, 0.0f};
    float cosine = vec3_dot(sun, normal);
    if (cosine <= 1e-3f) {
        return ray;
    }
    const float n = WATER_INDEX;
    float cos_water = sqrtf(1.0f - (1.0f - cosine * cosine) / (n * n));
    Vec3 up = vec3_madd(vec3_scale(sun, 1.0f / n), cos_water - cosine / n, normal);
    if (up.y > 0.05f) {
        ray.aside_x = -up.x / up.y - water->lean_x;
        ray.aside_z = -up.z / up.y - water->lean_z;
        ray.weight = fresnel_share(cosine, cos_water) * cosine / normal.y;
    }
    return ray;
}

static void drop(float *layer, float x, float z, float weight)
{
    float fx = floorf(x), fz = floorf(z), u = x - fx, v = z - fz;
    const int mask = TILE_CELLS - 1;
    int i = (int)fx & mask, j = (int)fz & mask, i1 = (i + 1) & mask, j1 = (j + 1) & mask;
    layer[j * TILE_CELLS + i] += weight * (1.0f - u) * (1.0f - v);
    layer[j * TILE_CELLS + i1] += weight * u * (1.0f - v);
    layer[j1 * TILE_CELLS + i] += weight * (1.0f - u) * v;
    layer[j1 * TILE_CELLS + i1] += weight * u * v;
}

// Weights 1, 2, 1 in both directions: adds half a cell squared to the variance along each.
static void blur_once(float *layer, float *scratch)
{
    const int mask = TILE_CELLS - 1;
    for (int direction = 0; direction < 2; direction++) {
        for (int j = 0; j < TILE_CELLS; j++) {
            for (int i = 0; i < TILE_CELLS; i++) {
                int before = direction ? ((j - 1) & mask) * TILE_CELLS + i
                                       : j * TILE_CELLS + ((i - 1) & mask);
                int after = direction ? ((j + 1) & mask) * TILE_CELLS + i
                                      : j * TILE_CELLS + ((i + 1) & mask);
                int here = j * TILE_CELLS + i;
                scratch[here] = 0.25f * (layer[before] + layer[after]) + 0.5f * layer[here];
            }
        }
        memcpy(layer, scratch, sizeof *layer * TILE_CELLS * TILE_CELLS);
    }
}

// The disc of the sun blurs by its radius times the depth; the variance is a quarter of that
// squared.
static void finish_layer(const Water *water, float *layer, float *scratch, float depth,
                         float sun_radius)
{
    float radius = sun_radius * depth / water->tile * TILE_CELLS;
    int passes = (int)fminf(1.0f + 0.5f * radius * radius, 200.0f);
    for (int i = 0; i < passes; i++) {
        blur_once(layer, scratch);
    }
    double sum = 0.0;
    for (int i = 0; i < TILE_CELLS * TILE_CELLS; i++) {
        sum += (double)layer[i];
    }
    float scale = sum > 0.0 ? (float)(TILE_CELLS * TILE_CELLS / sum) : 0.0f;
    for (int i = 0; i < TILE_CELLS * TILE_CELLS; i++) {
        layer[i] *= scale;
    }
}

static float layer_depth(const Water *water, int index)
{
    return water->deepest * (float)index / (LAYERS - 1);
}

static bool cast_network(Water *water, Vec3 sun, float sun_radius, const Run *run, Error *e)
{
    int64_t cells = TILE_CELLS * TILE_CELLS;
    water->layer = memory_alloc_zero(LAYERS * cells, sizeof *water->layer, e);
    SunRay *ray = memory_alloc(GRID * GRID, sizeof *ray, e);
    float *scratch = memory_alloc(LAYERS * cells, sizeof *scratch, e);
    bool ready = water->layer && ray && scratch;
    if (ready) {
#pragma omp parallel for num_threads(run->threads)
        for (int j = 0; j < GRID; j++) {
            for (int i = 0; i < GRID; i++) {
                ray[j * GRID + i] = sun_ray(water, sun, (float)i / GRID * water->tile,
                                            (float)j / GRID * water->tile);
            }
        }
#pragma omp parallel for schedule(dynamic) num_threads(run->threads)
        for (int k = 0; k < LAYERS; k++) {
            float depth = layer_depth(water, k), cell = TILE_CELLS / water->tile;
            float *layer = water->layer + k * cells;
            for (int i = 0; i < GRID * GRID; i++) {
                const SunRay *r = &ray[i];
                drop(layer, (r->x + r->aside_x * depth) * cell, (r->z + r->aside_z * depth) * cell,
                     r->weight);
            }
            finish_layer(water, layer, scratch + k * cells, depth, sun_radius);
        }
    }
    free(ray);
    free(scratch);
    return ready;
}

Water *water_new(const Medium *medium, Vec3 sun, float sun_radius, float depth, uint64_t seed,
                 const Run *run, Error *e)
{
    Water *water = memory_alloc_zero(1, sizeof *water, e);
    if (!water) {
        return NULL;
    }
    float wavelength = medium->wavelength > 0.0f ? medium->wavelength : 0.3f * depth;
    water->level = medium->height;
    water->strength = medium->caustics;
    water->tile = wavelength * TILE_WAVES;
    water->deepest = DEEPEST * depth;
    make_waves(water, depth, seed);
    make_swell(water, 2.0f * wavelength, medium->swell, seed);
    WaterPassage passage;
    if (medium->caustics > 0.0f && water_enter(sun, &passage)) {
        water->lean_x = -passage.direction.x / passage.direction.y;
        water->lean_z = -passage.direction.z / passage.direction.y;
        if (!cast_network(water, sun, sun_radius, run, e)) {
            water_free(water);
            return NULL;
        }
    }
    return water;
}

void water_free(Water *water)
{
    if (water) {
        free(water->layer);
        free(water);
    }
}

bool water_covers(const Water *water, Vec3 point)
{
    return water && point.y < water->level;
}

static float layer_at(const float *layer, float x, float z)
{
    float fx = floorf(x), fz = floorf(z), u = x - fx, v = z - fz;
    const int mask = TILE_CELLS - 1;
    int i = (int)fx & mask, j = (int)fz & mask, i1 = (i + 1) & mask, j1 = (j + 1) & mask;
    return lerpf(lerpf(layer[j * TILE_CELLS + i], layer[j * TILE_CELLS + i1], u),
                 lerpf(layer[j1 * TILE_CELLS + i], layer[j1 * TILE_CELLS + i1], u), v);
}

float water_caustic(const Water *water, Vec3 point)
{
    if (!water->layer) {
        return 1.0f;
    }
    float depth = fmaxf(water->level - point.y, 0.0f), cell = TILE_CELLS / water->tile;
    float y = fminf(depth / water->deepest, 1.0f) * (LAYERS - 1);
    int k = (int)fminf(y, LAYERS - 2);
    float x = (point.x - water->lean_x * depth) * cell,
          z = (point.z - water->lean_z * depth) * cell;
    const float *layer = water->layer + (size_t)k * TILE_CELLS * TILE_CELLS;
    float light =
        lerpf(layer_at(layer, x, z), layer_at(layer + TILE_CELLS * TILE_CELLS, x, z), y - (float)k);
    return lerpf(1.0f, light, water->strength);
}
