// Levels of the water along rivers. They follow the land, fall downstream, and are smoothed, since
// samples would make steps of a cell. Steps of the land itself are kept: there the water falls.
#include "base/memory.h"
#include "objects/terrain/internal.h"

#include <math.h>
#include <stdlib.h>

static float nearest_sample(const HeightField *field, float x, float z)
{
    float u = (x - field->origin.x) / field->cell.x, v = (z - field->origin.y) / field->cell.y;
    int column = (int)clampf(u + 0.5f, 0.0f, (float)(field->columns - 1));
    int row = (int)clampf(v + 0.5f, 0.0f, (float)(field->rows - 1));
    return field->height[(int64_t)row * field->columns + column];
}

// The lowest land from bank to bank at node i: the highest level at which no water floats.
static float lowest_across(const OutTree *water, int64_t i, const HeightField *field)
{
    Vec3 p = water->position[i], q = water->position[water->parent[i]];
    float low = nearest_sample(field, p.x, p.z), half = water->radius[i];
    Vec3 across = vec3_normalize(vec3(p.z - q.z, 0.0f, q.x - p.x));
    int count = 1 + (int)(half / field->cell.x);
    for (int k = -count; k <= count; k++) {
        Vec3 at = vec3_madd(p, half * (float)k / (float)count, across);
        float h = nearest_sample(field, at.x, at.z);
        low = h < low ? h : low;
    }
    return low;
}

// Sets each node's height to the water level: as high as the land allows, falling downstream.
static void find_levels(OutTree *water, const HeightField *field)
{
    const float least_fall = 1e-5f;
    for (int64_t i = 0; i < water->count; i++) {
        Vec3 p = water->position[i];
        water->position[i].y =
            water->parent[i] < 0 ? nearest_sample(field, p.x, p.z) : lowest_across(water, i, field);
    }
    for (int64_t i = water->count - 1; i >= 0; i--) { // children follow their parents
        if (water->parent[i] >= 0) {
            Vec3 p = water->position[i], *q = &water->position[water->parent[i]];
            float dx = p.x - q->x, dz = p.z - q->z;
            float most = p.y - least_fall * sqrtf(dx * dx + dz * dz);
            q->y = q->y < most ? q->y : most;
        }
    }
}

// ---- falls

// A river, or a tributary with the node that it enters, from below: `node` holds `count` nodes.
typedef struct Stem {
    OutTree *water;
    int32_t *node;
    int64_t count;
    float reach, steep, least; // m over which a step is looked for; its least slope and height
    float *drop;               // of each node of the water
} Stem;

static Vec3 stem_at(const Stem *s, int64_t k)
{
    return s->water->position[s->node[k]];
}

// The place on the stem at least `length` m below place k; 0 if it ends before.
static int64_t place_below(const Stem *s, int64_t k, float length)
{
    float along = 0.0f;
    while (k > 0 && along < length) {
        Vec3 p = stem_at(s, k), q = stem_at(s, k - 1);
        along += sqrtf((p.x - q.x) * (p.x - q.x) + (p.z - q.z) * (p.z - q.z));
        k--;
    }
    return k;
}

// Does the water fall steeply from place k to a place below it, by a share of the least slope?
static bool is_steep(const Stem *s, int64_t k, int64_t below, float share)
{
    Vec3 p = stem_at(s, k), q = stem_at(s, below);
    float run = sqrtf((p.x - q.x) * (p.x - q.x) + (p.z - q.z) * (p.z - q.z));
    return p.y - q.y > 0.0f && p.y - q.y >= share * s->steep * run;
}

// The foot of the fall whose lip is place k; k itself if no water falls there.
static int64_t foot_of(const Stem *s, int64_t k)
{
    const float within = 0.5f; // share of the least slope from one node of a fall to the next
    int64_t foot = place_below(s, k, s->reach);
    if (!is_steep(s, k, k - 1, within) || !is_steep(s, k, foot, 1.0f)) {
        return k;
    }
    for (int64_t next = foot; next > 0;) {
        next = place_below(s, foot, 0.5f * s->reach);
        if (!is_steep(s, foot, next, 1.0f)) {
            break;
        }
        foot = next;
    }
    while (foot < k - 1 && !is_steep(s, foot + 1, foot, within)) {
        foot++;
    }
    return stem_at(s, k).y - stem_at(s, foot).y >= s->least ? foot : k;
}

// At a fall all levels below the lip become that of the foot, so that the bed is a wall.
static void find_falls_of(const Stem *s)
{
    for (int64_t k = s->count - 1; k > 0;) {
        int64_t foot = foot_of(s, k);
        if (foot == k) {
            k--;
            continue;
        }
        float level = stem_at(s, foot).y;
        for (int64_t j = foot + 1; j < k; j++) {
            s->water->position[s->node[j]].y = level;
        }
        s->drop[s->node[k]] = stem_at(s, k).y - level;
        k = foot;
    }
}

// Fills the drops. A river comes before its tributaries, which may fall into its pools.
static bool find_falls(OutTree *water, const RiverParams *rivers, float cell, float *drop, Error *e)
{
    const float cells = 2.0f; // a step of the land is one or two cells wide
    int32_t *main = terrain_main_children(water, e);
    int32_t *node = main ? memory_alloc(water->count + 1, sizeof *node, e) : NULL;
    Stem stem = {.water = water,
                 .node = node,
                 .reach = cells * cell,
                 .steep = rivers->fall_slope,
                 .least = rivers->fall_height,
                 .drop = drop};
    for (int32_t i = 0; node && i < water->count; i++) {
        int32_t parent = water->parent[i];
        if (parent >= 0 && main[parent] == i) {
            continue; // not the first of its stem
        }
        stem.count = 0;
        if (parent >= 0) {
            node[stem.count++] = parent;
        }
        for (int32_t k = i; k >= 0; k = main[k]) {
            node[stem.count++] = k;
        }
        find_falls_of(&stem);
    }
    bool done = node;
    free(node);
    free(main);
    return done;
}

// ----

// Averages each level with those a few cells downstream, which are lower, twice: otherwise the
// water falls in steps of a cell. No level is averaged with those below a fall.
static bool smooth_levels(OutTree *water, const float *drop, Error *e)
{
    enum { REACH = 8, TIMES = 2 };
    float *mean = memory_alloc(water->count, sizeof *mean, e);
    for (int time = 0; mean && time < TIMES; time++) {
        for (int64_t i = 0; i < water->count; i++) {
            int64_t below = i;
            float sum = 0.0f;
            for (int k = 0; k < REACH; k++) {
                sum += water->position[below].y;
                bool goes_on = water->parent[below] >= 0 && drop[below] <= 0.0f;
                below = goes_on ? water->parent[below] : below;
            }
            mean[i] = sum / REACH;
        }
        for (int64_t i = 0; i < water->count; i++) {
            water->position[i].y = mean[i];
        }
    }
    bool done = mean;
    free(mean);
    return done;
}

float *terrain_find_levels(OutTree *water, const RiverParams *rivers, const HeightField *field,
                           Error *e)
{
    float *drop = memory_alloc_zero(water->count, sizeof *drop, e);
    bool done = drop;
    if (done) {
        find_levels(water, field);
        done = (rivers->fall_height <= 0.0f || find_falls(water, rivers, field->cell.x, drop, e)) &&
               smooth_levels(water, drop, e);
    }
    for (int64_t i = 0; done && i < water->count; i++) {
        if (drop[i] > 0.0f) {
            drop[i] = water->position[i].y - water->position[water->parent[i]].y;
        }
    }
    if (!done) {
        free(drop);
        return NULL;
    }
    return drop;
}
