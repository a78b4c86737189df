// Columns, needles and what caps them: a hexagonal prism whose length outgrows its width as the
// weather tells, with funnels at its ends where there was much vapour.
#include "objects/snow_crystal/column.h"
#include "base/exact_math.h"
#include "base/noise.h"
#include "base/random.h"

#include <stddef.h>

enum { STEPS = 256 };          // of its growth
enum { TERRACES = 6 };         // of a funnel
enum { STREAM_FACES = 11 };    // of the seed
#define FROZEN (1.0f / 300.0f) // size of the frozen droplet that it grew from, in the final one
#define WET 0.15f              // g/m^3: needles at -6 degrees

// Growth of the axis over that of the width in much vapour, near the inherent growth ratio of Chen
// and Lamb (1994): log(length) grows so many times as fast as log(width).
static float inherent_ratio(float temperature)
{
    static const float AT[][2] = {{-40, 1.5f}, {-30, 1.4f}, {-25, 1.2f}, {-22, 1},
                                  {-10, 1},    {-9, 1.2f},  {-8, 1.5f},  {-7, 1.9f},
                                  {-6, 2.2f},  {-5, 1.8f},  {-4, 1.2f},  {-3.5f, 1}};
    enum { COUNT = sizeof AT / sizeof AT[0] };
    if (temperature <= AT[0][0]) {
        return AT[0][1];
    }
    for (int i = 1; i < COUNT; i++) {
        if (temperature <= AT[i][0]) {
            float t = (temperature - AT[i - 1][0]) / (AT[i][0] - AT[i - 1][0]);
            return lerpf(AT[i - 1][1], AT[i][1], t);
        }
    }
    return AT[COUNT - 1][1];
}

float snow_growth_ratio(const SnowWeather *weather)
{
    float wet = clampf(weather->supersaturation / WET, 0.0f, 1.0f);
    return 1.0f + (inherent_ratio(weather->temperature) - 1.0f) * wet;
}

// How far the middle of an end lags behind its rim, 0 .. 1: facets go hollow in much vapour.
static float hollow_in(const SnowWeather *weather)
{
    return smoothstepf(0.03f, 0.14f, weather->supersaturation);
}

SnowColumn snow_column(const SnowCrystalParams *params)
{
    SnowColumn column = {.until = snow_column_until(params)};
    if (!(column.until > 0.0f)) {
        return column;
    }
    // the width by d log(width) = d log(length) / ratio, from the droplet on
    double step = exact_log((double)(column.until / FROZEN)) / STEPS, width = 0.0;
    step = step > 0.0 ? step : 0.0;
    float hollow = 0.0f;
    for (int i = 0; i < STEPS; i++) {
        float at = FROZEN * (float)exact_exp(step * ((double)i + 0.5));
        SnowWeather weather = snow_weather_at(params, at < column.until ? at : column.until);
        width += step / (double)snow_growth_ratio(&weather);
        weather = snow_weather_at(params, column.until * ((float)i + 0.5f) / STEPS);
        hollow += hollow_in(&weather) / STEPS;
    }
    column.length = params->size * column.until;
    column.width = params->size * FROZEN * (float)exact_exp(width);
    column.width = column.width < column.length ? column.width : column.length;
    column.hollow = hollow;
    return column;
}

// Distance of the six faces from the axis over that of a regular prism's: more or less even.
typedef struct Section {
    Vec2 corner[6]; // of the prism of unit width
} Section;

// Corners of six faces that stand at 60 degrees, moved in or out.
static Section make_section(float noise, uint64_t seed)
{
    Section section;
    float out[6];
    Vec2 normal[6];
    for (int k = 0; k < 6; k++) {
        uint64_t key = random_key(random_key(seed, STREAM_FACES), (uint64_t)k);
        out[k] = 0.4330127f * (1.0f + noise * random_range(key, -0.6f, 0.6f));
        float sine, cosine;
        exact_sincos(((float)k + 0.5f) * PI_F / 3.0f, &sine, &cosine);
        normal[k] = (Vec2){cosine, -sine};
    }
    for (int k = 0; k < 6; k++) { // where faces k - 1 and k meet
        Vec2 a = normal[(k + 5) % 6], b = normal[k];
        float d = out[(k + 5) % 6], f = out[k], cross = a.x * b.y - a.y * b.x;
        section.corner[k] = (Vec2){(d * b.y - f * a.y) / cross, (f * a.x - d * b.x) / cross};
    }
    return section;
}

// A ring of the surface: at a height, of a width; without width it is one vertex.
typedef struct Ring {
    float height, width; // m
} Ring;

enum { MOST_RINGS = 4 * TERRACES + 12 };

typedef struct Rings {
    Ring ring[MOST_RINGS];
    int count;
} Rings;

static void add_ring(Rings *rings, float height, float width)
{
    rings->ring[rings->count++] = (Ring){height, width};
}

// One end, from the outside in: the edge, the rim, and down the funnel in terraces, whose widths
// vary with the gusts at the time when the end was there. sign: 1 = the upper end.
static void add_end(Rings *rings, const SnowCrystalParams *params, const SnowColumn *column,
                    float sign, uint64_t seed)
{
    float half = 0.5f * column->length, width = column->width;
    float bevel = 0.05f * params->relief * (width < half ? width : half);
    if (bevel > 0.0f) {
        add_ring(rings, sign * (half - 0.5f * bevel), width);
        add_ring(rings, sign * half, width - bevel);
    } else {
        add_ring(rings, sign * half, width);
    }
    float mouth = (width - bevel) * (0.5f + 0.4f * column->hollow);
    float depth = 0.92f * half * column->hollow;
    if (!(depth > 0.01f * half)) {
        add_ring(rings, sign * half, 0.0f);
        return;
    }
    for (int i = 0; i < TERRACES; i++) { // each a wall that narrows, then a step
        float t = (float)i / TERRACES, next = (float)(i + 1) / TERRACES;
        float change = 0.25f * params->gusts * snow_gust(1.0f - 0.8f * t, seed);
        float here = mouth * (1.0f - t) * (1.0f - 0.5f * t) * (1.0f + (i > 0 ? change : 0.0f));
        float limit = rings->ring[rings->count - 1].width;
        here = here < 0.96f * limit ? here : 0.96f * limit;
        add_ring(rings, sign * (half - depth * t), here);
        add_ring(rings, sign * (half - depth * lerpf(t, next, 0.96f)), 0.93f * here);
    }
    add_ring(rings, sign * (half - depth), 0.0f);
}

// From the middle of the lower end over the sides to that of the upper one.
static Rings make_rings(const SnowCrystalParams *params, const SnowColumn *column, uint64_t seed)
{
    Rings rings = {0}, below = {0};
    add_end(&below, params, column, -1.0f, seed);
    for (int i = below.count - 1; i >= 0; i--) {
        rings.ring[rings.count++] = below.ring[i];
    }
    add_end(&rings, params, column, 1.0f, seed);
    return rings;
}

static void place_rings(const Rings *rings, const Section *section, Mesh *mesh)
{
    Vec3 *p = mesh->position;
    for (int i = 0; i < rings->count; i++) {
        const Ring *ring = &rings->ring[i];
        if (i == 0 || i == rings->count - 1) {
            *p++ = vec3(0.0f, ring->height, 0.0f);
            continue;
        }
        for (int k = 0; k < 6; k++) {
            *p++ = vec3(section->corner[k].x * ring->width, ring->height,
                        section->corner[k].y * ring->width);
        }
    }
}

static void join_rings(const Rings *rings, Mesh *mesh)
{
    uint32_t *face = mesh->index, last = (uint32_t)mesh->vertex_count - 1;
    for (int i = 1; i < rings->count - 2; i++) {
        for (uint32_t k = 0; k < 6; k++) {
            uint32_t first = 1 + 6 * (uint32_t)(i - 1), next = (k + 1) % 6;
            uint32_t a = first + k, b = first + next, c = b + 6, d = a + 6;
            const uint32_t corner[6] = {a, b, c, a, c, d};
            for (int j = 0; j < 6; j++) {
                *face++ = corner[j];
            }
        }
    }
    for (uint32_t k = 0; k < 6; k++) {
        uint32_t next = (k + 1) % 6;
        const uint32_t corner[6] = {0, 1 + next, 1 + k, last, last - 6 + k, last - 6 + next};
        for (int j = 0; j < 6; j++) {
            *face++ = corner[j];
        }
    }
}

Mesh *snow_column_mesh(const SnowCrystalParams *params, const SnowColumn *column, uint64_t seed,
                       Error *e)
{
    Rings rings = make_rings(params, column, seed);
    Section section = make_section(params->noise, seed);
    int64_t whole = rings.count - 2; // rings of six corners
    Mesh *mesh = mesh_new(3, 6 * whole + 2, 12 * (whole - 1) + 12, 0, e);
    if (mesh) {
        place_rings(&rings, &section, mesh);
        join_rings(&rings, mesh);
    }
    return mesh;
}
