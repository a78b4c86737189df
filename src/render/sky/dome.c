#include "render/sky/dome.h"

#include "base/memory.h"

#include <stdlib.h>

Dome *dome_new(int columns, int rows, int block, bool horizon_spacing, float rotation, Error *e)
{
    Dome *dome = memory_alloc_zero(1, sizeof *dome, e);
    if (!dome) {
        return NULL;
    }
    *dome = (Dome){.columns = columns,
                   .rows = rows,
                   .block = block,
                   .horizon_spacing = horizon_spacing,
                   .rotation = rotation};
    int down = rows / block;
    int64_t cells = (int64_t)(columns / block) * down;
    if (!(dome->radiance = memory_alloc_zero((int64_t)columns * rows, sizeof(Vec3), e)) ||
        !(dome->density = memory_alloc_zero(cells, sizeof(float), e)) ||
        !(dome->cell_sum = memory_alloc_zero(cells + down, sizeof(float), e)) ||
        !(dome->row_sum = memory_alloc_zero(down + 1, sizeof(float), e)) ||
        !(dome->edge = memory_alloc_zero(rows + 1, sizeof(float), e))) {
        dome_free(dome);
        return NULL;
    }
    for (int i = 0; i <= rows; i++) {
        dome->edge[i] = sinf(dome_elevation(horizon_spacing, (float)i / (float)rows));
    }
    return dome;
}

void dome_free(Dome *dome)
{
    if (dome) {
        free(dome->radiance);
        free(dome->density);
        free(dome->cell_sum);
        free(dome->row_sum);
        free(dome->edge);
        free(dome);
    }
}

float dome_elevation(bool horizon_spacing, float v)
{
    float t = 1.0f - 2.0f * v;
    return 0.5f * PI_F * (horizon_spacing ? t * fabsf(t) : t);
}

static float row_coordinate(const Dome *dome, Vec3 direction)
{
    float t = asinf(clampf(direction.y, -1.0f, 1.0f)) * (2.0f / PI_F);
    if (dome->horizon_spacing) {
        t = copysignf(sqrtf(fabsf(t)), t);
    }
    return (0.5f - 0.5f * t) * (float)dome->rows;
}

// In [0, columns).
static float column_coordinate(const Dome *dome, Vec3 direction)
{
    float turn = 0.5f - (atan2f(direction.x, direction.z) - dome->rotation) / (2.0f * PI_F);
    turn -= floorf(turn);
    return fminf(turn * (float)dome->columns, (float)dome->columns * 0.9999999f);
}

static int clamp_row(const Dome *dome, int row)
{
    return row < 0 ? 0 : (row >= dome->rows ? dome->rows - 1 : row);
}

Vec3 dome_lookup(const Dome *dome, Vec3 direction)
{
    float x = column_coordinate(dome, direction) - 0.5f, y = row_coordinate(dome, direction) - 0.5f;
    int column = (int)floorf(x), row = (int)floorf(y);
    float fx = x - (float)column, fy = y - (float)row;
    int left = column < 0 ? dome->columns - 1 : column;
    int right = column + 1 == dome->columns ? 0 : column + 1;
    const Vec3 *above = dome->radiance + (int64_t)clamp_row(dome, row) * dome->columns;
    const Vec3 *below = dome->radiance + (int64_t)clamp_row(dome, row + 1) * dome->columns;
    return vec3_lerp(vec3_lerp(above[left], above[right], fx),
                     vec3_lerp(below[left], below[right], fx), fy);
}

// A 1-2-1 blur in both directions: an entry's weight must not vanish where bilinear lookup takes
// light from its neighbours.
static double entry_weight(const Dome *dome, int row, int column)
{
    double sum = 0.0;
    for (int j = -1; j <= 1; j++) {
        const Vec3 *line = dome->radiance + (int64_t)clamp_row(dome, row + j) * dome->columns;
        for (int i = -1; i <= 1; i++) {
            int k = (column + i + dome->columns) % dome->columns;
            sum += (double)luminance(line[k]) * (2 - abs(i)) * (2 - abs(j));
        }
    }
    return sum > 0.0 ? sum / 16.0 : 0.0;
}

// Solid angle of an entry between the rows' edges `top` and `bottom`.
static double solid_angle(const Dome *dome, int top, int bottom)
{
    return ((double)dome->edge[top] - (double)dome->edge[bottom]) * 2.0 * (double)PI_F /
           dome->columns;
}

// Weight of a cell: of its entries, by their solid angles.
static double cell_weight(const Dome *dome, int cell_row, int cell_column)
{
    double sum = 0.0;
    for (int j = cell_row * dome->block; j < (cell_row + 1) * dome->block; j++) {
        double angle = solid_angle(dome, j, j + 1);
        for (int i = cell_column * dome->block; i < (cell_column + 1) * dome->block; i++) {
            sum += angle * entry_weight(dome, j, i);
        }
    }
    return sum;
}

static double prepare_row(Dome *dome, int row)
{
    int across = dome->columns / dome->block;
    float *sums = dome->cell_sum + (int64_t)row * (across + 1);
    float *weight = dome->density + (int64_t)row * across;
    double total = 0.0, sum = 0.0;
    for (int i = 0; i < across; i++) {
        weight[i] = (float)cell_weight(dome, row, i);
        total += (double)weight[i];
    }
    for (int i = 0; i < across; i++) {
        sums[i] = (float)(total > 0.0 ? sum / total : (double)i / across);
        sum += (double)weight[i];
    }
    sums[across] = 1.0f;
    return total;
}

// Computes the densities from the rounded sums that sampling uses.
static void fill_densities(Dome *dome)
{
    int across = dome->columns / dome->block, down = dome->rows / dome->block;
    for (int j = 0; j < down; j++) {
        const float *sums = dome->cell_sum + (int64_t)j * (across + 1);
        double angle = solid_angle(dome, j * dome->block, (j + 1) * dome->block) * dome->block;
        float row = (dome->row_sum[j + 1] - dome->row_sum[j]) / (float)angle;
        for (int i = 0; i < across; i++) {
            dome->density[(int64_t)j * across + i] = row * (sums[i + 1] - sums[i]);
        }
    }
}

void dome_prepare(Dome *dome)
{
    int down = dome->rows / dome->block;
    double total = 0.0, sum = 0.0;
    for (int j = 0; j < down; j++) {
        double row = prepare_row(dome, j);
        dome->row_sum[j] = (float)row;
        total += row;
    }
    dome->power = (float)total;
    for (int j = 0; j < down; j++) {
        double row = (double)dome->row_sum[j];
        dome->row_sum[j] = (float)(total > 0.0 ? sum / total : (double)j / down);
        sum += row;
    }
    dome->row_sum[down] = 1.0f;
    fill_densities(dome);
}

// The last i of 0 .. count - 1 with sums[i] <= u; *rest becomes u's place within it, 0..1.
static int find_interval(const float *sums, int count, float u, float *rest)
{
    int low = 0, high = count;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (sums[middle] <= u) {
            low = middle;
        } else {
            high = middle;
        }
    }
    float width = sums[low + 1] - sums[low];
    *rest = width > 0.0f ? clampf((u - sums[low]) / width, 0.0f, 1.0f) : 0.5f;
    return low;
}

Vec3 dome_sample(const Dome *dome, float u, float v, float *density)
{
    float x, y;
    int across = dome->columns / dome->block, down = dome->rows / dome->block;
    int row = find_interval(dome->row_sum, down, v, &y);
    int column = find_interval(dome->cell_sum + (int64_t)row * (across + 1), across, u, &x);
    *density = dome->density[(int64_t)row * across + column];
    float sine = lerpf(dome->edge[row * dome->block], dome->edge[(row + 1) * dome->block], y);
    float turn = ((float)column + x) / (float)across;
    float azimuth = (0.5f - turn) * 2.0f * PI_F + dome->rotation;
    float cosine = sqrtf(fmaxf(0.0f, 1.0f - sine * sine));
    return vec3(cosine * sinf(azimuth), sine, cosine * cosf(azimuth));
}

float dome_density(const Dome *dome, Vec3 direction)
{
    int column = (int)column_coordinate(dome, direction) / dome->block;
    int row = clamp_row(dome, (int)row_coordinate(dome, direction)) / dome->block;
    return dome->density[(int64_t)row * (dome->columns / dome->block) + column];
}
