#include "objects/terrain/noise.h"

#include "base/random.h"

#include <math.h>

enum {
    STREAM_COUNT = 1000, // of a cell, and those behind it; kernel i uses stream i
    MOST_KERNELS = 24    // in a cell
};

// exp(-SPARSE_NOISE_DENSITY)
static const float NO_KERNEL = 0.049787068f;

int sparse_noise_count(uint64_t cell_key)
{
    // Knuth: uniform numbers are multiplied until they fall below exp(-mean).
    float product = random_unit(random_key(cell_key, STREAM_COUNT));
    int count = 0;
    while (count < MOST_KERNELS && product > NO_KERNEL) {
        count++;
        product *= random_unit(random_key(cell_key, STREAM_COUNT + (uint64_t)count));
    }
    return count;
}

// (1 - r^2)^3 (1 - 5 r^2) inside r < 1: falls to 0 smoothly, integral over the disc 0.
static float kernel(float r2)
{
    float s = 1.0f - r2;
    return s * s * s * (1.0f - 5.0f * r2);
}

// A kernel: its place within its cell and its weight.
typedef struct Kernel {
    float x, y, weight;
} Kernel;

static uint64_t key_of_cell(int32_t column, int32_t row, uint64_t seed)
{
    return random_key(random_key(seed, (uint64_t)(uint32_t)column), (uint32_t)row);
}

static Kernel kernel_of_cell(uint64_t cell_key, int i)
{
    const float unit = 1.0f / 2097152.0f;
    uint64_t bits = random_mix(random_key(cell_key, (uint64_t)i)); // three numbers of 21 bits
    return (Kernel){(float)(bits & 0x1fffff) * unit, (float)(bits >> 21 & 0x1fffff) * unit,
                    2.0f * (float)(bits >> 42 & 0x1fffff) * unit - 1.0f};
}

static float cell_sum(int32_t column, int32_t row, float x, float y, uint64_t seed)
{
    uint64_t key = key_of_cell(column, row, seed);
    int count = sparse_noise_count(key);
    float sum = 0.0f;
    for (int i = 0; i < count; i++) {
        Kernel at = kernel_of_cell(key, i);
        float dx = x - (float)column - at.x, dy = y - (float)row - at.y;
        float r2 = dx * dx + dy * dy;
        if (r2 < 1.0f) {
            sum += at.weight * kernel(r2);
        }
    }
    return sum;
}

static int32_t cell_at(float x)
{
    return (int32_t)((float)(int32_t)x - (x < (float)(int32_t)x ? 1.0f : 0.0f));
}

// Campbell's theorem: variance = density * mean square weight (1/3) * integral of kernel^2, which
// is pi (1/7 - 10/56 + 25/252).
static const float SCALE = 1.0f / 0.4466164f; // the root of 3 / 3 * 0.1994662

float sparse_noise(float x, float y, uint64_t seed)
{
    int32_t cell_x = cell_at(x), cell_y = cell_at(y);
    float sum = 0.0f;
    for (int row = -1; row <= 1; row++) {
        for (int column = -1; column <= 1; column++) {
            sum += cell_sum(cell_x + column, cell_y + row, x, y, seed);
        }
    }
    return sum * SCALE;
}

// ---- many places

typedef struct Cell {
    int32_t column, row;
    int count; // -1 = empty
    float x[MOST_KERNELS], y[MOST_KERNELS], weight[MOST_KERNELS];
} Cell;

// The kernels that reach a cell, those of its neighbours one after the other, and the cells of
// before, by the last bits of their numbers: a cell's eight neighbours never take its place.
typedef struct Around {
    uint64_t seed;
    int32_t column, row;
    int end[9]; // of each cell's kernels
    float column_of[9 * MOST_KERNELS], row_of[9 * MOST_KERNELS];
    float x[9 * MOST_KERNELS], y[9 * MOST_KERNELS], weight[9 * MOST_KERNELS];
    Cell cell[4][4];
} Around;

static void around_clear(Around *a, uint64_t seed)
{
    a->seed = seed;
    a->end[8] = -1; // of no cell yet
    for (int i = 0; i < 16; i++) {
        a->cell[i / 4][i % 4].count = -1;
    }
}

static const Cell *draw_cell(Around *a, int32_t column, int32_t row)
{
    Cell *cell = &a->cell[row & 3][column & 3];
    if (cell->count < 0 || cell->column != column || cell->row != row) {
        uint64_t key = key_of_cell(column, row, a->seed);
        cell->column = column;
        cell->row = row;
        cell->count = sparse_noise_count(key);
        for (int i = 0; i < cell->count; i++) {
            Kernel at = kernel_of_cell(key, i);
            cell->x[i] = at.x;
            cell->y[i] = at.y;
            cell->weight[i] = at.weight;
        }
    }
    return cell;
}

static void move_to_cell(Around *a, int32_t column, int32_t row)
{
    if (a->end[8] >= 0 && a->column == column && a->row == row) {
        return;
    }
    a->column = column;
    a->row = row;
    int end = 0;
    for (int k = 0; k < 9; k++) {
        const Cell *cell = draw_cell(a, column + k % 3 - 1, row + k / 3 - 1);
        for (int i = 0; i < cell->count; i++, end++) {
            a->column_of[end] = (float)cell->column;
            a->row_of[end] = (float)cell->row;
            a->x[end] = cell->x[i];
            a->y[end] = cell->y[i];
            a->weight[end] = cell->weight[i];
        }
        a->end[k] = end;
    }
}

// sparse_noise, with the same bits: sums in the same order, in which kernels out of reach are 0.
static float sum_around(Around *a, float x, float y)
{
    float value[9 * MOST_KERNELS];
    move_to_cell(a, cell_at(x), cell_at(y));
    const int all = a->end[8];
#pragma omp simd
    for (int i = 0; i < all; i++) {
        float dx = x - a->column_of[i] - a->x[i], dy = y - a->row_of[i] - a->y[i];
        float r2 = dx * dx + dy * dy, own = a->weight[i] * kernel(r2);
        value[i] = r2 < 1.0f ? own : 0.0f;
    }
    float sum = 0.0f;
    for (int k = 0, i = 0; k < 9; k++) {
        float of_cell = 0.0f;
        for (; i < a->end[k] && i < all; i++) {
            of_cell += value[i]; // cppcheck-suppress uninitvar ; i < all
        }
        sum += of_cell;
    }
    return sum * SCALE;
}

// ---- octaves

// Places of the next octave: of twice the frequency, turned by 37 degrees.
static void next_octave(float *x, float *y)
{
    float turned = 1.6f * *x - 1.2f * *y;
    *y = 1.2f * *x + 1.6f * *y + 17.3f;
    *x = turned + 5.7f;
}

static float ridge(float n, float ridged)
{
    const float mean = 0.79f;                // of the absolute value
    float crest = (mean - fabsf(n)) * 1.65f; // rescaled to variance 1
    return lerpf(n, crest, ridged);
}

float sparse_noise_fractal(float x, float y, int iterations, float gain, float ridged,
                           uint64_t seed)
{
    float sum = 0.0f, height = 1.0f;
    for (int i = 0; i < iterations; i++) {
        sum += height * ridge(sparse_noise(x, y, random_key(seed, (uint64_t)i)), ridged);
        height *= gain;
        next_octave(&x, &y);
    }
    return sum;
}

void sparse_noise_fractal_along(float *x, float *y, int count, int iterations, float gain,
                                float ridged, uint64_t seed, float *sum)
{
    Around around;
    float height = 1.0f;
    for (int k = 0; k < count; k++) {
        sum[k] = 0.0f;
    }
    for (int i = 0; i < iterations; i++) {
        around_clear(&around, random_key(seed, (uint64_t)i));
        for (int k = 0; k < count; k++) {
            sum[k] += height * ridge(sum_around(&around, x[k], y[k]), ridged);
            next_octave(&x[k], &y[k]);
        }
        height *= gain;
    }
}
