// The form meander: a river that winds in its floodplain. What it leaves on each sample
// (meander_trace.h) makes cut banks, point bars with scrolls, pools, and oxbow lakes.
#include "objects/terrain/meander_trace.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "objects/terrain/internal.h"
#include "objects/terrain/noise.h"

#include <math.h>
#include <stdlib.h>

static const double AGE = 75.0;    // time (Meander.time) of age 1
static const float BARS = 2.5f;    // time in which a point bar grows half way to the floodplain
static const float SCROLLS = 1.2f; // mean time from one scroll to the next
static const float BANK = 0.045f;  // of the width: height of the banks above the water
static const float DEPTH = 0.06f;  // of the width: mean depth of the middle of the bed, below banks
static const float TOE = 0.011f;   // of the width: how far low water has fallen below the bed's rim
static const float RAGGED = 0.05f; // how far the channel is wider or narrower here and there
static const float UNEVEN = 0.045f; // of the width: how far banks and scrolls stray from the line
static const float EDGE = 2.1f;     // half widths from the river's middle, up to which no field is
static const float UNPLOUGHED = 0.7f; // age there
static const float SCROLL = 0.22f;    // of the banks' height: mean height of scrolls
// Of the depth, by half widths and the curvature times the width: transverse slope of the bed, as
// Ikeda, Parker and Sawai (1981) take it from data, 2.9 to 5 in other rivers.
static const float SCOUR = 4.5f;

typedef struct Plain {
    const Terrain *terrain;
    TerrainParams p;
    HeightField *field;
    MeanderTrace trace;
    Vec2 *moved;       // MeanderTrace.moved
    float time, width; // m
} Plain;

// Ground about a sample.
typedef struct Site {
    float height; // m above the water
    bool wet;
} Site;

// Noise of octaves from `wave` m down that repeats after the size along z, as the river does: of
// two copies, which take turns.
static float repeating_noise(const Plain *plain, float wave, int octaves, float x, float z,
                             uint64_t key)
{
    float size = plain->p.size, t = z / size + 0.5f;
    float a = sparse_noise_fractal(x / wave, z / wave, octaves, 0.5f, 0.0f, key);
    float b = sparse_noise_fractal(x / wave, (z - size) / wave, octaves, 0.5f, 0.0f, key);
    return ((1.0f - t) * a + t * b) / sqrtf(t * t + (1.0f - t) * (1.0f - t));
}

enum { CHUNK = 256 }; // samples of a row that are laid together

// Samples first .. first + count - 1 of the grid, which lie in one row.
typedef struct Chunk {
    int64_t first;
    int count;
    float x[CHUNK], z;
} Chunk;

// Chunk k of the grid.
static Chunk chunk_of(const HeightField *f, int64_t k)
{
    int64_t each = (f->columns + CHUNK - 1) / CHUNK, row = k / each, column = k % each * CHUNK;
    int64_t left = f->columns - column;
    Chunk chunk = {.first = row * f->columns + column,
                   .count = left < CHUNK ? (int)left : CHUNK,
                   .z = f->origin.y + (float)row * f->cell.y};
    for (int i = 0; i < chunk.count; i++) {
        chunk.x[i] = f->origin.x + (float)(column + i) * f->cell.x;
    }
    return chunk;
}

static int64_t chunk_count(const HeightField *f)
{
    return (f->columns + CHUNK - 1) / CHUNK * f->rows;
}

// repeating_noise at a chunk's samples, with the same bits.
static void repeating_noise_along(const Plain *plain, float wave, int octaves, const Chunk *chunk,
                                  uint64_t key, float *sum)
{
    float size = plain->p.size, t = chunk->z / size + 0.5f, copy[2][CHUNK];
    for (int k = 0; k < 2; k++) {
        float x[CHUNK], y[CHUNK];
        for (int i = 0; i < chunk->count; i++) {
            x[i] = chunk->x[i] / wave;
            y[i] = (k == 0 ? chunk->z : chunk->z - size) / wave;
        }
        sparse_noise_fractal_along(x, y, chunk->count, octaves, 0.5f, 0.0f, key, copy[k]);
    }
    for (int i = 0; i < chunk->count; i++) {
        sum[i] =
            ((1.0f - t) * copy[0][i] + t * copy[1][i]) / sqrtf(t * t + (1.0f - t) * (1.0f - t));
    }
}

// ---- hills

// m above the floodplain of the hills beside it.
static float hills(const Plain *plain, float x, float z)
{
    const TerrainParams *p = &plain->p;
    uint64_t key = random_key(plain->terrain->seed, STREAM_PLAIN);
    float half = 0.5f * p->size;
    if (fabsf(x) < half * p->meander.plain - 0.2f * p->size) { // no noise is so strong
        return 0.0f;
    }
    float n = repeating_noise(plain, 0.125f * p->size, 5, x, z, key);
    float edge = half * p->meander.plain + 0.02f * p->size * n;
    float t = (fabsf(x) - edge) / (half * (1.15f - p->meander.plain));
    t = clampf(t, 0.0f, 1.0f);
    return p->relief * t * t * (3.0f - 2.0f * t) * (0.8f + 0.2f * n);
}

// ---- the floodplain

// Floods come at uneven times: what they have left on the bar, about -1..1.
static float flood(const Plain *plain, float time)
{
    uint64_t key = random_key(plain->terrain->seed, STREAM_SCROLLS);
    return sparse_noise(2.0f * time / SCROLLS, 0.37f, key);
}

// Ground that the channel left at a time, m above the water.
static float bar(const Plain *plain, float left)
{
    float since = plain->time - left, grown = since / (since + BARS);
    float fades = 40.0f / (40.0f + since);
    float scroll = SCROLL * flood(plain, left) * grown * fades;
    return plain->width * (TOE + (BANK - TOE) * (grown + scroll));
}

// A bend that was cut off stays a hollow, deepest where its last water was.
static Site oxbow(const Plain *plain, int64_t i, float ground)
{
    const MeanderTrace *t = &plain->trace;
    float w = plain->width, old = t->old[i], open = t->open[i];
    float low = w * BANK * (0.12f + 0.36f * t->filled[i]);
    float hollow = smoothstepf(1.3f, 0.7f, old);
    ground = lerpf(ground, fminf(low, ground), hollow);
    if (open > 0.0f && old < 1.5f * open) {
        float across = old / open, shore = across - 1.0f;
        float depth = DEPTH * w * 0.7f * open * (1.0f - across * across);
        float beside = lerpf(0.0f, ground, clampf(2.0f * shore, 0.0f, 1.0f));
        return (Site){across < 1.0f ? -depth : beside, across < 1.0f};
    }
    return (Site){ground, false};
}

// The river's bed: deep at the outer bank, shoal at the point bar.
static float bed(const Plain *plain, float aside, float bend)
{
    float outer = aside * (bend > 0.0f ? 1.0f : -1.0f); // 1 at the outer bank
    float square = aside * aside, fourth = square * square;
    float bank = outer > 0.0f ? 1.0f - fourth * square : 1.0f - lerpf(square, fourth, 0.3f);
    float scour = fmaxf(1.0f + 0.5f * SCOUR * aside * bend, 0.12f);
    return plain->width * (TOE - DEPTH * scour * bank);
}

// rough: noise of a width and less.
static Site site_at(const Plain *plain, int64_t i, float x, float z, float rough)
{
    const MeanderTrace *t = &plain->trace;
    float w = plain->width, left = t->left[i];
    float fresh = left < 0.0f ? 1.0f : (plain->time - left) / (plain->time - left + 2.0f);
    float ground = left < 0.0f ? BANK * w : bar(plain, left);
    ground += 0.003f * w * rough * fresh;
    Site site = {fmaxf(ground, 0.002f * w), false};
    float aside = t->aside[i];
    if (fabsf(aside) < 1.4f) {
        uint64_t key = random_key(random_key(plain->terrain->seed, STREAM_NOISE), 1);
        float ragged = 1.0f + RAGGED * repeating_noise(plain, 0.7f * w, 4, x, z, key);
        aside *= clampf(ragged, 0.75f, 1.25f);
    }
    if (fabsf(aside) < 1.0f) {
        float height = bed(plain, aside, t->bend[i]);
        return (Site){height, height < 0.0f};
    }
    return t->old[i] < INFINITY ? oxbow(plain, i, site.height) : site;
}

static void lay_sample(const Plain *plain, int64_t i, float x, float z, float rough)
{
    HeightField *f = plain->field;
    const MeanderTrace *t = &plain->trace;
    float w = plain->width;
    float hill = hills(plain, x, z), plane = -plain->p.meander.slope * z;
    Site site = site_at(plain, i, x, z, rough);
    float since = plain->time - t->left[i];
    // Nobody ploughs to the river's edge: there old ground is left to grass and trees.
    float old = fabsf(t->aside[i]) < EDGE ? UNPLOUGHED : 0.74f;
    f->age[i] = t->left[i] < 0.0f ? old : 0.74f * since / (since + 9.0f);
    f->age[i] = hill > 0.02f * plain->p.relief ? 0.8f : f->age[i];
    f->height[i] = site.height + plane + hill;
    // Known in all of the plain: were it so near the river and in old bends alone, water would be
    // cut off along the samples wherever either has been worked over.
    bool near = fabsf(t->aside[i]) < 3.0f || t->old[i] < INFINITY;
    f->water[i] = near || !(hill > 0.0f) ? plane : -INFINITY;
    float damp = 1.0f - site.height / (1.25f * BANK * w);
    f->wetness[i] = site.wet ? 1.0f : hill > 0.0f ? 0.0f : clampf(damp, 0.0f, 0.95f);
    f->loose[i] = hill > 0.0f ? 0.5f : DEPTH * w;
}

static void lay_all(const Plain *plain, int64_t chunks, const Run *run)
{
    uint64_t key = random_key(plain->terrain->seed, STREAM_NOISE);
#pragma omp parallel for schedule(dynamic, 16) num_threads(run->threads)
    for (int64_t k = 0; k < chunks; k++) {
        Chunk chunk = chunk_of(plain->field, k);
        float rough[CHUNK];
        repeating_noise_along(plain, plain->width, 4, &chunk, key, rough);
        for (int i = 0; i < chunk.count; i++) {
            lay_sample(plain, chunk.first + i, chunk.x[i], chunk.z, rough[i]);
        }
    }
}

// Roots and clay hold banks here and there: each sample is looked up a little aside. m.
static bool move_samples(Plain *plain, const Run *run, Error *e)
{
    const HeightField *f = plain->field;
    float width = plain->p.meander.width, most = 2.5f * UNEVEN * width;
    uint64_t key = random_key(random_key(plain->terrain->seed, STREAM_SCROLLS), 1);
    plain->moved = memory_alloc(height_field_count(f), sizeof *plain->moved, e);
    if (!plain->moved) {
        return false;
    }
#pragma omp parallel for schedule(dynamic, 16) num_threads(run->threads)
    for (int64_t n = 0; n < chunk_count(f); n++) {
        Chunk chunk = chunk_of(f, n);
        float move[2][CHUNK];
        for (int k = 0; k < 2; k++) {
            repeating_noise_along(plain, 1.5f * width, 4, &chunk, random_key(key, (uint64_t)k),
                                  move[k]);
        }
        for (int i = 0; i < chunk.count; i++) {
            plain->moved[chunk.first + i] =
                (Vec2){clampf(UNEVEN * width * move[0][i], -most, most),
                       clampf(UNEVEN * width * move[1][i], -most, most)};
        }
    }
    plain->trace.moved = plain->moved;
    plain->trace.most = most;
    return true;
}

static bool make_field(Plain *plain, Error *e)
{
    const TerrainParams *p = &plain->p;
    float cell = p->size / (float)p->resolution, corner = -0.5f * p->size;
    HeightField *f = height_field_new(p->resolution + 1, p->resolution + 1, (Vec2){cell, cell},
                                      (Vec2){corner, corner}, e);
    plain->field = f;
    if (!f) {
        return false;
    }
    int64_t count = height_field_count(f);
    return (f->wetness = memory_alloc(count, sizeof *f->wetness, e)) &&
           (f->age = memory_alloc(count, sizeof *f->age, e)) &&
           (f->water = memory_alloc(count, sizeof *f->water, e)) &&
           (f->loose = memory_alloc(count, sizeof *f->loose, e)) &&
           meander_trace_new(&plain->trace, f, e);
}

bool terrain_grow_meander(Terrain *terrain, const Run *run, Error *e)
{
    Plain plain = {.terrain = terrain, .p = terrain_params_resolve(terrain->params)};
    const TerrainParams *p = &plain.p;
    uint64_t key = random_key(terrain->seed, STREAM_MEANDER);
    Meander *m = meander_new((double)p->meander.width, (double)p->size, 0.3, key, e);
    terrain->meander = m;
    bool done = m && make_field(&plain, e) && move_samples(&plain, run, e);
    terrain->plain = plain.field;
    if (done) {
        m->contrast = 0.5;
        m->reach = 0.5 * (double)(p->size * p->meander.plain) - m->width;
        done = meander_trace_run(&plain.trace, m, AGE * (double)p->meander.age, run, e) &&
               meander_trace_river(&plain.trace, m, e) && meander_trace_oxbows(&plain.trace, m, e);
        plain.time = (float)m->time;
        plain.width = (float)m->width;
    }
    lay_all(&plain, done ? chunk_count(plain.field) : 0, run);
    meander_trace_free(&plain.trace);
    free(plain.moved);
    return done;
}

void terrain_sample_meander(const Terrain *terrain, HeightField *field, int64_t i, float x, float z)
{
    const HeightField *plain = terrain->plain;
    (void)x;
    (void)z;
    field->height[i] = plain->height[i];
    field->wetness[i] = plain->wetness[i];
    field->age[i] = plain->age[i];
    field->water[i] = plain->water[i];
    field->loose[i] = plain->loose[i];
}

// It flows slowly everywhere.
float terrain_meander_roughness(const Terrain *terrain, float x, float z)
{
    (void)terrain;
    (void)x;
    (void)z;
    return 0.3f;
}

// Leopold and Wolman 1960: meanders are 7 to 15 widths long.
bool terrain_measure_meander(const Terrain *terrain, MeasureList *list, Error *e)
{
    const Meander *m = terrain->meander;
    double open = (double)meander_open_oxbows(m);
    return measures_add(list, "sinuosity", meander_sinuosity(m), "", 1.3, 4, e) &&
           measures_add(list, "wavelength_ratio", meander_wavelength(m), "", 5, 15, e) &&
           measures_add(list, "oxbows", open, "", (double)NAN, (double)NAN, e);
}
