// Terrain as a kind of object.
#include "objects/terrain/terrain.h"
#include "scene/kinds.h"
#include "scene/spec.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void describe(const void *params, char *text, size_t size)
{
    const TerrainParams *terrain = params;
    snprintf(text, size, ", %g km, %d x %d cells", (double)terrain->size * 1e-3,
             terrain->resolution, terrain->resolution);
}

static int64_t attractors(const void *params)
{
    const TerrainParams *terrain = params;
    int64_t count = terrain->rivers.count;
    return count + count / 8;
}

static int64_t copies(const void *params)
{
    const TerrainParams *terrain = params;
    return terrain->forest.count;
}

static void needs(const void *params, Needs *needs)
{
    enum { CELL_BYTES = 200, RIVER_BYTES = 1500 };
    const TerrainParams *terrain = params;
    double rows = 2.8 * (double)(terrain->size / terrain->forest.height); // a tree each
    needs_add(needs, "resolution", (double)terrain->resolution * terrain->resolution, CELL_BYTES);
    needs_add(needs, "rivers.count", (double)attractors(params), RIVER_BYTES);
    needs_add_copies(needs, "forest.count", fmin(terrain->forest.count, rows * rows), 1e9);
}

static void settle(const void *params, void *settled)
{
    TerrainParams p = terrain_params_resolve(params);
    memcpy(settled, &p, sizeof p);
}

static const Key MATERIALS[] = {
    MATERIAL_ROW(1, "water_material", "Material of a terrain's lakes and rivers; left out: lake."),
    OWN_MATERIAL_ROW(0),
    {0},
};

const Kind kind_terrain = {
    .variant = {KIND_ROW("terrain", &terrain_table, "Mountains, valleys and rivers."), MATERIALS},
    .materials = {"mountain", "lake", "conifer"},
    .needs = needs,
    .describe = describe,
    .attractors = attractors,
    .copies = copies,
    .settle = settle,
    .grow = terrain_grow,
    .finish = terrain_finish,
    .geometry = terrain_geometry,
    .heights = terrain_heights};
