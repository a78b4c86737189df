// Terrain as a kind of object.
#include "objects/terrain/terrain.h"
#include "scene/kinds.h"
#include "scene/spec.h"

#include "base/memory.h"
#include "image/image.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The parameters with the uplift's picture read in.
typedef struct LoadedTerrain {
    TerrainParams params;
    Image *image; // grey; NULL = none
} LoadedTerrain;

static bool load(const TerrainParams *given, LoadedTerrain *loaded, Error *e)
{
    *loaded = (LoadedTerrain){.params = *given};
    if (!given->uplift.image) {
        return true;
    }
    loaded->image = image_read(given->uplift.image, e);
    if (!loaded->image) {
        return error_key(e, "uplift.image");
    }
    Image *image = loaded->image;
    int64_t count = (int64_t)image->width * image->height;
    int colours = image->channels < 3 ? 1 : 3;
    for (int64_t i = 0; i < count; i++) { // in place: the grey ones lie before those still to read
        float sum = 0.0f;
        for (int c = 0; c < colours; c++) {
            sum += image->pixel[i * image->channels + c];
        }
        image->pixel[i] = sum / (float)colours;
    }
    loaded->params.uplift.image_pixels = image->pixel;
    loaded->params.uplift.image_size[0] = image->width;
    loaded->params.uplift.image_size[1] = image->height;
    return true;
}

static OutTree *grow(const void *params, const Recipe *recipe, Error *e)
{
    LoadedTerrain loaded;
    OutTree *tree = load(params, &loaded, e) ? terrain_grow(&loaded.params, recipe, e) : NULL;
    image_free(loaded.image);
    return tree;
}

static bool place(const Placing *p, const OutTree *tree, Error *e)
{
    TerrainMaterials materials = {.land = placing_material(p, 0),
                                  .water = placing_material(p, 1),
                                  .foliage = placing_material(p, 2)};
    LoadedTerrain loaded;
    bool done = load(p->object->params, &loaded, e) &&
                terrain_geometry(&loaded.params, tree, &materials, &p->world->camera.position,
                                 p->index, &p->world->geometry, &p->recipe, e);
    image_free(loaded.image);
    return done;
}

static HeightField *heights(const void *params, const OutTree *tree, const Recipe *recipe, Error *e)
{
    LoadedTerrain loaded;
    HeightField *field =
        load(params, &loaded, e) ? terrain_heights(&loaded.params, tree, recipe, e) : NULL;
    image_free(loaded.image);
    return field;
}

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
    .grow = grow,
    .needs = needs,
    .place = place,
    .heights = heights,
    .describe = describe,
    .attractors = attractors,
    .copies = copies,
    .settle = settle};
