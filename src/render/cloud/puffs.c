#include "render/cloud/puffs.h"

#include "base/memory.h"
#include "base/random.h"

#include <stdlib.h>

enum { FLANK_LEVELS = 3 };

typedef struct Grower {
    Puffs *puffs;
    float floor; // m: altitude of the base
    float smallest;
    Error *e;
} Grower;

static bool add(Grower *g, Vec3 center, float radius, float flatness)
{
    Puffs *p = g->puffs;
    if (!memory_reserve(&p->puff, &p->capacity, p->count + 1, sizeof *p->puff, g->e)) {
        return false;
    }
    p->puff[p->count++] = (Puff){center, radius, flatness};
    return true;
}

// A ball and the smaller ones on its flanks, more of them above than below: what rises bulges.
static bool add_bulging(Grower *g, Vec3 center, float radius, int levels, uint64_t key)
{
    if (!add(g, center, radius, 1.0f)) {
        return false;
    }
    if (levels == 0 || 0.4f * radius < g->smallest) {
        return true;
    }
    enum { CHILDREN = 7 };
    for (uint64_t i = 0; i < CHILDREN; i++) {
        uint64_t own = random_key(key, i);
        Vec3 d = random_direction(random_key(own, 0));
        d = vec3_normalize(vec3(d.x, d.y + 0.35f, d.z));
        float r = radius * random_range(random_key(own, 1), 0.36f, 0.58f);
        Vec3 at = vec3_madd(center, radius * random_range(random_key(own, 2), 0.72f, 0.95f), d);
        if (at.y > g->floor && !add_bulging(g, at, r, levels - 1, random_key(own, 3))) {
            return false;
        }
    }
    return true;
}

// Balls up a column whose top is at `height` above the base, narrower toward the top.
static bool add_column(Grower *g, Vec3 foot, float radius, float height, uint64_t key)
{
    float y = 0.35f * radius;
    for (uint64_t i = 0; i == 0 || y < height - 0.5f * radius; i++) {
        uint64_t own = random_key(key, i);
        float share = clampf(y / fmaxf(height, 1.0f), 0.0f, 1.0f);
        float r = radius * (1.0f - 0.35f * share) * random_range(random_key(own, 0), 0.85f, 1.15f);
        Vec3 off = vec3_scale(random_direction(random_key(own, 1)), 0.25f * radius);
        Vec3 at = vec3(foot.x + off.x, foot.y + y, foot.z + off.z);
        if (!add_bulging(g, at, r, FLANK_LEVELS, random_key(own, 2))) {
            return false;
        }
        y += 0.75f * r;
    }
    return true;
}

// One heap of this width: columns within an ellipse along the wind, tallest inside.
static bool add_heap(Grower *g, Vec3 middle, float width, float height, float wind, uint64_t key)
{
    float length = random_range(random_key(key, 0), 1.0f, 1.7f);
    float sine = sinf(wind), cosine = cosf(wind);
    int columns = 4 + (int)(6.0f * random_unit(random_key(key, 1)));
    for (uint64_t i = 0; i < (uint64_t)columns; i++) {
        uint64_t own = random_key(key, 2 + i);
        float angle = random_range(random_key(own, 0), 0.0f, 2.0f * PI_F);
        float off = 0.36f * sqrtf(random_unit(random_key(own, 1)));
        float along = off * cosf(angle) * width * length,
              aside = off * sinf(angle) * width / length;
        Vec3 foot = vec3(middle.x + along * sine + aside * cosine, middle.y,
                         middle.z + along * cosine - aside * sine);
        float dome = 1.0f - 5.0f * off * off;
        float top = height * dome * random_range(random_key(own, 2), 0.55f, 1.0f);
        float radius = width * random_range(random_key(own, 3), 0.13f, 0.22f);
        if (!add_column(g, foot, radius, top, random_key(own, 4))) {
            return false;
        }
    }
    return true;
}

// Heaps gather in streets and clusters: slow waves over the square, which fit its period.
static float gathering(float x, float z, float period, uint64_t key)
{
    float sum = 0.0f;
    for (uint64_t i = 0; i < 6; i++) {
        uint64_t own = random_key(key, i);
        float kx = floorf(random_range(random_key(own, 0), -3.0f, 4.0f));
        float kz = floorf(random_range(random_key(own, 1), -3.0f, 4.0f));
        float phase = random_range(random_key(own, 2), 0.0f, 2.0f * PI_F);
        sum += cosf(2.0f * PI_F * (kx * x + kz * z) / period + phase);
    }
    return clampf(0.5f + 0.25f * sum, 0.0f, 1.0f);
}

// ---- the share of the land below balls ----

enum { SHADE_SIDE = 256 };

typedef struct Shade {
    bool dark[SHADE_SIDE][SHADE_SIDE]; // z, x
    int count;
} Shade;

static void darken(Shade *shade, const Puff *puff, float period)
{
    float scale = SHADE_SIDE / period, r = puff->radius * scale;
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

// One heap at a place drawn by key, if heaps gather there.
static bool add_drawn_heap(Grower *g, const Cloud *cloud, float period, uint64_t gather,
                           uint64_t key)
{
    float x = period * random_unit(random_key(key, 0));
    float z = period * random_unit(random_key(key, 1));
    if (random_unit(random_key(key, 2)) > gathering(x, z, period, gather)) {
        return true;
    }
    // Many small heaps, few large ones: widths fall off like a power (Cahalan and Joseph 1989).
    float rank = random_unit(random_key(key, 3));
    float width = cloud->size * fminf(0.3f / sqrtf(1.02f - rank), 1.6f);
    float share = fminf(width / cloud->size, 1.0f);
    float height = cloud->thickness * share * random_range(random_key(key, 4), 0.6f, 1.0f);
    return add_heap(g, vec3(x, cloud->base, z), width, fminf(height, 1.4f * width),
                    cloud->wind * RADIANS_PER_DEGREE, random_key(key, 5));
}

bool puffs_grow_cumulus(Puffs *puffs, const Cloud *cloud, float period, float smallest,
                        uint64_t key, Error *e)
{
    enum { MOST_TRIALS = 20000 };
    Shade *shade = memory_alloc_zero(1, sizeof *shade, e);
    Grower g = {puffs, cloud->base, smallest, e};
    bool done = shade;
    float wanted = fminf(cloud->cover, 0.98f) * SHADE_SIDE * SHADE_SIDE;
    for (uint64_t i = 1; done && (float)shade->count < wanted && i < MOST_TRIALS; i++) {
        int64_t first = puffs->count;
        done = add_drawn_heap(&g, cloud, period, random_key(key, 0), random_key(key, i));
        for (int64_t k = first; k < puffs->count; k++) {
            darken(shade, &puffs->puff[k], period);
        }
    }
    free(shade);
    return done;
}

// A disc of flattened balls under the tropopause, drawn out downwind and thinner there.
static bool add_anvil(Grower *g, const Cloud *cloud, uint64_t key)
{
    enum { BALLS = 220 };
    float wind = cloud->wind * RADIANS_PER_DEGREE, sine = sinf(wind), cosine = cosf(wind);
    float top = cloud->base + 0.88f * cloud->thickness;
    for (uint64_t i = 0; i < BALLS; i++) {
        uint64_t own = random_key(key, i);
        float share = sqrtf(random_unit(random_key(own, 0)));
        float angle = random_range(random_key(own, 1), 0.0f, 2.0f * PI_F);
        float along = cloud->size * (0.9f + 2.4f * share * cosf(angle));
        float aside = cloud->size * 1.7f * share * sinf(angle);
        float radius = cloud->size * random_range(random_key(own, 2), 0.22f, 0.42f);
        float y = top + 0.02f * cloud->thickness * (random_unit(random_key(own, 3)) - 0.5f);
        Vec3 at = vec3(cloud->center_x + along * sine + aside * cosine, y,
                       cloud->center_z + along * cosine - aside * sine);
        if (!add(g, at, radius * (1.1f - 0.5f * share), 2.6f + 1.5f * share)) {
            return false;
        }
    }
    return true;
}

bool puffs_grow_storm(Puffs *puffs, const Cloud *cloud, float smallest, uint64_t key, Error *e)
{
    Grower g = {puffs, cloud->base, smallest, e};
    enum { TOWERS = 9 };
    Vec3 middle = vec3(cloud->center_x, cloud->base, cloud->center_z);
    for (uint64_t i = 0; i < TOWERS; i++) {
        uint64_t own = random_key(key, i);
        float share = (float)i / TOWERS; // the main tower first, the flanking line after it
        float angle = random_range(random_key(own, 0), 0.0f, 2.0f * PI_F);
        float off = cloud->size * (0.1f + 0.75f * share);
        Vec3 foot = vec3(middle.x + off * sinf(angle), middle.y, middle.z + off * cosf(angle));
        float height = cloud->thickness * (0.95f - 0.75f * share);
        float radius = cloud->size * (0.34f - 0.17f * share);
        if (!add_column(&g, foot, radius, height, random_key(own, 1))) {
            return false;
        }
    }
    return add_anvil(&g, cloud, random_key(key, TOWERS));
}

void puffs_clear(Puffs *puffs)
{
    free(puffs->puff);
    *puffs = (Puffs){0};
}
