#include "objects/terrain/terrain.h"

#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "land/height_drainage.h"
#include "objects/terrain/internal.h"
#include "objects/terrain/noise.h"

#include <stdlib.h>
#include <string.h>

TerrainParams terrain_params_default(void)
{
    return (TerrainParams){
        .size = 12000.0f,
        .resolution = 1024,
        .uplift = {.base = 1.0f, .noise = 0.4f},
        .rivers = {.outlets = 7,
                   .count = 2500,
                   .winding = 0.4f,
                   .gradient = 0.6f,
                   .concavity = 0.42f,
                   .valley = 0.03f,
                   .water = 0.0025f,
                   .field_weight = 1.0f},
        .noise = {.iterations = 6, .amplitude = 0.11f, .gain = 0.5f, .ridged = 0.7f, .warp = 0.35f},
        .erosion = {.talus = 38.0f},
        .forest = {.height = 28.0f, .low = 0.02f, .high = 0.4f, .slope = 36.0f, .clumping = 0.7f},
        .mesh_error = 0.0006f};
}

TerrainParams terrain_params_resolve(const TerrainParams *params)
{
    TerrainParams resolved = *params;
    if (resolved.noise.wavelength == 0.0f) {
        resolved.noise.wavelength = 6.0f / sqrtf((float)params->rivers.count); // brooks
    }
    return resolved;
}

// Displacement of places by the noise, m.
static float warp_reach(const TerrainParams *params);

// Wavelength of the noise's first octave, m.
static float noise_wavelength(const TerrainParams *params)
{
    return terrain_params_resolve(params).noise.wavelength * params->size;
}

static float warp_reach(const TerrainParams *params)
{
    return params->noise.iterations > 0 ? params->noise.warp * noise_wavelength(params) : 0.0f;
}

// The envelope of all troughs. flat: envelope of distances, with each river at height 0.
static TroughEnvelope *make_envelope(const Terrain *terrain, bool flat, const Run *run, Error *e)
{
    const OutTree *tree = terrain->rivers;
    Trough *trough = memory_alloc(tree->count, sizeof *trough, e);
    if (!trough) {
        return NULL;
    }
    for (int64_t i = 0; i < tree->count; i++) {
        trough[i] = terrain_trough(terrain, i, terrain->gradient);
        if (flat) {
            trough[i].h0 = trough[i].slope = trough[i].width = 0.0f;
            trough[i].gradient = 1.0f;
        }
    }
    TroughEnvelope *envelope = trough_envelope_new(trough, tree->count, terrain->params->size,
                                                   warp_reach(terrain->params), run, e);
    free(trough);
    return envelope;
}

enum { PEAK_SAMPLES = 256 };

// The highest point of the envelope, on a grid of fixed size.
static float envelope_peak(const TroughEnvelope *envelope, float size)
{
    float peak = 0.0f;
    int32_t lowest;
    for (int i = 0; i < PEAK_SAMPLES * PEAK_SAMPLES; i++) {
        float x = ((float)(i % PEAK_SAMPLES) + 0.5f) / PEAK_SAMPLES - 0.5f;
        int row = i / PEAK_SAMPLES;
        float z = ((float)row + 0.5f) / PEAK_SAMPLES - 0.5f;
        float h = trough_envelope_at(envelope, x * size, z * size, &lowest);
        peak = h > peak ? h : peak;
    }
    return peak;
}

// Present heights are those of gradient 1. Heights are linear in the gradient, so one factor scales
// the highest point to the wanted relief.
static bool scale_heights(Terrain *terrain, const Run *run, Error *e)
{
    const float natural = 0.65f; // tan(33 degrees): slopes of loose rock
    terrain->gradient = 1.0f;
    if (terrain->params->relief > 0.0f) {
        TroughEnvelope *unit = make_envelope(terrain, false, run, e);
        if (!unit) {
            return false;
        }
        float peak = envelope_peak(unit, terrain->params->size);
        trough_envelope_free(unit);
        terrain->gradient = peak > 0.0f ? terrain->params->relief / peak : natural;
    } else {
        terrain->gradient = natural;
    }
    for (int64_t i = 0; i < terrain->rivers->count; i++) {
        terrain->rivers->position[i].y *= terrain->gradient;
    }
    return true;
}

static bool fill_rivers(Terrain *terrain, const Run *run, Error *e)
{
    enum { MOST_PASSES = 6 }; // captures change areas, areas change heights
    if (!terrain_uplift(terrain, run, e)) {
        return false;
    }
    int64_t captures = 1;
    for (int pass = 0; pass < MOST_PASSES && captures > 0; pass++) {
        if (!terrain_profile(terrain, run, &captures, e)) {
            return false;
        }
    }
    OutTree *tree = terrain->rivers; // sorted by terrain_profile
    if (!scale_heights(terrain, run, e)) {
        return false;
    }
    for (int64_t i = 0; i < tree->count; i++) {
        tree->radius[i] = terrain->params->rivers.water * sqrtf(terrain->area[i]);
    }
    return true;
}

static void forget(Terrain *terrain)
{
    trough_envelope_free(terrain->land);
    trough_envelope_free(terrain->distance);
    out_tree_free(terrain->water);
    trough_envelope_free(terrain->shore);
    free(terrain->bank);
    terrain->land = terrain->distance = terrain->shore = NULL;
    terrain->water = NULL;
    terrain->bank = NULL;
}

static void free_terrain(void *state)
{
    Terrain *terrain = state;
    forget(terrain);
    free(terrain->area);
    free(terrain->uplift);
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
    *terrain = (Terrain){.params = params, .seed = recipe->seed, .rivers = grown->tree};
    terrain->area = memory_alloc(grown->tree->count, sizeof *terrain->area, e);
    terrain->uplift = memory_alloc(grown->tree->count, sizeof *terrain->uplift, e);
    bool done = terrain->area && terrain->uplift && fill_rivers(terrain, recipe->run, e);
    grown->tree = terrain->rivers;
    return done;
}

// ---- heights

// The land's height and wetness at a place.
static float land_at(const Terrain *terrain, float x, float z, float *wetness)
{
    const TerrainParams *params = terrain->params;
    const TerrainNoiseParams *noise = &params->noise;
    int32_t lowest = 0, nearest = 0;
    float away = trough_envelope_at(terrain->distance, x, z, &nearest);
    float height, wavelength = noise_wavelength(params);
    float u = x / wavelength, v = z / wavelength;
    if (noise->iterations > 0) {
        // No displacement at a river: the noise fades over half a wavelength.
        float fade = smoothstepf(0.0f, 0.5f * wavelength, away);
        float reach = 0.4f * warp_reach(params) * fade;
        float push_x = sparse_noise_fractal(0.5f * u, 0.5f * v, 2, 0.5f, 0.0f,
                                            random_key(terrain->seed, STREAM_WARP_X));
        float push_z = sparse_noise_fractal(0.5f * u, 0.5f * v, 2, 0.5f, 0.0f,
                                            random_key(terrain->seed, STREAM_WARP_Z));
        push_x = clampf(push_x, -2.0f, 2.0f);
        push_z = clampf(push_z, -2.0f, 2.0f);
        height = trough_envelope_at(terrain->land, x + reach * push_x, z + reach * push_z, &lowest);
        float up = terrain->uplift[lowest] * terrain->gradient;
        float n = sparse_noise_fractal(u, v, noise->iterations, noise->gain, noise->ridged,
                                       random_key(terrain->seed, STREAM_NOISE));
        height += n * noise->amplitude * wavelength * fade * (up < 1.5f ? up : 1.5f);
    } else {
        height = trough_envelope_at(terrain->land, x, z, &lowest);
    }
    float valley = 1.5f * terrain_valley(params, terrain->area[nearest]) + 0.002f * params->size;
    *wetness = 1.0f - smoothstepf(0.0f, 1.0f, away / valley);
    return height;
}

static bool sample_land(const Terrain *terrain, HeightField *field, const Run *run)
{
#pragma omp parallel for schedule(dynamic, 4) num_threads(run->threads)
    for (int row = 0; row < field->rows; row++) {
        if (run_is_cancelled(run)) {
            continue;
        }
        for (int column = 0; column < field->columns; column++) {
            int64_t i = (int64_t)row * field->columns + column;
            float x = field->origin.x + (float)column * field->cell.x;
            float z = field->origin.y + (float)row * field->cell.y;
            field->height[i] = land_at(terrain, x, z, &field->wetness[i]);
        }
    }
    return !run_is_cancelled(run);
}

// Makes hard beds stand out as steps: flat at first, then steep. Heights stay monotonic, so
// drainage is unchanged.
static void make_terraces(HeightField *field, const TerrainTerraceParams *terraces, uint64_t seed)
{
    float low, high;
    height_field_range(field, &low, &high);
    float bed = (high - low) / (float)(terraces->count > 0 ? terraces->count : 1);
    if (terraces->count <= 0 || !(bed > 0.0f)) {
        return;
    }
    for (int64_t i = 0; i < height_field_count(field); i++) {
        float t = (field->height[i] - low) / bed;
        int number = (int)t;
        float share = t - (float)number;
        float hard = random_range(random_key(seed, (uint64_t)number), 0.4f, 1.0f);
        float cliff = share * share * share * (share * (6.0f * share - 15.0f) + 10.0f);
        cliff = smoothstepf(0.0f, 1.0f, cliff);
        share = lerpf(share, cliff, 0.92f * hard * terraces->strength);
        field->height[i] = low + bed * ((float)number + share);
    }
}

// ---- rivers on the grid

// Lowers samples under a river where noise or erosion left sills: no sample along the line from
// each node to its parent is above the river's height there.
static void carve_piece(HeightField *field, Vec3 from, Vec3 to)
{
    float dx = to.x - from.x, dz = to.z - from.z;
    float length = sqrtf(dx * dx + dz * dz);
    int steps = 1 + (int)(2.0f * length / field->cell.x);
    for (int k = 0; k <= steps; k++) {
        float t = (float)k / (float)steps;
        float u = (from.x + t * dx - field->origin.x) / field->cell.x;
        float v = (from.z + t * dz - field->origin.y) / field->cell.y;
        int column = (int)(u + 0.5f), row = (int)(v + 0.5f);
        if (u < -0.5f || v < -0.5f || column >= field->columns || row >= field->rows) {
            continue;
        }
        float *height = &field->height[(int64_t)row * field->columns + column];
        float river = lerpf(from.y, to.y, t);
        *height = *height < river ? *height : river;
    }
}

static void carve_rivers(HeightField *field, const OutTree *rivers)
{
    for (int64_t i = 0; i < rivers->count; i++) {
        if (rivers->parent[i] >= 0) {
            carve_piece(field, rivers->position[i], rivers->position[rivers->parent[i]]);
        }
    }
}

static bool finish_field(Terrain *terrain, HeightField *field, const Run *run, Error *e)
{
    const TerrainParams *params = terrain->params;
    if (!terrain_erode(field, &params->erosion, run, e)) {
        return false;
    }
    carve_rivers(field, terrain->rivers);
    if (!height_field_fill(field, 1e-5f, e)) {
        return false;
    }
    make_terraces(field, &params->terraces, random_key(terrain->seed, STREAM_TERRACES));
    return (params->terraces.count <= 0 || height_field_fill(field, 0.0f, e)) &&
           terrain_lay_rivers(terrain, field, run, e); // on the final land
}

HeightField *terrain_heights(const void *given, const Grown *grown, const Run *run, Error *e)
{
    const TerrainParams *params = given;
    Terrain *terrain = grown->state;
    float cell = params->size / (float)params->resolution, corner = -0.5f * params->size;
    forget(terrain);
    terrain->land = make_envelope(terrain, false, run, e);
    terrain->distance = terrain->land ? make_envelope(terrain, true, run, e) : NULL;
    HeightField *field = NULL;
    if (terrain->distance) {
        field = height_field_new(params->resolution + 1, params->resolution + 1, (Vec2){cell, cell},
                                 (Vec2){corner, corner}, e);
    }
    if (!field) {
        return NULL;
    }
    run_progress(run, "heights", 0.0);
    field->wetness = memory_alloc_zero(height_field_count(field), sizeof(float), e);
    if (!field->wetness || !(sample_land(terrain, field, run) || run_cancel_error(e)) ||
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
