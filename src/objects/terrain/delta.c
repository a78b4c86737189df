// The form delta: a river enters a shallow sea and builds land there (land/delta.h). The model's
// grid tells channels, bars and bays; between its cells the land is smooth, its borders frayed by
// noise, with levees beside channels and creeks in the marsh.
#include "objects/terrain/delta.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"
#include "land/delta_measure.h"
#include "objects/terrain/form.h"

#include <math.h>
#include <stdlib.h>

static const double BRING = 0.4;   // DeltaRates.bring
static const double FILLED = 0.26; // of size^2 * depth: what the river has brought at age 1
static const double SLOPE = 3e-4;  // of the river, by Liang et al.
static const double CREST = 0.28;  // m above the water of levees and
static const double CREEK = 0.14;  // m of creeks, of the river's depth
static const double PLAIN = 0.24;  // likewise of the old land above the sea
static const double UNEVEN = 0.02; // of the sea's bed, of its depth

int terrain_delta_cells(const TerrainParams *params)
{
    TerrainParams p = terrain_params_resolve(params);
    double cells = floor(DELTA_INLETS * (double)p.size / (double)p.delta.width + 0.5);
    return (int)fmin(fmax(cells, DELTA_LEAST_CELLS), DELTA_MOST_CELLS);
}

// ---- the ground before the river

typedef struct Ground {
    Delta *d;
    const TerrainParams *p; // resolved
    uint64_t seed;
    double wide; // of the river, cells
} Ground;

static double wave(const Ground *g, double at, uint64_t stream, int octaves)
{
    uint64_t key = random_key(random_key(g->seed, STREAM_PLAIN), stream);
    return (double)noise_plane_fractal((float)at, 0.37f + (float)stream, octaves, key);
}

// Row of the old shore, and the column of the river's middle on the old land.
static double shore(const Ground *g, double column)
{
    double n = g->d->columns, bay = 2.0 * column / n - 1.0;
    double row = n * ((double)g->p->delta.plain + 0.05 * bay * bay);
    return row + 0.05 * n * wave(g, 4.0 * column / n, 0, 5);
}

static double river(const Ground *g, double row)
{
    const double straight = 3.0; // rows: each cell in which water enters has one below
    double n = g->d->columns, up = (double)g->p->delta.plain - fmax(row, straight) / n;
    double bend = 0.11 * n * wave(g, 11.0 * up, 1, 2);
    return 0.5 * n + (up > 0.0 ? bend * fmin(14.0 * up, 1.0) : 0.0);
}

static void lay_cell(const Ground *g, int64_t i)
{
    Delta *d = g->d;
    double column = (double)delta_column(d, i) + 0.5, row = (double)delta_row(d, i) + 0.5;
    double out = row - shore(g, column), depth = d->depth;
    double inside = fabs(column - river(g, row));
    bool trunk = inside <= 0.5 * g->wide;
    bool rim = column < 1.0 || column > d->columns - 1.0 || row > d->rows - 1.0;
    if (out < 0.0) {
        d->kind[i] = trunk ? DELTA_TRUNK : DELTA_PLAIN;
        double rise = PLAIN * (1.0 - exact_exp(out / 4.0)) + 0.03;
        double side = inside / (0.5 * g->wide);
        d->bed[i] = trunk ? -depth * (1.0 - 0.5 * side * side) : depth * rise;
        return;
    }
    uint64_t key = random_key(random_key(g->seed, STREAM_SAND), (uint64_t)i);
    d->kind[i] = rim ? DELTA_EDGE : DELTA_OPEN;
    d->bed[i] = -depth * (1.0 - exact_exp(-out / (0.03 * d->rows)));
    d->bed[i] += depth * (double)random_range(key, (float)-UNEVEN, (float)UNEVEN);
    d->bed[i] = trunk && out < 2.0 * g->wide ? fmin(d->bed[i], -0.8 * depth) : d->bed[i];
}

static bool lay_ground(DeltaLand *land, const TerrainParams *p, uint64_t seed, Error *e)
{
    Ground g = {land->model, p, seed, DELTA_INLETS};
    land->model->mouth[0] = 0.5 * land->model->columns;
    land->model->mouth[1] = shore(&g, land->model->mouth[0]);
    for (int64_t i = 0; i < delta_count(land->model); i++) {
        lay_cell(&g, i);
    }
    return delta_begin(land->model, e);
}

bool terrain_grow_delta(Terrain *terrain, const Run *run, Error *e)
{
    TerrainParams p = terrain_params_resolve(terrain->params);
    int cells = terrain_delta_cells(terrain->params);
    DeltaLand *land = memory_alloc_zero(1, sizeof *land, e);
    terrain->delta = land;
    if (!land) {
        return false;
    }
    Delta *d = land->model = delta_new(cells, cells, (double)p.size / cells, e);
    if (!d) {
        return false;
    }
    land->corner = -0.5 * (double)p.size;
    d->depth = (double)p.delta.depth;
    d->slope = SLOPE;
    d->seed = random_key(terrain->seed, STREAM_DELTA);
    double side = (double)cells / DELTA_INLETS;
    double steps = floor(FILLED / BRING * (double)p.delta.age * side * side + 0.5);
    DeltaRates rates = {.sand = (double)p.delta.sand,
                        .rise = (double)p.delta.rise * d->depth / steps,
                        .bring = BRING};
    if (!lay_ground(land, &p, terrain->seed, e) || !delta_run(d, &rates, (int64_t)steps, run, e)) {
        return false;
    }
    float creeks = p.delta.creeks, stirred = p.delta.stirred;
    return delta_land_finish(land, steps, e) &&
           (creeks <= 0.0f || delta_creeks_grow(land, creeks, random_key(d->seed, 1), run, e)) &&
           (stirred <= 0.0f || delta_stir(land, stirred, random_key(d->seed, 2), run, e));
}

// ---- a place

float delta_land_at(const DeltaLand *land, const float *field, float u, float v)
{
    const Delta *d = land->model;
    int column = (int)floorf(u), row = (int)floorf(v);
    float s = u - (float)column - 0.5f, t = v - (float)row - 0.5f, sum = 0.0f;
    float across[3] = {0.5f * (0.5f - s) * (0.5f - s), 0.75f - s * s,
                       0.5f * (0.5f + s) * (0.5f + s)};
    float along[3] = {0.5f * (0.5f - t) * (0.5f - t), 0.75f - t * t,
                      0.5f * (0.5f + t) * (0.5f + t)};
    for (int k = 0; k < 9; k++) {
        int c = column + k % 3 - 1, r = row + k / 3 - 1;
        c = c < 0 ? 0 : c >= d->columns ? d->columns - 1 : c;
        r = r < 0 ? 0 : r >= d->rows ? d->rows - 1 : r;
        sum += across[k % 3] * along[k / 3] * field[(int64_t)r * d->columns + c];
    }
    return sum;
}

// A place in the model's cells, moved by noise: shores are frayed.
static Vec2 moved(const Terrain *terrain, float x, float z, float reach)
{
    const DeltaLand *land = terrain->delta;
    float cell = (float)land->model->cell, corner = (float)land->corner;
    uint64_t key = random_key(terrain->seed, STREAM_NOISE);
    Vec2 at = {(x - corner) / cell, (z - corner) / cell};
    float dx = noise_plane_fractal(at.x / 3.5f, at.y / 3.5f, 5, key);
    float dz = noise_plane_fractal(at.x / 3.5f, at.y / 3.5f, 5, random_key(key, 1));
    return (Vec2){at.x + reach * dx, at.y + reach * dz};
}

// m that fine relief adds to ground `above` the water by that share of the river's depth: levees,
// creeks in the marsh, and hummocks.
static float relief(const Terrain *terrain, Vec2 at, float above, float levee)
{
    uint64_t key = random_key(terrain->seed, STREAM_SCROLLS);
    float low = smoothstepf(-0.45f, -0.05f, above); // not in deep water
    float rough = noise_plane_fractal(at.x / 1.4f, at.y / 1.4f, 5, random_key(key, 1));
    float broad = noise_plane_fractal(at.x / 6.0f, at.y / 6.0f, 3, random_key(key, 3));
    float height = (0.055f * rough + 0.06f * broad) * (0.25f + 0.75f * low);
    float bank = smoothstepf(-0.08f, 0.02f, above) * levee * levee;
    height += (float)CREST * bank * (1.0f + 0.8f * rough);
    if (terrain->delta->creeks) {
        return height;
    }
    // Creeks wind where two levels of noise meet.
    float line = fabsf(noise_plane_fractal(at.x / 4.5f, at.y / 4.5f, 5, random_key(key, 2)));
    float width = 0.035f * clampf(1.0f - levee, 0.0f, 1.0f);
    float creek = width > 0.0f ? smoothstepf(width, 0.3f * width, line) : 0.0f;
    return height - (float)CREEK * creek * smoothstepf(-0.1f, 0.0f, above);
}

void terrain_sample_delta(const Terrain *terrain, HeightField *field, int64_t i, float x, float z)
{
    const DeltaLand *land = terrain->delta;
    float depth = (float)land->model->depth;
    Vec2 at = moved(terrain, x, z, 1.3f);
    float ground = delta_land_at(land, land->ground, at.x, at.y);
    float level = delta_land_at(land, land->level, at.x, at.y);
    float levee = delta_land_at(land, land->levee, at.x, at.y);
    float age = delta_land_at(land, land->age, at.x, at.y);
    ground += depth * relief(terrain, at, (ground - level) / depth, levee);
    ground = land->creeks ? delta_creeks_cut(land, at, ground, level) : ground;
    float above = (ground - level) / depth;
    field->height[i] = ground;
    field->water[i] = above < 0.35f ? level : -INFINITY;
    field->wetness[i] = clampf(1.0f - above / 0.25f, 0.0f, 1.0f);
    field->age[i] = clampf(age, 0.0f, 1.0f);
    field->loose[i] = depth;
}

// Mud in the water.
float terrain_delta_load(const Terrain *terrain, float x, float z)
{
    const DeltaLand *land = terrain->delta;
    if (land->fine_load) {
        return delta_stirred_at(land, moved(terrain, x, z, 1.3f));
    }
    Vec2 at = moved(terrain, x, z, 2.2f);
    return clampf(delta_land_at(land, land->load, at.x, at.y), 0.0f, 1.0f);
}

// Every sample that the shores or shoals touch is a vertex.
bool terrain_finish_delta(Terrain *terrain, HeightField *field, const Run *run, Error *e)
{
    (void)run;
    float depth = (float)terrain->delta->model->depth;
    if (!terrain_keep_shores(terrain, field, 0.15f * depth, e)) {
        return false;
    }
    for (int64_t i = 0; i < height_field_count(field); i++) {
        terrain->bank[i] &= field->height[i] > field->water[i] - 0.1f * depth;
    }
    return true;
}

bool terrain_measure_delta(const Terrain *terrain, MeasureList *list, Error *e)
{
    DeltaMeasures m;
    const DeltaLand *land = terrain->delta;
    const double nan = (double)NAN, fall = DELTA_FALL * land->model->depth;
    return delta_measure(land->model, fall, &m, e) &&
           measures_add(list, "branches", m.branches, "", nan, nan, e) &&
           measures_add(list, "mouths", m.mouths, "", nan, nan, e) &&
           measures_add(list, "land_area", 1e-6 * m.land, "km2", nan, nan, e) &&
           measures_add(list, "land_share", m.land_share, "", nan, nan, e) &&
           measures_add(list, "shoreline_ratio", m.shoreline, "", nan, nan, e) &&
           measures_add(list, "reach", m.reach, "m", nan, nan, e);
}
