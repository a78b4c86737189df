#include "objects/terrain/lakes.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

TerrainLakeParams terrain_lake_params(const TerrainParams *params)
{
    TerrainLakeParams lakes = params->lakes;
    float size = params->size, side = 0.005f * size, widest = 0.04f * size;
    lakes.area = lakes.area > 0.0f ? lakes.area : side * side;
    lakes.depth = lakes.depth > 0.0f ? lakes.depth : 0.0001f * size;
    lakes.basin_area = lakes.basin_area > 0.0f ? lakes.basin_area : widest * widest;
    return lakes;
}

static bool has_lakes(const Terrain *terrain)
{
    return terrain->params->lakes.count > 0;
}

// ---- covering

// Raises the samples of lakes to their levels; depth: of the samples, 0 = no lake.
static void cover(const Lakes *lakes, HeightField *field, float *depth)
{
    for (int64_t i = 0; i < height_field_count(field); i++) {
        int32_t label = lakes->label[i];
        depth[i] = 0.0f;
        if (label >= 0) {
            depth[i] = lakes->lake[label].level - field->height[i];
            field->height[i] = lakes->lake[label].level;
        }
    }
}

static void forget_lakes(Terrain *terrain)
{
    lakes_free(terrain->lakes);
    free(terrain->lake_depth);
    terrain->lakes = NULL;
    terrain->lake_depth = NULL;
}

static bool find_and_cover(Terrain *terrain, HeightField *field, int count, Error *e)
{
    TerrainLakeParams own = terrain_lake_params(terrain->params);
    LakeLimits limits = {.count = count, .area = (double)own.area, .depth = (double)own.depth};
    terrain->lakes = lakes_find(field, &limits, e);
    terrain->lake_depth = memory_alloc(height_field_count(field), sizeof *terrain->lake_depth, e);
    if (!terrain->lakes || !terrain->lake_depth) {
        return false;
    }
    cover(terrain->lakes, field, terrain->lake_depth);
    return true;
}

bool terrain_cover_hollows(Terrain *terrain, HeightField *field, Error *e)
{
    return !has_lakes(terrain) || find_and_cover(terrain, field, 0, e);
}

bool terrain_find_lakes(Terrain *terrain, HeightField *field, const Run *run, Error *e)
{
    if (!has_lakes(terrain)) {
        return true;
    }
    for (int64_t i = 0; terrain->lakes && i < height_field_count(field); i++) {
        field->height[i] -= terrain->lake_depth[i];
    }
    forget_lakes(terrain);
    return terrain_dig_basins(terrain, field, run, e) &&
           find_and_cover(terrain, field, terrain->params->lakes.count, e);
}

// ---- uncovering

// Rivers have dug their beds through the cover: their mouths stay deep.
static void bring_back_beds(const Terrain *terrain, HeightField *field)
{
    const Lakes *lakes = terrain->lakes;
    for (int64_t i = 0; i < height_field_count(field); i++) {
        int32_t label = lakes->label[i];
        if (label >= 0) {
            float bed = lakes->lake[label].level - terrain->lake_depth[i];
            field->height[i] = fminf(field->height[i], bed);
        }
    }
}

// Tells the level of a lake on the land beside it too, as far as its shore may look different: for
// so many cells, up to so high above the water.
static bool record_levels(const Terrain *terrain, HeightField *field, Error *e)
{
    enum { REACH = 24 };
    const float high = 5.0f; // m
    const Lakes *lakes = terrain->lakes;
    int64_t count = height_field_count(field), columns = field->columns, rows = field->rows;
    int32_t *queue = memory_alloc(count, sizeof *queue, e);
    uint8_t *steps = memory_alloc(count, 1, e);
    field->water = memory_alloc(count, sizeof *field->water, e);
    int64_t found = 0;
    for (int64_t i = 0; queue && steps && field->water && i < count; i++) {
        bool wet = lakes->label[i] >= 0;
        field->water[i] = wet ? lakes->lake[lakes->label[i]].level : -INFINITY;
        steps[i] = 0;
        if (wet) {
            queue[found++] = (int32_t)i;
        }
    }
    for (int64_t k = 0; k < found; k++) {
        int32_t i = queue[k];
        float level = field->water[i];
        for (int d = 0; d < 9 && steps[i] < REACH; d++) {
            int64_t c = i % columns + d % 3 - 1, r = i / columns + d / 3 - 1, n = r * columns + c;
            if (c < 0 || r < 0 || c >= columns || r >= rows || field->water[n] > -INFINITY ||
                field->height[n] < level || field->height[n] > level + high) {
                continue;
            }
            field->water[n] = level;
            steps[n] = (uint8_t)(steps[i] + 1);
            queue[found++] = (int32_t)n;
        }
    }
    bool done = queue && steps && field->water;
    free(queue);
    free(steps);
    return done;
}

// Near the shore, and where the water is shallower than the mesh's error far away, every sample is
// a vertex of the land.
static bool keep_shores(Terrain *terrain, const HeightField *field, Error *e)
{
    const TerrainParams *params = terrain->params;
    int64_t count = height_field_count(field);
    float error = params->mesh_error * params->size;
    terrain->bank = terrain->bank ? terrain->bank : memory_alloc_zero(count, 1, e);
    for (int64_t i = 0; terrain->bank && i < count; i++) {
        float above = field->height[i] - field->water[i]; // INFINITY far from lakes
        bool near = above > -error && above < fminf(error, 1.5f);
        terrain->bank[i] = terrain->bank[i] || near;
    }
    return terrain->bank;
}

bool terrain_uncover_lakes(Terrain *terrain, HeightField *field, Error *e)
{
    if (!has_lakes(terrain)) {
        return true;
    }
    bring_back_beds(terrain, field);
    return terrain_shape_shores(terrain, field, e) && record_levels(terrain, field, e) &&
           keep_shores(terrain, field, e);
}

float terrain_lake_at(const Terrain *terrain, const HeightField *field, float x, float z)
{
    if (!terrain->lakes) {
        return -INFINITY;
    }
    int32_t label = terrain->lakes->label[terrain_sample_at(field, x, z)];
    return label >= 0 ? terrain->lakes->lake[label].level : -INFINITY;
}
