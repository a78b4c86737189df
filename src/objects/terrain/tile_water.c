// Finer ground of tiles where there is water: beds of rivers are dug into it again, at its own
// samples, and no roughness lets a lake run out or rise above its water.
#include "base/memory.h"
#include "objects/terrain/drawn.h"
#include "objects/terrain/form.h"
#include "objects/terrain/lakes.h"

#include <math.h>
#include <stdlib.h>

// ---- lakes

// The lake that wets a cell, as the water is drawn (lake_water.c); -1 = none. *wet: its corners
// under water.
static int32_t lake_of(const TileWater *water, int64_t column, int64_t row, int *wet)
{
    static const int CORNER[4][2] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    const HeightField *field = water->field;
    int32_t lake = -1;
    *wet = 0;
    for (int k = 0; k < 4; k++) {
        int64_t c = column + CORNER[k][0], r = row + CORNER[k][1];
        bool within = c >= 0 && r >= 0 && c < field->columns && r < field->rows;
        int32_t label = within ? water->terrain->lakes->label[r * field->columns + c] : -1;
        *wet += label >= 0;
        lake = lake < 0 ? label : lake;
    }
    return lake;
}

// The cells around a place: those that it touches, one more on an edge, so that tiles agree there,
// and those beside these.
typedef struct CellsAround {
    int32_t lake[16], touched; // touched: the lake of the cells that it touches; -1 = not one alone
    int count;
    bool covers; // are all corners of the cells that it touches under water?
} CellsAround;

static CellsAround cells_around(const TileWater *water, const TileSample *sample)
{
    int64_t first[2] = {(int64_t)ceil(sample->u) - 1, (int64_t)ceil(sample->v) - 1};
    int64_t last[2] = {(int64_t)floor(sample->u), (int64_t)floor(sample->v)};
    CellsAround around = {.touched = -2, .covers = true};
    for (int64_t row = first[1] - 1; row <= last[1] + 1; row++) {
        for (int64_t column = first[0] - 1; column <= last[0] + 1; column++) {
            int wet;
            int32_t lake = lake_of(water, column, row, &wet);
            around.lake[around.count++] = lake;
            if (column >= first[0] && column <= last[0] && row >= first[1] && row <= last[1]) {
                bool same = around.touched == -2 || around.touched == lake;
                around.touched = same ? lake : -1;
                around.covers = around.covers && wet == 4;
            }
        }
    }
    return around;
}

// Under all of a cell of a lake, the ground keeps half of its depth; where the water ends, and in
// the cells beside those, half of its height above it. Between them the shore is where the finer
// ground has it.
static float shaped_by_lakes(const TileWater *water, const TileSample *sample, float height)
{
    const float close = 0.01f; // m: outlets are as high as the water
    const Lakes *lakes = water->terrain->lakes;
    if (!lakes) {
        return height;
    }
    CellsAround around = cells_around(water, sample);
    float coarse = height_field_at(water->field, sample->at.x, sample->at.y);
    if (around.touched >= 0) {
        float bed = 0.5f * (coarse + lakes->lake[around.touched].level);
        return around.covers ? fminf(height, bed) : height;
    }
    for (int k = 0; k < around.count; k++) {
        float level = around.lake[k] >= 0 ? lakes->lake[around.lake[k]].level : INFINITY;
        if (coarse > level - close) {
            height = fmaxf(height, fmaxf(level, 0.5f * (coarse + level)));
        }
    }
    return height;
}

// ---- rivers

// In a river the ground is its bed; beside it first as low, so that the corners of all cells which
// its water touches are, then, within half a cell of the terrain, above the water.
static float shaped_by_rivers(const TileWater *water, const TileSample *sample, float height)
{
    const Terrain *terrain = water->terrain;
    float cell = water->field->cell.x, reach = TERRAIN_STRAND * cell, far = reach + 2.0f * cell;
    if (!terrain->shore) {
        return height;
    }
    int32_t node;
    float x = sample->at.x, z = sample->at.y;
    float away = trough_envelope_at(terrain->shore, x, z, &node);
    if (away >= far) {
        return height;
    }
    float bed = terrain_bed_at(terrain, node, x, z, away, cell);
    if (terrain_lake_at(terrain, water->field, x, z) > -INFINITY) {
        return away < 0.0f ? fminf(height, bed) : height;
    }
    float half = terrain->water->radius[node], low = 1.5f * sample->cell;
    float bank =
        bed + 2.0f * terrain_bed_depth(half, half) * smoothstepf(low, low + 0.5f * cell, away);
    float land = lerpf(bank, fmaxf(height, bank), smoothstepf(low, reach, away));
    return lerpf(land, height, smoothstepf(reach, far, away));
}

// ---- water whose level the heights record

// The water's level at a place of a cell, or where that is beside it at the cell's nearest place;
// -INFINITY: the cell has no water (flow_water.c). *under: its corners under water.
static float flow_level(const HeightField *field, int64_t column, int64_t row, double u, double v,
                        int *under)
{
    float level[4];
    *under = 0;
    for (int k = 0; k < 4; k++) {
        int64_t i = (row + k / 2) * field->columns + column + k % 2;
        level[k] = field->water[i];
        if (!(level[k] > -INFINITY)) {
            *under = 0;
            return -INFINITY;
        }
        *under += level[k] > field->height[i];
    }
    float s = clampf((float)(u - (double)column), 0.0f, 1.0f);
    float t = clampf((float)(v - (double)row), 0.0f, 1.0f);
    return *under == 0 ? -INFINITY
                       : lerpf(lerpf(level[0], level[1], s), lerpf(level[2], level[3], s), t);
}

// As of lakes: under all of a cell's water the ground keeps half of its depth, where the water ends
// half of its height above it, and between them the finer ground draws the shore.
static float shaped_by_flow(const TileWater *water, const TileSample *sample, float height)
{
    const float close = 0.01f; // m
    const HeightField *field = water->field;
    if (!terrain_form(water->terrain->params)->water || !field->water) {
        return height;
    }
    int64_t first[2] = {(int64_t)ceil(sample->u) - 1, (int64_t)ceil(sample->v) - 1};
    int64_t last[2] = {(int64_t)floor(sample->u), (int64_t)floor(sample->v)};
    bool wet = true, covers = true;
    float beside = -INFINITY, here = -INFINITY;
    for (int64_t row = first[1] - 1; row <= last[1] + 1; row++) {
        for (int64_t column = first[0] - 1; column <= last[0] + 1; column++) {
            if (row < 0 || column < 0 || row + 1 >= field->rows || column + 1 >= field->columns) {
                continue;
            }
            int under;
            float level = flow_level(field, column, row, sample->u, sample->v, &under);
            beside = fmaxf(beside, level);
            if (column >= first[0] && column <= last[0] && row >= first[1] && row <= last[1]) {
                wet = wet && under > 0;
                covers = covers && under == 4;
                here = fmaxf(here, level);
            }
        }
    }
    float coarse = height_field_at(field, sample->at.x, sample->at.y);
    if (wet) {
        return covers ? fminf(height, 0.5f * (coarse + here)) : height;
    }
    if (!(beside > -INFINITY)) {
        return height;
    }
    // Where the record of levels ends below one, the water stands over the ground no higher than it
    // does without tiles.
    float least = coarse > beside - close ? fmaxf(beside, 0.5f * (coarse + beside)) : coarse;
    return fmaxf(height, least);
}

static float shaped(const void *data, const TileSample *sample, float height)
{
    height = shaped_by_flow(data, sample, height);
    return shaped_by_rivers(data, sample, shaped_by_lakes(data, sample, height));
}

// ----

static int64_t tile_of(int64_t sample, int64_t cells, int64_t last)
{
    int64_t tile = sample > 0 ? sample / cells : 0;
    return tile < last ? tile : last;
}

// Tiles with water or with its shores, or so many samples from those.
static void mark_whole(TileWater *water, int tiles)
{
    enum { BESIDE = 3 };
    const HeightField *field = water->field;
    const Terrain *terrain = water->terrain;
    int64_t columns = field->columns, cells = (columns - 1) / tiles;
    for (int64_t i = 0; i < height_field_count(field); i++) {
        bool wet = (terrain->bank && terrain->bank[i]) ||
                   (terrain->lakes && terrain->lakes->label[i] >= 0);
        int64_t column = i % columns, row = i / columns, last = tiles - 1;
        int64_t west = tile_of(column - BESIDE, cells, last),
                north = tile_of(row - BESIDE, cells, last);
        int64_t east = tile_of(column + BESIDE, cells, last),
                south = tile_of(row + BESIDE, cells, last);
        for (int64_t r = north; wet && r <= south; r++) {
            for (int64_t c = west; c <= east; c++) {
                water->whole[r * tiles + c] = 1;
            }
        }
    }
}

bool tile_water_init(TileWater *water, const Terrain *terrain, const HeightField *field, int tiles,
                     Error *e)
{
    *water = (TileWater){.terrain = terrain,
                         .field = field,
                         .whole = memory_alloc_zero((int64_t)tiles * tiles, 1, e)};
    water->shaping = (TileShaping){.height = shaped, .data = water, .whole = water->whole};
    if (water->whole) {
        mark_whole(water, tiles);
    }
    return water->whole;
}

void tile_water_clear(TileWater *water)
{
    free(water->whole);
}
