// Where rock breaks: on steep land and a little around it.
#include "base/exact_math.h"
#include "land/jointing_parts.h"

#include <math.h>

static float tangent(float degrees)
{
    float sine, cosine;
    exact_sincos(degrees * 0.017453292f, &sine, &cosine);
    return sine / cosine;
}

// The mean, or the largest, of the samples within `reach` along rows (stride 1) or columns.
typedef struct Filter {
    int lines, count;
    int64_t next, stride; // from line to line, and within a line
    int reach;
    bool largest;
} Filter;

static void filter_lines(const Filter *f, const float *from, float *to, int threads)
{
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int line = 0; line < f->lines; line++) {
        const float *in = from + line * f->next;
        for (int k = 0; k < f->count; k++) {
            int low = k > f->reach ? k - f->reach : 0;
            int high = k + f->reach < f->count ? k + f->reach : f->count - 1;
            float sum = 0.0f, most = in[low * f->stride];
            for (int n = low; n <= high; n++) {
                float value = in[n * f->stride];
                sum += value;
                most = fmaxf(most, value);
            }
            to[line * f->next + k * f->stride] = f->largest ? most : sum / (float)(high - low + 1);
        }
    }
}

// In place, by way of `other`.
static void filter(const HeightField *field, float *values, float *other, int reach, bool largest,
                   int threads)
{
    Filter rows = {field->rows, field->columns, field->columns, 1, reach, largest};
    Filter columns = {field->columns, field->rows, 1, field->columns, reach, largest};
    filter_lines(&rows, values, other, threads);
    filter_lines(&columns, other, values, threads);
}

static void find_gradients(const HeightField *field, const float *rock, float *dx, float *dz,
                           int threads)
{
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int row = 0; row < field->rows; row++) {
        int north = row > 0 ? row - 1 : 0, south = row + 1 < field->rows ? row + 1 : row;
        for (int column = 0; column < field->columns; column++) {
            int west = column > 0 ? column - 1 : 0;
            int east = column + 1 < field->columns ? column + 1 : column;
            const float *h = rock + (int64_t)row * field->columns;
            int64_t i = (int64_t)row * field->columns + column;
            dx[i] = (h[east] - h[west]) / ((float)(east - west) * field->cell.x);
            dz[i] = (rock[(int64_t)south * field->columns + column] -
                     rock[(int64_t)north * field->columns + column]) /
                    ((float)(south - north) * field->cell.y);
        }
    }
}

static int samples_of(const HeightField *field, float distance)
{
    return (int)(distance / field->cell.x + 0.5f);
}

void jointing_find_steep(const JointScale *s, float *mask, float *dx, float *dz, float *other,
                         int threads)
{
    const HeightField *field = s->field;
    float least = tangent(s->params->slope - 4.0f), most = tangent(s->params->slope + 4.0f);
    find_gradients(field, s->rock, dx, dz, threads);
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int64_t i = 0; i < height_field_count(field); i++) {
        mask[i] = smoothstepf(least, most, sqrtf(dx[i] * dx[i] + dz[i] * dz[i]));
    }
    int half = samples_of(field, 0.5f * JOINT_MASK * s->spacing);
    filter(field, mask, other, half, true, threads);
    filter(field, mask, other, half > 1 ? half / 2 : 1, false, threads);
    int blur = samples_of(field, 0.4f * s->spacing);
    filter(field, dx, other, blur, false, threads);
    filter(field, dz, other, blur, false, threads);
}
