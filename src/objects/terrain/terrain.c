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
        .ridges = {.source = {.scale = 1.0f},
                   .extent = {0.8f, 0.8f},
                   .count = 900,
                   .winding = 0.4f,
                   .field_weight = 1.0f,
                   .width = 0.12f},
        .rivers = {.source = {.scale = 1.0f},
                   .outlets = 7,
                   .count = 2500,
                   .winding = 0.4f,
                   .gradient = 0.6f,
                   .concavity = 0.42f,
                   .valley = 0.03f,
                   .water = 0.0025f,
                   .field_weight = 1.0f},
        .survey = {.band = 1, .exaggeration = 1.0f},
        .noise = {.iterations = 6, .amplitude = 0.11f, .gain = 0.5f, .ridged = 0.7f, .warp = 0.35f},
        .erosion = {.talus = 38.0f},
        .forest = {.height = 28.0f, .low = 0.02f, .high = 0.4f, .slope = 36.0f, .clumping = 0.7f},
        .canyon = {.sinuosity = 1.35f, .meander = 0.42f, .river = 70.0f, .side_canyons = 1.0f},
        .mesas = {.streams = 6, .remaining = 0.12f},
        .alps = {.ice = 1.0f, .ice_line = 0.4f, .outlets = 5, .wind = 270.0f},
        .volcano = {.flows = 16, .cones = 5, .wind = 270.0f, .age = 0.15f},
        .hills = {.outlets = 4},
        .dunes = {.kind = DUNE_TRANSVERSE, .wind = 270.0f, .spread = 120.0f, .age = 1.0f},
        .evolution = {.streams = 1.0f,
                      .weathering = 1.0f,
                      .rubble = 0.25f,
                      .repose = 34.0f,
                      .deposition = 1.0f,
                      .soil = 1.0f,
                      .cells = 1024},
        .mesh_error = 0.0006f};
}

// Of landforms, as a share of the size.
static float own_relief(TerrainForm form)
{
    switch (form) {
    case TERRAIN_CANYON:
        return 0.09f;
    case TERRAIN_ALPS:
        return 0.16f;
    case TERRAIN_VOLCANO:
        return 0.13f;
    default:
        return 0.04f;
    }
}

TerrainParams terrain_params_resolve(const TerrainParams *params)
{
    TerrainParams resolved = *params;
    if (resolved.noise.wavelength == 0.0f) {
        switch (params->form) {
        case TERRAIN_RIVERS: // brooks
            resolved.noise.wavelength = 6.0f / sqrtf((float)params->rivers.count);
            break;
        case TERRAIN_RIDGES: // spurs
            resolved.noise.wavelength = 3.0f / sqrtf((float)params->ridges.count);
            break;
        case TERRAIN_MAP:
        case TERRAIN_NOISE:
        case TERRAIN_CANYON:
        case TERRAIN_MESAS:
        case TERRAIN_ALPS:
        case TERRAIN_VOLCANO:
        case TERRAIN_DUNES:
        case TERRAIN_HILLS:
            resolved.noise.wavelength = 0.125f;
            break;
        case TERRAIN_SURVEY: // two cells of the raster
            break;
        }
    }
    if (params->form == TERRAIN_DUNES) {
        static const float depth[] = {[DUNE_BARCHAN] = 0.02f,
                                      [DUNE_TRANSVERSE] = 0.07f,
                                      [DUNE_LINEAR] = 0.08f,
                                      [DUNE_STAR] = 0.12f};
        DuneParams *dunes = &resolved.dunes;
        dunes->spacing = dunes->spacing > 0.0f ? dunes->spacing : 0.25f * params->size;
        dunes->sand = dunes->sand > 0.0f ? dunes->sand : depth[dunes->kind] * dunes->spacing;
    }
    if (terrain_evolves(params)) {
        resolved.relief =
            params->relief > 0.0f ? params->relief : params->size * own_relief(params->form);
        resolved.hills.spacing =
            params->hills.spacing > 0.0f ? params->hills.spacing : 0.1f * params->size;
        resolved.volcano.crater =
            params->volcano.crater > 0.0f ? params->volcano.crater : 0.26f * resolved.relief;
        resolved.canyon.width =
            params->canyon.width > 0.0f ? params->canyon.width : 6.0f * resolved.relief;
        resolved.strata.top = params->strata.top != 0.0f ? params->strata.top : resolved.relief;
    }
    return resolved;
}

// Wavelength of the noise's first octave, m.
static float noise_wavelength(const TerrainParams *params)
{
    return terrain_params_resolve(params).noise.wavelength * params->size;
}

// Displacement of places by the noise, m.
static float warp_reach(const TerrainParams *params)
{
    return params->noise.iterations > 0 ? params->noise.warp * noise_wavelength(params) : 0.0f;
}

// The envelope of all troughs. flat: envelope of distances, with each river at height 0.
static TroughEnvelope *make_envelope(const Terrain *terrain, bool flat, const Run *run, Error *e)
{
    const OutTree *tree = terrain->tree;
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
    for (int64_t i = 0; i < terrain->tree->count; i++) {
        terrain->tree->position[i].y *= terrain->gradient;
    }
    return true;
}

bool terrain_grow(const void *given, const Recipe *recipe, Grown *whole, Error *e)
{
    const TerrainParams *params = given;
    switch (params->form) {
    case TERRAIN_RIVERS:
        return terrain_grow_rivers(&whole->tree, params, recipe, e);
    case TERRAIN_RIDGES:
        return terrain_grow_ridges(&whole->tree, params, recipe, e);
    case TERRAIN_SURVEY:
        return terrain_find_rivers(&whole->tree, params, recipe, e);
    case TERRAIN_CANYON:
    case TERRAIN_MESAS:
        return terrain_grow_courses(&whole->tree, params, recipe, e);
    case TERRAIN_MAP:
    case TERRAIN_NOISE:
    case TERRAIN_ALPS:
    case TERRAIN_VOLCANO:
    case TERRAIN_DUNES:
    case TERRAIN_HILLS:
        whole->tree = out_tree_new(e);
    }
    return whole->tree;
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
    OutTree *tree = terrain->tree; // sorted by terrain_profile
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
    height_field_free(terrain->map);
    ridge_lift_free(terrain->lift);
    trough_envelope_free(terrain->land);
    trough_envelope_free(terrain->distance);
    out_tree_free(terrain->water);
    trough_envelope_free(terrain->shore);
    free(terrain->bank);
    landscape_free(terrain->evolved);
    height_field_free(terrain->ground);
    dunes_free(terrain->dunes);
    terrain->evolved = NULL;
    terrain->ground = NULL;
    terrain->dunes = NULL;
    terrain->map = NULL;
    terrain->lift = NULL;
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
    strata_free(terrain->strata);
    free(terrain);
}

// The rivers' heights, and areas that tell a river's main stem.
static bool fill_courses(Terrain *terrain, Error *e)
{
    OutTree *tree = terrain->tree;
    terrain->area = memory_alloc(tree->count, sizeof *terrain->area, e);
    for (int64_t i = 0; terrain->area && i < tree->count; i++) {
        terrain->area[i] = 1.0f;
        tree->position[i].y = terrain_course_height(terrain->params, tree, i);
    }
    return terrain->area;
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
    if (terrain->params->form == TERRAIN_SURVEY) {
        return terrain_finish_survey(terrain, e);
    }
    if (!terrain_lay_beds(terrain->params, &terrain->strata, e)) {
        return false;
    }
    if (terrain_evolves(terrain->params)) {
        return fill_courses(terrain, e);
    }
    if (terrain->params->form != TERRAIN_RIVERS) {
        return terrain->params->form != TERRAIN_RIDGES || terrain_raise_ridges(terrain, e);
    }
    terrain->area = memory_alloc(grown->tree->count, sizeof *terrain->area, e);
    terrain->uplift = memory_alloc(grown->tree->count, sizeof *terrain->uplift, e);
    bool done = terrain->area && terrain->uplift && fill_rivers(terrain, recipe->run, e);
    grown->tree = terrain->tree;
    return done;
}

// ---- heights

// Moves a place by the noise, at most by `share` of what the parameters allow.
static void warp(const Terrain *terrain, float share, float *x, float *z)
{
    float wavelength = noise_wavelength(terrain->params);
    float u = *x / wavelength, v = *z / wavelength;
    float reach = 0.4f * warp_reach(terrain->params) * share;
    float push_x = sparse_noise_fractal(0.5f * u, 0.5f * v, 2, 0.5f, 0.0f,
                                        random_key(terrain->seed, STREAM_WARP_X));
    float push_z = sparse_noise_fractal(0.5f * u, 0.5f * v, 2, 0.5f, 0.0f,
                                        random_key(terrain->seed, STREAM_WARP_Z));
    *x += reach * clampf(push_x, -2.0f, 2.0f);
    *z += reach * clampf(push_z, -2.0f, 2.0f);
}

// All octaves of the noise, m, for slopes of gradient 1.
static float noise_at(const Terrain *terrain, float x, float z)
{
    const TerrainNoiseParams *noise = &terrain->params->noise;
    float wavelength = noise_wavelength(terrain->params);
    float n = sparse_noise_fractal(x / wavelength, z / wavelength, noise->iterations, noise->gain,
                                   noise->ridged, random_key(terrain->seed, STREAM_NOISE));
    return n * noise->amplitude * wavelength;
}

// The height and the wetness at a place of the land between rivers.
static float valleys_at(const Terrain *terrain, float x, float z, float *wetness)
{
    const TerrainParams *params = terrain->params;
    int32_t lowest = 0, nearest = 0;
    float away = trough_envelope_at(terrain->distance, x, z, &nearest);
    float height;
    if (params->noise.iterations > 0) {
        // No displacement at a river: the noise fades over half a wavelength.
        float fade = smoothstepf(0.0f, 0.5f * noise_wavelength(params), away);
        float at_x = x, at_z = z;
        warp(terrain, fade, &at_x, &at_z);
        height = trough_envelope_at(terrain->land, at_x, at_z, &lowest);
        float up = terrain->uplift[lowest] * terrain->gradient;
        height += noise_at(terrain, x, z) * fade * (up < 1.5f ? up : 1.5f);
    } else {
        height = trough_envelope_at(terrain->land, x, z, &lowest);
    }
    float valley = 1.5f * terrain_valley(params, terrain->area[nearest]) + 0.002f * params->size;
    *wetness = 1.0f - smoothstepf(0.0f, 1.0f, away / valley);
    return height;
}

// Beside the surveyed rivers.
static float wetness_at(const Terrain *terrain, float x, float z)
{
    int32_t nearest = 0;
    if (!terrain->distance) {
        return 0.0f;
    }
    float away = trough_envelope_at(terrain->distance, x, z, &nearest);
    float valley = 1.5f * terrain_valley(terrain->params, terrain->area[nearest]);
    return 1.0f - smoothstepf(0.0f, 1.0f, away / (valley + 0.002f * terrain->params->size));
}

// The lift at a place, 0..1.
static float lift_at(const Terrain *terrain, float x, float z)
{
    return terrain->map ? clampf(height_field_smooth_at(terrain->map, x, z), 0.0f, 1.0f)
                        : ridge_lift_at(terrain->lift, x, z);
}

// The height at a place of land that ridges or a map lift. The noise is in proportion to the slopes
// and fades toward the plain.
static float lifted_at(const Terrain *terrain, float x, float z)
{
    const TerrainParams *params = terrain->params;
    float relief = terrain_lift_relief(params), sign = terrain_lift_sign(params);
    if (params->noise.iterations == 0) {
        return sign * relief * lift_at(terrain, x, z);
    }
    float at_x = x, at_z = z;
    warp(terrain, 1.0f, &at_x, &at_z);
    float lift = lift_at(terrain, at_x, at_z);
    float up = relief / (terrain_lift_width(params) * params->size);
    float noise = noise_at(terrain, x, z) * (up < 1.5f ? up : 1.5f);
    return sign * relief * lift + noise * smoothstepf(0.0f, 0.4f, lift);
}

static float land_at(const Terrain *terrain, float x, float z, float *wetness)
{
    *wetness = 0.0f;
    switch (terrain->params->form) {
    case TERRAIN_RIVERS:
        return valleys_at(terrain, x, z, wetness);
    case TERRAIN_RIDGES:
    case TERRAIN_MAP:
        return lifted_at(terrain, x, z);
    case TERRAIN_SURVEY:
        *wetness = wetness_at(terrain, x, z);
        return terrain_surveyed_at(terrain, x, z);
    case TERRAIN_CANYON:
    case TERRAIN_MESAS:
    case TERRAIN_ALPS:
    case TERRAIN_VOLCANO:
    case TERRAIN_DUNES:
    case TERRAIN_HILLS:
    case TERRAIN_NOISE:
        break;
    }
    return noise_at(terrain, x, z);
}

// Of landforms; wetness is how much of the ground is loose.
static void sample_evolved(const Terrain *terrain, HeightField *field, int64_t i, float x, float z)
{
    EvolvedPlace place = terrain_evolved_at(terrain, x, z);
    field->height[i] = place.height;
    field->wetness[i] = (float)((double)place.loose / ((double)place.loose + 1.0));
    field->loose[i] = place.loose;
    if (field->change) {
        field->change[i] = place.change;
    }
    if (field->ground) {
        field->ground[i] = height_field_at(terrain->ground, x, z);
    }
}

// Room for what landforms record.
static bool add_records(const TerrainParams *params, HeightField *field, Error *e)
{
    int64_t count = height_field_count(field);
    if (params->form == TERRAIN_DUNES) {
        field->periodic = true;
        field->loose = memory_alloc_zero(count, sizeof(float), e);
        field->wind = field->loose ? memory_alloc_zero(count, sizeof(Vec2), e) : NULL;
        return field->wind;
    }
    if (!terrain_evolves(params)) {
        return true;
    }
    field->loose = memory_alloc_zero(count, sizeof(float), e);
    // Before alps, volcanoes and hills rose there was no land to compare with.
    bool whole = params->form == TERRAIN_CANYON || params->form == TERRAIN_MESAS;
    if (params->form == TERRAIN_VOLCANO &&
        !(field->ground = memory_alloc_zero(count, sizeof(float), e))) {
        return false;
    }
    field->change = whole && field->loose ? memory_alloc_zero(count, sizeof(float), e) : NULL;
    return field->loose && (field->change || !whole);
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
            if (terrain->dunes) {
                terrain_sample_dunes(terrain, field, i, x, z);
            } else if (terrain->evolved) {
                sample_evolved(terrain, field, i, x, z);
            } else {
                field->height[i] = land_at(terrain, x, z, &field->wetness[i]);
            }
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

// A volcano stands in warmer air than alps do: snow stays on its upper fifth.
static void warm(HeightField *field)
{
    for (int64_t i = 0; i < height_field_count(field); i++) {
        field->climate[i] *= 0.6f;
    }
}

static bool finish_field(Terrain *terrain, HeightField *field, const Run *run, Error *e)
{
    const TerrainParams *params = terrain->params;
    if (!terrain_erode(field, &params->erosion, run, e)) {
        return false;
    }
    bool drains = params->form == TERRAIN_RIVERS ||
                  (params->form == TERRAIN_SURVEY && terrain->tree->count > 0);
    if (drains) {
        carve_rivers(field, terrain->tree);
        if (!height_field_fill(field, 1e-5f, e)) {
            return false;
        }
    }
    make_terraces(field, &params->terraces, random_key(terrain->seed, STREAM_TERRACES));
    if (params->form == TERRAIN_ALPS) { // sampling leaves pits in the flat floors of valleys
        return height_field_fill(field, 1e-4f, e) &&
               terrain_find_climate(params, params->alps.wind, field, run, e);
    }
    if (params->form == TERRAIN_VOLCANO) {
        bool done = terrain_fill_shallow_pits(field, 12.0f, e) &&
                    terrain_find_climate(params, params->volcano.wind, field, run, e);
        if (done) {
            warm(field);
        }
        return done;
    }
    if (params->form == TERRAIN_HILLS) {
        return (params->hills.rills <= 0.0f || terrain_fell_needles(field, e)) &&
               height_field_fill(field, 1e-4f, e) && terrain_wet_hollows(field, e);
    }
    if (terrain_evolves(params)) {
        return terrain_lay_rivers(terrain, field, run, e);
    }
    return !drains || ((params->terraces.count <= 0 || height_field_fill(field, 0.0f, e)) &&
                       terrain_lay_rivers(terrain, field, run, e)); // on the final land
}

// What the heights are looked up in.
static bool prepare_land(Terrain *terrain, const Run *run, Error *e)
{
    switch (terrain->params->form) {
    case TERRAIN_RIVERS:
        terrain->land = make_envelope(terrain, false, run, e);
        terrain->distance = terrain->land ? make_envelope(terrain, true, run, e) : NULL;
        return terrain->distance;
    case TERRAIN_RIDGES:
        terrain->lift = terrain_ridge_lift(terrain, warp_reach(terrain->params), run, e);
        return terrain->lift;
    case TERRAIN_MAP:
        terrain->map = terrain_read_map(terrain->params, run, e);
        return terrain->map;
    case TERRAIN_SURVEY:
        terrain->map = terrain_read_survey(terrain->params, run, e);
        if (terrain->map && terrain->tree->count > 0) {
            terrain->distance = make_envelope(terrain, true, run, e);
            return terrain->distance;
        }
        return terrain->map;
    case TERRAIN_CANYON:
    case TERRAIN_MESAS:
        terrain->evolved = terrain_evolve(terrain, run, e);
        return terrain->evolved;
    case TERRAIN_ALPS:
        terrain->evolved = terrain_evolve_alps(terrain, run, e);
        return terrain->evolved;
    case TERRAIN_VOLCANO:
        terrain->evolved = terrain_evolve_volcano(terrain, &terrain->ground, run, e);
        return terrain->evolved;
    case TERRAIN_HILLS:
        terrain->evolved = terrain_evolve_hills(terrain, run, e);
        return terrain->evolved;
    case TERRAIN_DUNES:
        terrain->dunes = terrain_blow_dunes(terrain, run, e);
        return terrain->dunes;
    case TERRAIN_NOISE:
        break;
    }
    return true;
}

HeightField *terrain_heights(const void *given, const Grown *grown, const Run *run, Error *e)
{
    const TerrainParams *params = given;
    Terrain *terrain = grown->state;
    float cell = params->size / (float)params->resolution, corner = -0.5f * params->size;
    forget(terrain);
    HeightField *field = NULL;
    if (prepare_land(terrain, run, e)) {
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
    if (!placed || !field->wetness || !add_records(params, field, e) ||
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
