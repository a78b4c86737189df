#include "objects/terrain/terrain.h"

#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"
#include "objects/terrain/delta.h"
#include "objects/terrain/form.h"
#include "objects/terrain/lakes.h"

#include <stdlib.h>

bool terrain_evolves(const TerrainParams *params)
{
    return terrain_form(params)->evolve;
}

int terrain_evolved_cells(const TerrainParams *params)
{
    const Form *form = terrain_form(params);
    int most =
        params->evolution.cells < params->resolution ? params->evolution.cells : params->resolution;
    return form->cells ? form->cells(params) : most;
}

bool terrain_holds_lakes(const TerrainParams *params)
{
    const Form *form = terrain_form(params);
    return !form->water && form->repeat == REPEAT_MIRRORED;
}

bool terrain_can_be_tiled(const TerrainParams *params)
{
    return params->show == SHOW_LAND;
}

bool terrain_tiles_end(const TerrainParams *params)
{
    const Form *form = terrain_form(params);
    bool square = form->repeat == REPEAT_MIRRORED || form->repeat == REPEAT_PERIODIC;
    return !square || form->water || form->beyond;
}

bool terrain_grow(const void *given, const Recipe *recipe, Grown *whole, Error *e)
{
    const TerrainParams *params = given;
    const Form *form = terrain_form(params);
    if (form->grow) {
        return form->grow(&whole->tree, params, recipe, e);
    }
    whole->tree = out_tree_new(e);
    return whole->tree;
}

static void forget(Terrain *terrain)
{
    height_field_free(terrain->map);
    ridge_lift_free(terrain->lift);
    trough_envelope_free(terrain->land);
    trough_envelope_free(terrain->distance);
    out_tree_free(terrain->water);
    free(terrain->drop);
    free(terrain->flow);
    trough_envelope_free(terrain->shore);
    free(terrain->bank);
    lakes_free(terrain->lakes);
    free(terrain->lake_depth);
    landscape_free(terrain->evolved);
    height_field_free(terrain->ground);
    dunes_free(terrain->dunes);
    braid_free(terrain->braid);
    braid_level_free(terrain->level);
    free(terrain->lines);
    height_field_free(terrain->sides);
    meander_free(terrain->meander);
    delta_land_free(terrain->delta);
    height_field_free(terrain->plain);
    terrain->meander = NULL;
    terrain->delta = NULL;
    terrain->plain = NULL;
    terrain->braid = NULL;
    terrain->level = NULL;
    terrain->lines = NULL;
    terrain->sides = NULL;
    terrain->evolved = NULL;
    terrain->ground = NULL;
    terrain->dunes = NULL;
    terrain->map = NULL;
    terrain->lift = NULL;
    terrain->land = terrain->distance = terrain->shore = NULL;
    terrain->water = NULL;
    terrain->drop = NULL;
    terrain->flow = NULL;
    terrain->bank = NULL;
    terrain->lakes = NULL;
    terrain->lake_depth = NULL;
}

static void free_terrain(void *state)
{
    Terrain *terrain = state;
    forget(terrain);
    free(terrain->area);
    free(terrain->uplift);
    strata_free(terrain->strata);
    free(terrain);
}

bool terrain_finish(const void *params, const Recipe *recipe, const Grown *whole, Grown *grown,
                    Error *e)
{
    (void)whole;
    Terrain *terrain = memory_alloc_zero(1, sizeof *terrain, e);
    if (!terrain) {
        return false;
    }
    grown->state = terrain;
    grown->free_state = free_terrain;
    *terrain = (Terrain){.params = params, .seed = recipe->seed, .tree = grown->tree};
    const Form *form = terrain_form(terrain->params);
    bool done = terrain_lay_beds(terrain->params, &terrain->strata, e) &&
                (!form->finish_tree || form->finish_tree(terrain, recipe->run, e));
    grown->tree = terrain->tree;
    return done;
}

static void sample_part(const Terrain *terrain, const Form *form, HeightField *field, int row,
                        int first)
{
    float x[FORM_MOST_SAMPLES], z = field->origin.y + (float)row * field->cell.y;
    int left = field->columns - first, count = left < FORM_MOST_SAMPLES ? left : FORM_MOST_SAMPLES;
    int64_t i = (int64_t)row * field->columns + first;
    for (int k = 0; k < count; k++) {
        x[k] = field->origin.x + (float)(first + k) * field->cell.x;
    }
    if (form->sample_part) {
        form->sample_part(terrain, field, i, x, z, count);
        return;
    }
    for (int k = 0; k < count; k++) {
        form->sample(terrain, field, i + k, x[k], z);
    }
}

static bool sample_land(const Terrain *terrain, HeightField *field, const Run *run)
{
    const Form *form = terrain_form(terrain->params);
#pragma omp parallel for schedule(dynamic, 4) num_threads(run->threads)
    for (int row = 0; row < field->rows; row++) {
        if (run_is_cancelled(run)) {
            continue;
        }
        for (int first = 0; first < field->columns; first += FORM_MOST_SAMPLES) {
            sample_part(terrain, form, field, row, first);
        }
    }
    return !run_is_cancelled(run);
}

// Rise over a cell, per sample; the caller frees the array.
static float *find_rises(const HeightField *field, Error *e)
{
    float *rise = memory_alloc(height_field_count(field), sizeof *rise, e);
    for (int64_t i = 0; rise && i < height_field_count(field); i++) {
        int64_t column = i % field->columns, row = i / field->columns;
        int64_t west = column > 0 ? i - 1 : i, east = column + 1 < field->columns ? i + 1 : i;
        int64_t north = row > 0 ? i - field->columns : i;
        int64_t south = row + 1 < field->rows ? i + field->columns : i;
        float dx = (field->height[east] - field->height[west]) / (float)(east - west);
        int64_t rows = (south - north) / field->columns;
        float dz = (field->height[south] - field->height[north]) / (float)rows;
        rise[i] = sqrtf(dx * dx + dz * dz);
    }
    return rise;
}

// The share of a bed's height that is left at a place where the land would have this share: a
// slope, or as far as it is sheer a wall in three tiers, ragged along its length. rise: over a
// cell, of the land, relative to the bed's height; at: the place, in cells.
static float cliff_of(float share, float rise, float sheer, Vec2 at, uint64_t seed)
{
    enum { TIERS = 3 };
    const float ledge = 1.4f, ragged = 5.0f, wavelength = 14.0f; // cells
    float slope = share * share * share * (share * (6.0f * share - 15.0f) + 10.0f);
    slope = smoothstepf(0.0f, 1.0f, slope);
    if (sheer <= 0.0f) {
        return slope;
    }
    float half = clampf(rise, 1e-4f, 0.5f), wall = 0.0f;
    for (int tier = 0; tier < TIERS; tier++) {
        float own = noise_plane_fractal(at.x / wavelength, at.y / wavelength, 4,
                                        random_key(seed, (uint64_t)tier / 2));
        float moved = rise * (ragged * own + ledge * (float)(tier - 1));
        wall += smoothstepf(0.5f - half, 0.5f + half, share + moved) / TIERS;
    }
    return lerpf(slope, wall, sheer);
}

// Makes hard beds stand out as steps: flat at first, then steep. Heights stay monotonic, so
// drainage is unchanged, but for cliffs on uneven ground.
static bool make_terraces(HeightField *field, const TerrainTerraceParams *terraces, uint64_t seed,
                          Error *e)
{
    float low, high;
    height_field_range(field, &low, &high);
    float bed = (high - low) / (float)(terraces->count > 0 ? terraces->count : 1);
    if (terraces->count <= 0 || !(bed > 0.0f)) {
        return true;
    }
    float *rise = terraces->sheer > 0.0f ? find_rises(field, e) : NULL;
    if (terraces->sheer > 0.0f && !rise) {
        return false;
    }
    for (int64_t i = 0; i < height_field_count(field); i++) {
        float t = (field->height[i] - low) / bed;
        int number = (int)t;
        float share = t - (float)number;
        float hard = random_range(random_key(seed, (uint64_t)number), 0.4f, 1.0f);
        int64_t column = i % field->columns, row = i / field->columns;
        Vec2 at = {(float)column, (float)row};
        float cliff = cliff_of(share, rise ? rise[i] / bed : 0.0f, terraces->sheer, at, seed);
        share = lerpf(share, cliff, 0.92f * hard * terraces->strength);
        field->height[i] = low + bed * ((float)number + share);
    }
    free(rise);
    return true;
}

// Rock breaks along its joints when all has been worn, and before water is laid on it.
static bool break_rock(const Terrain *terrain, HeightField *field, const Run *run, Error *e)
{
    JointingParams joints = terrain->params->joints;
    joints.seed = random_key(terrain->seed, STREAM_BLOCKS);
    return joints.spacing <= 0.0f || jointing_break(field, &joints, terrain->strata, run, e);
}

static bool finish_field(Terrain *terrain, HeightField *field, const Run *run, Error *e)
{
    const TerrainParams *params = terrain->params;
    const Form *form = terrain_form(params);
    if (!terrain_erode(field, &params->erosion, run, e) ||
        !terrain_carve_walls(terrain, field, run, e) || !break_rock(terrain, field, run, e) ||
        (form->hollows && !terrain_cover_hollows(terrain, field, e)) ||
        (form->drain && !form->drain(terrain, field, run, e))) {
        return false;
    }
    uint64_t seed = random_key(terrain->seed, STREAM_TERRACES);
    return make_terraces(field, &params->terraces, seed, e) &&
           terrain_find_lakes(terrain, field, run, e) &&
           (!form->finish || form->finish(terrain, field, run, e)) &&
           terrain_uncover_lakes(terrain, field, e) && terrain_record_water(terrain, field, run, e);
}

HeightField *terrain_heights(const void *given, const Grown *grown, const Run *run, Error *e)
{
    const TerrainParams *params = given;
    Terrain *terrain = grown->state;
    float cell = params->size / (float)params->resolution, corner = -0.5f * params->size;
    forget(terrain);
    const Form *form = terrain_form(params);
    HeightField *field = NULL;
    bool evolved = !form->evolve || (terrain->evolved = form->evolve(terrain, run, e));
    if (evolved && (!form->prepare || form->prepare(terrain, run, e))) {
        field = height_field_new(params->resolution + 1, params->resolution + 1, (Vec2){cell, cell},
                                 (Vec2){corner, corner}, e);
    }
    if (!field) {
        return NULL;
    }
    run_progress(run, "heights", 0.0);
    field->wetness = memory_alloc_zero(height_field_count(field), sizeof(float), e);
    bool placed =
        params->form != TERRAIN_SURVEY || height_field_take_place(field, terrain->map, 0.0, 0.0, e);
    if (!placed || !field->wetness || (form->record && !form->record(field, e)) ||
        !(sample_land(terrain, field, run) || run_cancel_error(e)) ||
        !finish_field(terrain, field, run, e)) {
        height_field_free(field);
        return NULL;
    }
    return field;
}

float terrain_water_height(const TerrainParams *params, const HeightField *field)
{
    float low, high;
    height_field_range(field, &low, &high);
    return low + params->water_level * (high - low);
}
