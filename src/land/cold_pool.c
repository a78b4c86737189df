#include "land/cold_pool.h"

#include "base/exact_math.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

// The sample that is found at index i beyond the rim.
static int folded(const HeightField *field, int i, int count)
{
    int cells = count > 1 ? count - 1 : 1;
    if (field->periodic) {
        i %= cells;
        return i < 0 ? i + cells : i;
    }
    i %= 2 * cells;
    i = i < 0 ? i + 2 * cells : i;
    return i > cells ? 2 * cells - i : i;
}

// ---- the land in fewer samples: the lowest around each, so that no valley is lost

static HeightField *lowest_around(const HeightField *land, const Run *run, Error *e)
{
    int stride = 1;
    while ((land->columns - 1) / stride + 1 > COLD_POOL_SIDE ||
           (land->rows - 1) / stride + 1 > COLD_POOL_SIDE) {
        stride *= 2;
    }
    int columns = (land->columns - 1) / stride + 1, rows = (land->rows - 1) / stride + 1;
    Vec2 cell = {land->cell.x * (float)stride, land->cell.y * (float)stride};
    HeightField *field = height_field_new(columns, rows, cell, land->origin, e);
    if (!field) {
        return NULL;
    }
    field->periodic = land->periodic;
    int reach = stride / 2;
#pragma omp parallel for schedule(static) num_threads(run->threads)
    for (int z = 0; z < rows; z++) {
        for (int x = 0; x < columns; x++) {
            float lowest = INFINITY;
            for (int k = z * stride - reach; k <= z * stride + reach; k++) {
                const float *row =
                    land->height + (int64_t)folded(land, k, land->rows) * land->columns;
                for (int i = x * stride - reach; i <= x * stride + reach; i++) {
                    float h = row[folded(land, i, land->columns)];
                    lowest = h < lowest ? h : lowest;
                }
            }
            field->height[(int64_t)z * columns + x] = lowest;
        }
    }
    return field;
}

// ---- windows along rows and columns

typedef struct Window {
    int reach;   // samples to either side
    bool lowest; // else the mean
} Window;

static void slide_along_x(const HeightField *field, Window w, const float *from, float *to,
                          const Run *run)
{
#pragma omp parallel for schedule(static) num_threads(run->threads)
    for (int z = 0; z < field->rows; z++) {
        const float *row = from + (int64_t)z * field->columns;
        for (int x = 0; x < field->columns; x++) {
            float lowest = INFINITY;
            double sum = 0.0;
            for (int i = x - w.reach; i <= x + w.reach; i++) {
                float h = row[folded(field, i, field->columns)];
                lowest = h < lowest ? h : lowest;
                sum += (double)h;
            }
            to[(int64_t)z * field->columns + x] =
                w.lowest ? lowest : (float)(sum / (2 * w.reach + 1));
        }
    }
}

static void slide_along_z(const HeightField *field, Window w, const float *from, float *to,
                          const Run *run)
{
#pragma omp parallel for schedule(static) num_threads(run->threads)
    for (int z = 0; z < field->rows; z++) {
        for (int x = 0; x < field->columns; x++) {
            float lowest = INFINITY;
            double sum = 0.0;
            for (int i = z - w.reach; i <= z + w.reach; i++) {
                float h = from[(int64_t)folded(field, i, field->rows) * field->columns + x];
                lowest = h < lowest ? h : lowest;
                sum += (double)h;
            }
            to[(int64_t)z * field->columns + x] =
                w.lowest ? lowest : (float)(sum / (2 * w.reach + 1));
        }
    }
}

// The lowest or the mean within a square, in place. spare: as many samples.
static void slide(const HeightField *field, bool lowest, float radius, float *height, float *spare,
                  const Run *run)
{
    Window x = {(int)lrintf(radius / field->cell.x), lowest};
    Window z = {(int)lrintf(radius / field->cell.y), lowest};
    slide_along_x(field, x, height, spare, run);
    slide_along_z(field, z, spare, height, run);
}

// ---- wind

// Bilinear, at a place in samples anywhere.
static float folded_at(const HeightField *field, const float *height, float x, float z)
{
    float fx = floorf(x), fz = floorf(z), u = x - fx, v = z - fz;
    int x0 = folded(field, (int)fx, field->columns),
        x1 = folded(field, (int)fx + 1, field->columns);
    int z0 = folded(field, (int)fz, field->rows), z1 = folded(field, (int)fz + 1, field->rows);
    const float *near = height + (int64_t)z0 * field->columns;
    const float *far = height + (int64_t)z1 * field->columns;
    return lerpf(lerpf(near[x0], near[x1], u), lerpf(far[x0], far[x1], u), v);
}

static void bank_up(HeightField *level, const float *mean, const ColdPoolParams *params,
                    const Run *run)
{
    float sine, cosine;
    exact_sincos(params->wind * RADIANS_PER_DEGREE, &sine, &cosine);
    float dx = params->radius * sine / level->cell.x, dz = params->radius * cosine / level->cell.y;
#pragma omp parallel for schedule(static) num_threads(run->threads)
    for (int z = 0; z < level->rows; z++) {
        for (int x = 0; x < level->columns; x++) {
            float ahead = folded_at(level, mean, (float)x + dx, (float)z + dz);
            float behind = folded_at(level, mean, (float)x - dx, (float)z - dz);
            float rise = clampf((ahead - behind) / (2.0f * params->depth), -1.0f, 1.0f);
            level->height[(int64_t)z * level->columns + x] +=
                0.5f * params->drift * params->depth * rise;
        }
    }
}

HeightField *cold_pool_level(const HeightField *land, const ColdPoolParams *params, const Run *run,
                             Error *e)
{
    HeightField *level = lowest_around(land, run, e);
    int64_t count = level ? height_field_count(level) : 0;
    float *spare = level ? memory_alloc(count, sizeof *spare, e) : NULL;
    float *mean = spare ? memory_alloc(count, sizeof *mean, e) : NULL;
    if (mean) {
        for (int64_t i = 0; i < count; i++) {
            mean[i] = level->height[i];
        }
        slide(level, true, params->radius, level->height, spare, run);
        slide(level, false, 0.5f * params->radius, level->height, spare, run);
        slide(level, false, 0.5f * params->radius, level->height, spare, run);
        if (params->drift > 0.0f) {
            slide(level, false, 0.5f * params->radius, mean, spare, run);
            bank_up(level, mean, params, run);
        }
    }
    free(spare);
    free(mean);
    if (level && !mean) {
        height_field_free(level);
        return NULL;
    }
    return level;
}
