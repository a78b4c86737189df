// Finer ground of tiles where there is water: beds of rivers are dug into it again, at its own
// samples, and no roughness lets a lake run out or rise above its water.
#include "base/memory.h"
#include "objects/terrain/drawn.h"
#include "objects/terrain/lakes.h"

#include <math.h>
#include <stdlib.h>

// ---- lakes

// How the cells around a place are covered by lakes, and the first of those.
typedef struct LakeAround {
    int32_t lake; // -1 = none
    bool covers;  // are all corners of all cells that the place touches under its water?
    bool ends;    // does the place touch a cell without a corner under water?
} LakeAround;

// Corners of a cell under water; *lake: that of the first, if it was -1.
static int wet_corners(const TileWater *water, int64_t column, int64_t row, int32_t *lake)
{
    const HeightField *field = water->field;
    int count = 0;
    for (int k = 0; k < 4; k++) {
        int64_t c = column + k % 2, r = row + k / 2;
        bool within = c >= 0 && r >= 0 && c < field->columns && r < field->rows;
        int32_t label = within ? water->terrain->lakes->label[r * field->columns + c] : -1;
        count += label >= 0;
        *lake = *lake < 0 ? label : *lake;
    }
    return count;
}

// A place on an edge of cells touches both, so that tiles agree there.
static LakeAround lake_around(const TileWater *water, const TileSample *sample)
{
    int64_t first[2] = {(int64_t)ceil(sample->u) - 1, (int64_t)ceil(sample->v) - 1};
    int64_t last[2] = {(int64_t)floor(sample->u), (int64_t)floor(sample->v)};
    LakeAround around = {.lake = -1, .covers = true};
    for (int64_t row = first[1] - 1; row <= last[1] + 1; row++) {
        for (int64_t column = first[0] - 1; column <= last[0] + 1; column++) {
            int wet = wet_corners(water, column, row, &around.lake);
            bool touches =
                column >= first[0] && column <= last[0] && row >= first[1] && row <= last[1];
            around.covers = around.covers && (!touches || wet == 4);
            around.ends = around.ends || (touches && wet == 0);
        }
    }
    return around;
}

// Under all of a cell of a lake, the ground keeps half of its depth; in a cell beside those that
// touch the lake, which has no water, half of its height above it. Between them the shore is where
// the finer ground has it.
static float shaped_by_lakes(const TileWater *water, const TileSample *sample, float height)
{
    if (!water->terrain->lakes) {
        return height;
    }
    LakeAround around = lake_around(water, sample);
    if (around.lake < 0 || !(around.covers || around.ends)) {
        return height;
    }
    float level = water->terrain->lakes->lake[around.lake].level;
    float half = 0.5f * (height_field_at(water->field, sample->at.x, sample->at.y) + level);
    if (around.covers) {
        return fminf(height, half);
    }
    return half >= level ? fmaxf(height, half) : height;
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

static float shaped(const void *data, const TileSample *sample, float height)
{
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
