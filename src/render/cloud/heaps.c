#include "render/cloud/heaps.h"

#include "base/memory.h"
#include "base/random.h"

#include <stdlib.h>

typedef struct Heap {
    Vec3 middle;         // at the base
    float width, height; // m
    float length;        // of the ellipse's axis along the wind, and 1 / that across it
    float age;           // 0 = growing, 1 = dissolved
    float wear;          // of its foot and flanks by dry air
    float frail;         // the same of all of it: small heaps have no core that it does not reach
    float sine, cosine;  // of the wind's azimuth
} Heap;

// Many small heaps, few large ones: their number falls off like width^-1.9 (Cahalan and Joseph
// 1989; Neggers, Jonker and Siebesma 2003), here from 0.08 to 1.6.
float heaps_width(float rank)
{
    const float exponent = 0.9f, least = 0.08f, most = 1.6f;
    float a = powf(least, -exponent), b = powf(most, -exponent);
    return powf(a + rank * (b - a), -1.0f / exponent);
}

// A place above the base, in shares of the heap's axes from its middle.
static Vec3 place_in(const Heap *h, float along, float aside, float y)
{
    along *= h->width * h->length;
    aside *= h->width / h->length;
    return vec3(h->middle.x + along * h->sine + aside * h->cosine, h->middle.y + y,
                h->middle.z + along * h->cosine - aside * h->sine);
}

// The towers of a heap, tallest inside; each is a rising bubble of air of its own age.
static bool add_towers(Puffs *p, const Heap *h, uint64_t key, Error *e)
{
    int towers = 3 + (int)(6.0f * random_unit(random_key(key, 0)));
    for (uint64_t i = 1; i <= (uint64_t)towers; i++) {
        uint64_t own = random_key(key, i);
        float angle = random_range(random_key(own, 0), 0.0f, 2.0f * PI_F);
        float off = 0.36f * sqrtf(random_unit(random_key(own, 1)));
        float dome = 1.0f - 5.0f * off * off;
        float young = random_unit(random_key(own, 2));
        float old = clampf(h->age + 0.5f * (0.5f - young), 0.0f, 1.0f);
        float lean = random_range(random_key(own, 5), 0.05f, 0.4f);
        Column tower = {.foot = place_in(h, off * cosf(angle), off * sinf(angle), 0.0f),
                        .radius = h->width * random_range(random_key(own, 3), 0.12f, 0.22f),
                        .height = h->height * dome * lerpf(0.45f, 1.0f, young),
                        .taper = 0.35f,
                        .lean_x = lean * h->sine,
                        .lean_z = lean * h->cosine,
                        .softness = puffs_worn(clampf(1.6f * old - 0.5f, 0.0f, 0.9f), h->frail),
                        .wear = h->wear};
        if (!puffs_add_column(p, &tower, random_key(own, 4), e)) {
            return false;
        }
    }
    return true;
}

// Flat balls on the condensation level, on which the towers stand.
static bool add_foot(Puffs *p, const Heap *h, uint64_t key, Error *e)
{
    enum { BALLS = 9 };
    for (uint64_t i = 0; i < BALLS; i++) {
        uint64_t own = random_key(key, i);
        float angle = random_range(random_key(own, 0), 0.0f, 2.0f * PI_F);
        float off = 0.42f * sqrtf(random_unit(random_key(own, 1)));
        float radius = h->width * random_range(random_key(own, 2), 0.13f, 0.26f);
        Puff ball = {.center = place_in(h, off * cosf(angle), off * sinf(angle), 0.0f),
                     .radius = radius,
                     .flatness = random_range(random_key(own, 3), 1.6f, 3.0f),
                     .softness = random_range(random_key(own, 4), 0.1f, 0.5f)};
        ball.softness = puffs_worn(ball.softness, 0.6f * h->wear);
        if (!puffs_add(p, ball, e)) {
            return false;
        }
    }
    return true;
}

// Shreds: what is torn off beside a heap and downwind, or what is left of an old one.
static bool add_shreds(Puffs *p, const Heap *h, bool around, uint64_t key, Error *e)
{
    int count = 4 + (int)(6.0f * random_unit(random_key(key, 0)));
    for (uint64_t i = 1; i <= (uint64_t)count; i++) {
        uint64_t own = random_key(key, i);
        float angle = random_range(random_key(own, 0), 0.0f, 2.0f * PI_F);
        float off = around ? random_range(random_key(own, 1), 0.38f, 0.62f)
                           : 0.4f * sqrtf(random_unit(random_key(own, 1)));
        float along = off * cosf(angle) + (around ? 0.12f : 0.0f);
        float y = h->height * random_range(random_key(own, 2), 0.05f, around ? 0.6f : 0.5f);
        float least = around ? 0.03f : 0.1f, most = around ? 0.1f : 0.24f;
        Puff shred = {.center = place_in(h, along, off * sinf(angle), y),
                      .radius = h->width * random_range(random_key(own, 3), least, most),
                      .flatness = random_range(random_key(own, 4), 1.1f, 2.0f),
                      .softness = random_range(random_key(own, 5), 0.7f, 1.0f)};
        if (!puffs_add(p, shred, e)) {
            return false;
        }
    }
    return true;
}

// ---- where they gather ----

enum { STREETS = 3, CLUSTERS = 4 };

// Slow waves over the square, which fit its period: streets along the wind, clusters anywhere.
static float gathering(float x, float z, float period, float wind, uint64_t key)
{
    float sum = 0.0f;
    for (uint64_t i = 0; i < STREETS + CLUSTERS; i++) {
        uint64_t own = random_key(key, i);
        bool street = i < STREETS;
        float turn = random_range(random_key(own, 0), -1.0f, 1.0f);
        float angle = street ? wind + 0.3f * turn : PI_F * turn; // across the wave
        float count = random_range(random_key(own, 1), street ? 4.0f : 1.0f, street ? 7.0f : 3.5f);
        float kx = rintf(count * cosf(angle)), kz = rintf(-count * sinf(angle));
        float phase = random_range(random_key(own, 2), 0.0f, 2.0f * PI_F);
        sum += cosf(2.0f * PI_F * (kx * x + kz * z) / period + phase);
    }
    return clampf(0.4f + 0.27f * sum, 0.03f, 1.0f);
}

// ---- the share of the land below them ----

enum { SHADE_SIDE = 256 };

typedef struct Shade {
    bool dark[SHADE_SIDE][SHADE_SIDE]; // z, x
    int count;
} Shade;

static void darken(Shade *shade, const Puff *puff, float period)
{
    float seen = puff->radius * (1.0f - 0.3f * puff->softness); // wisps hide little
    float scale = SHADE_SIDE / period, r = seen * scale;
    float cx = puff->center.x * scale, cz = puff->center.z * scale;
    for (int z = (int)ceilf(cz - r); z <= (int)floorf(cz + r); z++) {
        float dz = (float)z - cz, half = sqrtf(fmaxf(r * r - dz * dz, 0.0f));
        for (int x = (int)ceilf(cx - half); x <= (int)floorf(cx + half); x++) {
            bool *cell = &shade->dark[z & (SHADE_SIDE - 1)][x & (SHADE_SIDE - 1)];
            shade->count += !*cell;
            *cell = true;
        }
    }
}

// ---- population ----

static Heap draw_heap(const Cloud *cloud, Vec3 middle, uint64_t key)
{
    float wind = cloud->wind * RADIANS_PER_DEGREE;
    float share = heaps_width(random_unit(random_key(key, 0)));
    Heap h = {.middle = middle,
              .width = cloud->size * share,
              .length = random_range(random_key(key, 1), 1.0f, 1.4f),
              .age = random_unit(random_key(key, 2)),
              .wear = fminf(1.3f * cloud->softness, 1.0f),
              .frail = 1.2f * cloud->softness * clampf(1.0f - share / 0.45f, 0.0f, 1.0f),
              .sine = sinf(wind),
              .cosine = cosf(wind)};
    float height = cloud->thickness * fminf(share, 1.0f) *
                   random_range(random_key(key, 3), 0.6f, 1.0f) * (1.0f - 0.35f * h.age);
    float slender = clampf(1.3f * cloud->thickness / cloud->size, 0.7f, 2.5f);
    h.height = fminf(height, slender * h.width);
    return h;
}

static bool add_heap(Puffs *p, const Heap *h, uint64_t key, Error *e)
{
    bool dissolves = h->age > 0.75f;
    if (dissolves) {
        return add_shreds(p, h, false, random_key(key, 0), e);
    }
    return add_towers(p, h, random_key(key, 1), e) && add_foot(p, h, random_key(key, 2), e) &&
           add_shreds(p, h, true, random_key(key, 3), e);
}

bool heaps_grow(Puffs *p, const Cloud *cloud, float period, uint64_t key, Error *e)
{
    enum { MOST_TRIALS = 60000 };
    Shade *shade = memory_alloc_zero(1, sizeof *shade, e);
    bool done = shade;
    float wanted = fminf(cloud->cover, 0.98f) * SHADE_SIDE * SHADE_SIDE;
    float wind = cloud->wind * RADIANS_PER_DEGREE;
    for (uint64_t i = 1; done && (float)shade->count < wanted && i < MOST_TRIALS; i++) {
        uint64_t own = random_key(key, i);
        float x = period * random_unit(random_key(own, 0));
        float z = period * random_unit(random_key(own, 1));
        if (random_unit(random_key(own, 2)) > gathering(x, z, period, wind, random_key(key, 0))) {
            continue;
        }
        int64_t first = p->count;
        Heap h = draw_heap(cloud, vec3(x, cloud->base, z), random_key(own, 3));
        done = add_heap(p, &h, random_key(own, 4), e);
        for (int64_t k = first; k < p->count; k++) {
            darken(shade, &p->puff[k], period);
        }
    }
    free(shade);
    return done;
}
