// Where snow lasts: not above a line, but by altitude, in hollows and couloirs, to the lee of
// crests, and on slopes that look north.
#include "base/exact_math.h"
#include "base/memory.h"
#include "objects/terrain/internal.h"

#include <stdlib.h>
#include <string.h>

// Means of `count` samples, `step` apart, over windows of 2 reach + 1; windows end at the border.
static void blur_line(const float *from, float *to, int count, int64_t step, int reach)
{
    double sum = 0.0;
    int low = 0, high = 0; // the window is low..high-1
    for (int i = 0; i < count; i++) {
        int first = i - reach > 0 ? i - reach : 0;
        int end = i + reach + 1 < count ? i + reach + 1 : count;
        while (high < end) {
            sum += (double)from[step * high++];
        }
        while (low < first) {
            sum -= (double)from[step * low++];
        }
        to[step * i] = (float)(sum / (high - low));
    }
}

// The mean of the square of `reach` samples to each side. other: room for as many samples.
static void blur(const HeightField *field, float *mean, float *other, int reach, int threads)
{
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int row = 0; row < field->rows; row++) {
        int64_t first = (int64_t)row * field->columns;
        blur_line(field->height + first, other + first, field->columns, 1, reach);
    }
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int column = 0; column < field->columns; column++) {
        blur_line(other + column, mean + column, field->rows, field->columns, reach);
    }
}

static float soft(float x)
{
    return x / (1.0f + fabsf(x));
}

// Adds what a hollow of about this width holds, and what lies to the lee and looks north in it.
static void add_scale(HeightField *field, const float *mean, float width, float deep, Vec2 wind,
                      int threads)
{
    int columns = field->columns;
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int row = 0; row < field->rows; row++) {
        for (int column = 0; column < columns; column++) {
            int64_t i = (int64_t)row * columns + column;
            int64_t west = column > 0 ? i - 1 : i, east = column + 1 < columns ? i + 1 : i;
            int64_t north = row > 0 ? i - columns : i;
            int64_t south = row + 1 < field->rows ? i + columns : i;
            float dx = (mean[east] - mean[west]) / (2.0f * field->cell.x);
            float dz = (mean[south] - mean[north]) / (2.0f * field->cell.y);
            float hollow = soft(8.0f * (mean[i] - field->height[i]) / width);
            float lee = soft(-(dx * wind.x + dz * wind.y));
            field->climate[i] += deep * hollow + 0.03f * lee + 0.03f * soft(dz);
        }
    }
}

bool terrain_find_climate(const TerrainParams *params, float wind_azimuth, float hollow,
                          HeightField *field, const Run *run, Error *e)
{
    int64_t count = height_field_count(field);
    field->climate = memory_alloc(count, sizeof *field->climate, e);
    float *mean = memory_alloc(count, sizeof *mean, e);
    float *other = memory_alloc(count, sizeof *other, e);
    bool done = field->climate && mean && other;
    if (done) {
        float low, high, sine, cosine;
        height_field_range(field, &low, &high);
        for (int64_t i = 0; i < count; i++) {
            field->climate[i] = (field->height[i] - low) / (high > low ? high - low : 1.0f);
        }
        // It blows from the azimuth, clockwise from north.
        exact_sincos(wind_azimuth * 0.017453292f, &sine, &cosine);
        Vec2 wind = {-sine, cosine};
        const float width[] = {0.004f, 0.016f}; // shares of the size: gullies and cirques
        for (int k = 0; k < 2; k++) {
            float metres = width[k] * params->size;
            int reach = (int)(0.5f * metres / field->cell.x + 0.5f);
            blur(field, mean, other, reach > 1 ? reach : 1, run->threads);
            add_scale(field, mean, metres, hollow, wind, run->threads);
        }
    }
    free(mean);
    free(other);
    return done;
}
