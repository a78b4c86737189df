// Terrain as a kind of object.
#include "objects/kind.h"
#include "land/height_maps.h"
#include "objects/terrain/delta.h"
#include "objects/terrain/form.h"
#include "render/material/material.h"

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
    bool ridges = terrain->form == TERRAIN_RIDGES;
    const TreeSource *source = ridges ? &terrain->ridges.source : &terrain->rivers.source;
    bool grows = ridges || terrain->form == TERRAIN_RIVERS;
    if (!grows || source->file || source->image) {
        return 0;
    }
    int64_t count = ridges ? terrain->ridges.count : terrain->rivers.count;
    return count + count / 8;
}

// The conifers: beyond the square about 0.7 of `count` in each ring from a distance from the eye to
// three times that, for they become fewer with its square.
static double conifers(const TerrainParams *terrain)
{
    return terrain->forest.count * (1.0 + log2(2.0 * terrain->forest.beyond + 1.0));
}

static int64_t copies(const void *params)
{
    return (int64_t)conifers(params);
}

static int64_t samples(const void *params)
{
    const TerrainParams *terrain = params;
    return (int64_t)(terrain->resolution + 1) * (terrain->resolution + 1);
}

static void extent(const void *params, LandExtent *extent)
{
    const TerrainParams *terrain = params;
    const float steep = 0.2f; // relief of a survey or a map, of which little is known before
    float relief = terrain->relief > 0.0f ? terrain->relief : steep * terrain->size;
    *extent = (LandExtent){.side = terrain->size, .relief = relief};
}

// The triangles of land that is drawn of tiles: as many in each ring from a distance to twice that,
// from where cells are as fine as tiles have them to the end of the land.
static double tile_faces(const TerrainParams *terrain)
{
    const double cell = 8.0 * (double)terrain->mesh_error; // share of the distance
    double samples = (double)terrain->tiles.count * terrain->tiles.cells;
    double across = 2.0 * terrain->beyond + 1.0;
    double near = (double)terrain->size / samples / cell, far = 0.5 * across * terrain->size;
    double rings = fmax(ceil(log2(far / near)), 0.0);
    double faces = rings * 2.0 * 3.0 * 3.14159265 / (cell * cell);
    // Tiles with water, about half of them at most, have the terrain's own cells.
    bool wet = terrain->lakes.count > 0 || terrain_form(terrain)->grow;
    double own = across * across * terrain->resolution * terrain->resolution;
    return fmin(faces + (wet ? own : 0.0), 2.0 * across * across * samples * samples);
}

static void needs(const void *params, Needs *needs)
{
    enum {
        CELL_BYTES = 208,
        RIVER_BYTES = 1500,
        LANDSCAPE_BYTES = 140,
        LAVA_BYTES = 90,
        KARST_BYTES = 64,
        DUNE_BYTES = 106,
        SHORE_BYTES = 48,
        BRAID_BYTES = 110,
        DELTA_BYTES = 320
    };
    const TerrainParams *terrain = params;
    double rows = 2.8 * (double)(terrain->size / terrain->forest.height); // trees per side
    double across = 2.0 * terrain->forest.beyond + 1.0;
    needs_add(needs, "resolution", (double)terrain->resolution * terrain->resolution, CELL_BYTES);
    if (terrain_evolves(terrain)) {
        double cells = terrain_evolved_cells(terrain);
        needs_add(needs, "evolution.cells", cells * cells,
                  LANDSCAPE_BYTES + (terrain->form == TERRAIN_VOLCANO ? LAVA_BYTES
                                     : terrain->form == TERRAIN_COAST ? SHORE_BYTES
                                     : terrain->form == TERRAIN_KARST ? KARST_BYTES
                                                                      : 0));
    }
    if (terrain->tiles.drawn) {
        needs_add_skin(needs, "tiles.cells", tile_faces(terrain));
    }
    if (terrain->erosion.debris > 0.0f) {
        needs_add(needs, "erosion.debris", 1.25 * WALLS_FINE_CELLS * WALLS_FINE_CELLS,
                  LANDSCAPE_BYTES);
    }
    if (terrain->form == TERRAIN_DUNES) {
        double cells = fmin(terrain->resolution, terrain->evolution.cells);
        needs_add(needs, "evolution.cells", cells * cells, DUNE_BYTES);
    }
    if (terrain->form == TERRAIN_BRAIDED) {
        double cells = fmin(terrain->resolution, terrain->evolution.cells);
        needs_add(needs, "evolution.cells", cells * cells, BRAID_BYTES);
    }
    if (terrain->form == TERRAIN_DELTA) {
        double cells = terrain_delta_cells(terrain);
        needs_add(needs, "delta.width", cells * cells, DELTA_BYTES);
    }
    if (terrain->lakes.count > 0) {
        needs_add(needs, "resolution", (double)terrain->resolution * terrain->resolution, 40);
    }
    if (terrain->form == TERRAIN_MEANDER) {
        needs_add(needs, "resolution", (double)terrain->resolution * terrain->resolution, 60);
    }
    needs_add(needs, terrain->form == TERRAIN_RIDGES ? "ridges.count" : "rivers.count",
              (double)attractors(params), RIVER_BYTES);
    needs_add_copies(needs, "forest.count", fmin(conifers(terrain), across * across * rows * rows),
                     1e9);
}

static bool tiles(const void *params, TileGrid *grid)
{
    const TerrainTileParams *own = &((const TerrainParams *)params)->tiles;
    *grid = (TileGrid){.count = own->count, .cells = own->cells, .detail = own->detail};
    return own->count > 0;
}

static void settle(const void *params, void *settled)
{
    TerrainParams p = terrain_params_resolve(params);
    memcpy(settled, &p, sizeof p);
}

// Land of beds shows them; dunes bury them.
static const char *material_for(const void *params, int role)
{
    const TerrainParams *terrain = params;
    const Form *form = terrain_form(terrain);
    if (role == TERRAIN_WATER) {
        return terrain->lakes.count > 0 ? "terrain/lake" : form->water;
    }
    if (role != TERRAIN_LAND) {
        return NULL;
    }
    if (form->material && (!form->evolve || form->shows_beds || terrain->strata.bed_count == 0)) {
        return form->material;
    }
    return form->evolve || terrain->strata.bed_count > 0 ? "terrain/strata" : NULL;
}

static const Material BUILTIN[] = {
    {.name = "mountain",
     .kind = MATERIAL_DIFFUSE,
     .color = {0.135f, 0.128f, 0.124f},
     .color2 = {0.072f, 0.070f, 0.070f},
     .roughness = 0.6f,
     .ior = 1.5f,
     .pattern = PATTERN_MOUNTAIN,
     .pattern_depth = 1.0f,
     .snow_line = 0.44f,
     .grass_line = 0.36f},
    {.name = "badlands",
     .kind = MATERIAL_DIFFUSE,
     .color = {0.315f, 0.135f, 0.075f},
     .color2 = {0.360f, 0.215f, 0.125f},
     .roughness = 0.6f,
     .ior = 1.5f,
     .pattern = PATTERN_BADLANDS,
     .pattern_depth = 1.0f},
    {.name = "terrain/alps",
     .kind = MATERIAL_DIFFUSE,
     .color = {0.190f, 0.184f, 0.177f},
     .color2 = {0.088f, 0.088f, 0.090f},
     .roughness = 0.6f,
     .ior = 1.5f,
     .pattern = PATTERN_ALPS,
     .pattern_depth = 1.8f,
     .snow_line = HEIGHT_MAP_SNOW_LINE,
     .grass_line = 0.47f},
    {.name = "terrain/volcano",
     .kind = MATERIAL_DIFFUSE,
     .color = {0.105f, 0.090f, 0.080f},
     .color2 = {0.030f, 0.029f, 0.030f},
     .roughness = 0.7f,
     .ior = 1.5f,
     .pattern = PATTERN_VOLCANO,
     .pattern_depth = 1.5f,
     .snow_line = HEIGHT_MAP_SNOW_LINE,
     .grass_line = 0.23f},
    {.name = "terrain/hills",
     .kind = MATERIAL_DIFFUSE,
     .color = {0.310f, 0.232f, 0.105f},
     .color2 = {0.082f, 0.098f, 0.030f},
     .roughness = 0.8f,
     .ior = 1.5f,
     .pattern = PATTERN_HILLS,
     .pattern_depth = 0.5f},
    {.name = "terrain/coast",
     .kind = MATERIAL_DIFFUSE,
     .color = {0.085f, 0.098f, 0.036f},
     .color2 = {0.36f, 0.30f, 0.215f},
     .roughness = 0.7f,
     .ior = 1.5f,
     .pattern = PATTERN_COAST,
     .pattern_depth = 1.0f},
    {.name = "terrain/dunes",
     .kind = MATERIAL_DIFFUSE,
     .color = {0.56f, 0.335f, 0.165f},
     .color2 = {0.24f, 0.165f, 0.105f},
     .roughness = 0.8f,
     .ior = 1.5f,
     .pattern = PATTERN_DUNES,
     .pattern_scale = 0.12f,
     .pattern_depth = 0.008f},
    {.name = "terrain/braided",
     .kind = MATERIAL_DIFFUSE,
     .color = {0.225f, 0.226f, 0.222f},
     .color2 = {0.052f, 0.064f, 0.026f},
     .roughness = 0.8f,
     .ior = 1.5f,
     .pattern = PATTERN_BRAIDED,
     .pattern_depth = 1.0f},
    {.name = "terrain/karst",
     .kind = MATERIAL_DIFFUSE,
     .color = {0.050f, 0.072f, 0.024f},
     .color2 = {0.115f, 0.125f, 0.040f},
     .roughness = 0.8f,
     .ior = 1.5f,
     .pattern = PATTERN_KARST,
     .pattern_depth = 1.0f},
    {.name = "terrain/glacial",
     .kind = MATERIAL_PRINCIPLED,
     .color = {0.165f, 0.215f, 0.210f},
     .color2 = {0.130f, 0.128f, 0.118f},
     .roughness = 0.12f,
     .specular = 0.5f,
     .ior = 1.33f,
     .pattern = PATTERN_GLACIAL,
     .pattern_depth = 0.04f},
    {.name = "terrain/floodplain",
     .kind = MATERIAL_DIFFUSE,
     .color = {0.42f, 0.355f, 0.255f},
     .color2 = {0.066f, 0.077f, 0.032f},
     .roughness = 0.8f,
     .ior = 1.5f,
     .pattern = PATTERN_FLOODPLAIN,
     .pattern_depth = 1.0f},
    {.name = "terrain/river",
     .kind = MATERIAL_PRINCIPLED,
     .color = {0.050f, 0.050f, 0.027f},
     .color2 = {0.190f, 0.150f, 0.090f},
     .roughness = 0.10f,
     .specular = 0.25f,
     .ior = 1.33f,
     .pattern = PATTERN_RIVER,
     .pattern_depth = 0.02f},
    {.name = "terrain/delta",
     .kind = MATERIAL_DIFFUSE,
     .color = {0.140f, 0.113f, 0.074f},
     .color2 = {0.060f, 0.076f, 0.026f},
     .roughness = 0.8f,
     .ior = 1.5f,
     .pattern = PATTERN_DELTA,
     .pattern_depth = 1.0f},
    {.name = "terrain/silt",
     .kind = MATERIAL_PRINCIPLED,
     .color = {0.016f, 0.045f, 0.050f},
     .color2 = {0.128f, 0.107f, 0.062f},
     .roughness = 0.12f,
     .specular = 0.25f,
     .ior = 1.33f,
     .pattern = PATTERN_SILT,
     .pattern_depth = 0.015f},
    {.name = "terrain/strata",
     .kind = MATERIAL_DIFFUSE,
     .color = {0.40f, 0.29f, 0.19f},
     .color2 = {0.075f, 0.083f, 0.046f},
     .roughness = 0.7f,
     .ior = 1.5f,
     .pattern = PATTERN_STRATA,
     .pattern_depth = 3.0f},
    {.name = "terrain/lake",
     .kind = MATERIAL_WATER,
     .color = {1.0f, 1.0f, 1.0f},
     .color2 = {0.72f, 0.75f, 0.76f},
     .absorption = {0.36f, 0.065f, 0.075f},
     .scattering = {0.06f, 0.09f, 0.09f},
     .anisotropy = 0.75f,
     .ior = 1.33f,
     .calm = 0.5f,
     .pattern = PATTERN_WATER,
     .pattern_depth = 0.004f},
    {.name = "lake",
     .kind = MATERIAL_PRINCIPLED,
     .color = {0.012f, 0.030f, 0.034f},
     .color2 = {0.72f, 0.75f, 0.76f},
     .roughness = 0.08f,
     .specular = 0.28f,
     .ior = 1.33f,
     .pattern = PATTERN_WATER,
     .pattern_depth = 0.012f},
    {.name = "conifer",
     .kind = MATERIAL_DIFFUSE,
     .color = {0.026f, 0.042f, 0.017f},
     .color2 = {0.1f, 0.1f, 0.1f},
     .roughness = 0.8f,
     .ior = 1.5f,
     .variation = 0.7f},
    {.name = "altitude",
     .kind = MATERIAL_DIFFUSE,
     .color = {0.10f, 0.13f, 0.16f},
     .roughness = 0.6f,
     .ior = 1.5f,
     .pattern = PATTERN_ALTITUDE,
     .colors = terrain_altitudes,
     .color_count = TERRAIN_ALTITUDES},
    {.name = ""},
};

static const Key MATERIALS[] = {
    WATER_MATERIAL_ROW(1),
    MATERIAL_ROW(3, "tree_material",
                 "Material of the lines of a terrain's tree (show: tree); default: node."),
    OWN_MATERIAL_ROW(0),
    {0},
};

const Kind kind_terrain = {
    .variant = {KIND_ROW("terrain", &terrain_table, "Mountains, valleys and rivers."), MATERIALS},
    .materials = {"mountain", "lake", "conifer", "node"},
    .material_for = material_for,
    .builtin = BUILTIN,
    .needs = needs,
    .samples = samples,
    .extent = extent,
    .describe = describe,
    .attractors = attractors,
    .copies = copies,
    .settle = settle,
    .grow = terrain_grow,
    .finish = terrain_finish,
    .geometry = terrain_geometry,
    .measure = terrain_measure,
    .heights = terrain_heights,
    .surface_copies = terrain_surface_copies,
    .tiles = tiles,
    .sprays = true};
