// The shores of lakes: waves cut a bench at the water's level and spread its gravel, so that a
// beach slopes under water.
#include "base/memory.h"
#include "objects/terrain/lakes.h"

#include <math.h>
#include <stdlib.h>

static const float BEACH_SLOPE = 0.11f; // of gravel, about 1 : 9
static const float LONGEST = 8.0f;      // cells: of a beach's width on one side of the shoreline

// m from each sample to its shoreline, INFINITY far from any, and that shore's level and width.
typedef struct Shores {
    HeightField *field;
    const Lakes *lakes;
    float *distance;
    int32_t *lake; // of the nearest shoreline
    float *width;  // m, of each lake's beach on each side
} Shores;

// Of a lake, by the wind's fetch over it.
static float beach_width(const TerrainLakeParams *params, const HeightField *field,
                         const Lake *lake)
{
    float cell = field->cell.x, across = cell * sqrtf((float)lake->samples);
    float natural = clampf(0.02f * across, 2.5f * cell, LONGEST * cell);
    return clampf(params->beach > 0.0f ? params->beach : natural, 0.0f, LONGEST * cell);
}

// A place on the shoreline, in cells: samples around it are at most so far from the shore.
static void touch(Shores *s, float column, float row, int32_t lake)
{
    const HeightField *field = s->field;
    float cell = field->cell.x;
    int reach = (int)(s->width[lake] / cell) + 1;
    int c0 = (int)column - reach, r0 = (int)row - reach;
    for (int r = r0 > 0 ? r0 : 0; r <= (int)row + reach + 1 && r < field->rows; r++) {
        for (int c = c0 > 0 ? c0 : 0; c <= (int)column + reach + 1 && c < field->columns; c++) {
            float dx = (float)c - column, dz = (float)r - row;
            float d = cell * sqrtf(dx * dx + dz * dz);
            int64_t i = (int64_t)r * field->columns + c;
            if (d < s->distance[i]) {
                s->distance[i] = d;
                s->lake[i] = lake;
            }
        }
    }
}

// The shoreline crosses the edges between a lake's samples and others.
static void trace_shorelines(Shores *s)
{
    static const int STEP[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    const HeightField *field = s->field;
    for (int64_t i = 0; i < height_field_count(field); i++) {
        int32_t lake = s->lakes->label[i];
        int column = (int)(i % field->columns), row = (int)(i / field->columns);
        for (int k = 0; k < 4 && lake >= 0; k++) {
            int c = column + STEP[k][0], r = row + STEP[k][1];
            int64_t n = (int64_t)r * field->columns + c;
            if (c < 0 || r < 0 || c >= field->columns || r >= field->rows ||
                s->lakes->label[n] == lake) {
                continue;
            }
            float below = s->lakes->lake[lake].level - field->height[i];
            float above = field->height[n] - s->lakes->lake[lake].level;
            float share = above > 0.0f ? below / (below + above) : 1.0f;
            touch(s, (float)column + share * (float)STEP[k][0],
                  (float)row + share * (float)STEP[k][1], lake);
        }
    }
}

// Land falls to the beach and never below the level, the bed rises to it and never above: the
// shoreline and the outlet stay. Both join the ground as it was at the beach's ends.
static float shaped(float height, float level, float distance, float width, bool wet)
{
    float off = wet ? level - height : height - level, beach = BEACH_SLOPE * distance;
    if (off <= beach) {
        return height;
    }
    float kept = smoothstepf(0.0f, 1.0f, distance / width);
    float shape = beach + (off - beach) * kept;
    return wet ? level - shape : level + shape;
}

// Is the sample at the shore of another lake? It may hold that one's water.
static bool holds_another(const Lakes *lakes, const HeightField *field, int64_t i, int32_t lake)
{
    int64_t columns = field->columns, column = i % columns, row = i / columns;
    for (int k = 0; k < 9; k++) {
        int64_t c = column + k % 3 - 1, r = row + k / 3 - 1;
        if (c >= 0 && r >= 0 && c < columns && r < field->rows &&
            lakes->label[r * columns + c] >= 0 && lakes->label[r * columns + c] != lake) {
            return true;
        }
    }
    return false;
}

bool terrain_shape_shores(const Terrain *terrain, HeightField *field, Error *e)
{
    TerrainLakeParams params = terrain_lake_params(terrain->params);
    const Lakes *lakes = terrain->lakes;
    int64_t count = height_field_count(field);
    Shores s = {.field = field,
                .lakes = lakes,
                .distance = memory_alloc(count, sizeof *s.distance, e),
                .lake = memory_alloc(count, sizeof *s.lake, e),
                .width = memory_alloc(lakes->count + 1, sizeof *s.width, e)};
    bool done = s.distance && s.lake && s.width;
    if (done) {
        for (int i = 0; i < lakes->count; i++) {
            s.width[i] = beach_width(&params, field, &lakes->lake[i]);
        }
        for (int64_t i = 0; i < count; i++) {
            s.distance[i] = INFINITY;
        }
        trace_shorelines(&s);
    }
    for (int64_t i = 0; done && i < count; i++) {
        int32_t lake = s.distance[i] < INFINITY ? s.lake[i] : -1, own = lakes->label[i];
        if (lake < 0 || !(s.distance[i] < s.width[lake]) || (own >= 0 && own != lake)) {
            continue;
        }
        float level = lakes->lake[lake].level;
        bool dry = field->height[i] > level && !holds_another(lakes, field, i, lake);
        if (own >= 0 || dry) {
            field->height[i] =
                shaped(field->height[i], level, s.distance[i], s.width[lake], own >= 0);
        }
    }
    free(s.distance);
    free(s.lake);
    free(s.width);
    return done;
}
