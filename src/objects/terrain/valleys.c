// Land between rivers: the form rivers. It is the lowest of the troughs along them.
#include "base/memory.h"
#include "objects/terrain/internal.h"

#include <math.h>
#include <stdlib.h>

TroughEnvelope *terrain_envelope(const Terrain *terrain, bool flat, const Run *run, Error *e)
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
                                                   terrain_warp_reach(terrain->params), run, e);
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
        TroughEnvelope *unit = terrain_envelope(terrain, false, run, e);
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

bool terrain_fill_rivers(Terrain *terrain, const Run *run, Error *e)
{
    enum { MOST_PASSES = 6 }; // captures change areas, areas change heights
    int64_t nodes = terrain->tree->count;
    terrain->area = memory_alloc(nodes, sizeof *terrain->area, e);
    terrain->uplift = memory_alloc(nodes, sizeof *terrain->uplift, e);
    if (!terrain->area || !terrain->uplift || !terrain_uplift(terrain, run, e)) {
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

// ---- heights

float terrain_valleys_at(const Terrain *terrain, float x, float z, float *wetness)
{
    const TerrainParams *params = terrain->params;
    int32_t lowest = 0, nearest = 0;
    float away = trough_envelope_at(terrain->distance, x, z, &nearest);
    float height;
    if (params->noise.iterations > 0) {
        // No displacement at a river: the noise fades over half a wavelength.
        float fade = smoothstepf(0.0f, 0.5f * terrain_noise_wavelength(params), away);
        float at_x = x, at_z = z;
        terrain_warp(terrain, fade, &at_x, &at_z);
        height = trough_envelope_at(terrain->land, at_x, at_z, &lowest);
        float up = terrain->uplift[lowest] * terrain->gradient;
        height += terrain_noise_at(terrain, x, z) * fade * (up < 1.5f ? up : 1.5f);
    } else {
        height = trough_envelope_at(terrain->land, x, z, &lowest);
    }
    float valley = 1.5f * terrain_valley(params, terrain->area[nearest]) + 0.002f * params->size;
    *wetness = 1.0f - smoothstepf(0.0f, 1.0f, away / valley);
    return height;
}

float terrain_wetness_at(const Terrain *terrain, float x, float z)
{
    int32_t nearest = 0;
    if (!terrain->distance) {
        return 0.0f;
    }
    float away = trough_envelope_at(terrain->distance, x, z, &nearest);
    float valley = 1.5f * terrain_valley(terrain->params, terrain->area[nearest]);
    return 1.0f - smoothstepf(0.0f, 1.0f, away / (valley + 0.002f * terrain->params->size));
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

void terrain_carve_rivers(HeightField *field, const OutTree *rivers)
{
    for (int64_t i = 0; i < rivers->count; i++) {
        if (rivers->parent[i] >= 0) {
            carve_piece(field, rivers->position[i], rivers->position[rivers->parent[i]]);
        }
    }
}
