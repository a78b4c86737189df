// Erosion of a height field: slides of steep slopes (thermal) and incision by brooks (stream
// power). It runs on its own grid, the same for every resolution, so that more samples show the
// same erosion; the change is added to the field by splines.
#include "base/exact_math.h"
#include "base/memory.h"
#include "land/height_drainage.h"
#include "objects/terrain/internal.h"

#include <stdlib.h>
#include <string.h>

enum { ERODED_CELLS = 512 }; // a side

// ---- thermal: land steeper than the talus slides to lower neighbours

// Height that sample i exchanges with its four neighbours; limit: largest height difference per
// cell.
static float slide(const HeightField *field, int row, int column, float limit)
{
    const float *h = &field->height[(int64_t)row * field->columns + column];
    const int64_t beside[4] = {-1, 1, -field->columns, field->columns};
    float change = 0.0f;
    for (int k = 0; k < 4; k++) {
        float drop = *h - h[beside[k]];
        float over = drop > limit ? drop - limit : drop < -limit ? drop + limit : 0.0f;
        change -= 0.2f * over; // a fifth each: never overshoots
    }
    return change;
}

static void thermal_step(HeightField *field, float *next, float limit, int threads)
{
    size_t bytes = sizeof *next * (size_t)height_field_count(field);
    memcpy(next, field->height, bytes);
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int row = 1; row < field->rows - 1; row++) {
        for (int column = 1; column < field->columns - 1; column++) {
            next[(int64_t)row * field->columns + column] += slide(field, row, column, limit);
        }
    }
    memcpy(field->height, next, bytes);
}

static bool erode_slopes(HeightField *field, const TerrainErosionParams *params, const Run *run,
                         Error *e)
{
    float sine, cosine;
    exact_sincos(params->talus * 0.017453292f, &sine, &cosine);
    float limit = sine / cosine * field->cell.x;
    int steps = (int)(params->thermal * 60.0f + 0.5f);
    float *next = memory_alloc(height_field_count(field), sizeof *next, e);
    bool done = next;
    for (int i = 0; done && i < steps; i++) {
        done = !run_is_cancelled(run) || run_cancel_error(e);
        if (done) {
            thermal_step(field, next, limit, run->threads);
        }
    }
    free(next);
    return done;
}

// ---- streams: dh/dt = -K A^0.5 dh/dx, implicit from the outlets up (Braun and Willett 2013)

static bool erode_streams_once(HeightField *field, float strength, float reach, Error *e)
{
    Drainage *drainage = drainage_new(field, e);
    if (!drainage) {
        return false;
    }
    for (int64_t k = 0; k < drainage->count; k++) {
        int32_t i = drainage->order[k], to = drainage->receiver[i];
        if (to == i) {
            continue;
        }
        bool diagonal =
            to != i - 1 && to != i + 1 && to != i - field->columns && to != i + field->columns;
        float length = field->cell.x * (diagonal ? 1.4142135f : 1.0f);
        // Below this area no brook forms, so slopes keep their form on any grid.
        float area = (float)drainage->area[i];
        // Rivers are already in steady state: only gullies erode.
        float most = 64.0f * reach * reach;
        float share = area / (area + reach * reach) * (most / (area + most));
        float f = strength * share * sqrtf(area) / length;
        float below = field->height[to];
        float h = (field->height[i] + f * below) / (1.0f + f);
        field->height[i] = h < field->height[i] ? h : field->height[i];
    }
    drainage_free(drainage);
    return true;
}

static bool erode_streams(HeightField *field, const TerrainErosionParams *params, const Run *run,
                          Error *e)
{
    enum { STEPS = 4 };
    float size = field->cell.x * (float)(field->columns - 1);
    for (int i = 0; i < STEPS; i++) {
        if (run_is_cancelled(run)) {
            return run_cancel_error(e);
        }
        if (!erode_streams_once(field, 0.06f * params->streams, 0.004f * size, e)) {
            return false;
        }
    }
    return true;
}

// Resamples the field on the grid of the erosion.
static HeightField *resample(const HeightField *field, Error *e)
{
    float scale_x = (float)(field->columns - 1) / ERODED_CELLS;
    float scale_z = (float)(field->rows - 1) / ERODED_CELLS;
    Vec2 cell = {field->cell.x * scale_x, field->cell.y * scale_z};
    HeightField *copy =
        height_field_new(ERODED_CELLS + 1, ERODED_CELLS + 1, cell, field->origin, e);
    for (int64_t i = 0; copy && i < height_field_count(copy); i++) {
        float x = copy->origin.x + (float)(i % copy->columns) * cell.x;
        int64_t row = i / copy->columns;
        float z = copy->origin.y + (float)row * cell.y;
        copy->height[i] = height_field_at(field, x, z);
    }
    return copy;
}

// Also to the record of them.
static void add_changes(HeightField *field, const HeightField *changes, int threads)
{
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int row = 0; row < field->rows; row++) {
        for (int column = 0; column < field->columns; column++) {
            int64_t i = (int64_t)row * field->columns + column;
            float x = field->origin.x + (float)column * field->cell.x;
            float z = field->origin.y + (float)row * field->cell.y;
            float change = height_field_smooth_at(changes, x, z);
            field->height[i] += change;
            if (field->change) {
                field->change[i] += change;
            }
        }
    }
}

bool terrain_erode(HeightField *field, const TerrainErosionParams *params, const Run *run, Error *e)
{
    if (params->streams <= 0.0f && params->thermal <= 0.0f) {
        return true;
    }
    HeightField *before = resample(field, e), *after = before ? resample(field, e) : NULL;
    bool done = after && (params->streams <= 0.0f || erode_streams(after, params, run, e)) &&
                (params->thermal <= 0.0f || erode_slopes(after, params, run, e));
    if (done && !field->change && !field->loose) { // else no record began before erosion
        field->change = memory_alloc_zero(height_field_count(field), sizeof(float), e);
        done = field->change;
    }
    if (done) {
        for (int64_t i = 0; i < height_field_count(after); i++) {
            after->height[i] -= before->height[i];
        }
        add_changes(field, after, run->threads);
    }
    height_field_free(before);
    height_field_free(after);
    return done;
}
