#include "grow/light/shade_sweep.h"

#include "base/exact_math.h"
#include "base/memory.h"

#include <stdlib.h>

// The axis along which the direction is longest: its layers are crossed one by one.
static int steepest_axis(Vec3 d)
{
    int axis = fabsf(d.x) > fabsf(d.y) ? 0 : 1;
    return fabsf(d.z) > fabsf(vec3_axis(d, axis)) ? 2 : axis;
}

bool leaf_layer_init(LeafLayer *layer, const ShadeGrid *grid, int ring, int threads, Error *e)
{
    SkyPart part[SKY_RING_PARTS];
    sky_ring(ring, part);
    float way = grid->cell / fabsf(vec3_axis(part[0].toward, steepest_axis(part[0].toward)));
    float depth = way / (grid->cell * grid->cell * grid->cell); // optical, of leaves of area 1
    layer->passes = memory_alloc(grid->count, sizeof *layer->passes, e);
    layer->catches = layer->passes ? memory_alloc(grid->count, sizeof *layer->catches, e) : NULL;
    if (!layer->catches) {
        return false;
    }
#pragma omp parallel for num_threads(threads) schedule(static)
    for (int64_t i = 0; i < grid->count; i++) {
        double x = (double)(depth * grid->leaf[i]);
        bool some = x > 1e-4; // below, 1 - x is exact enough
        double passes = some ? exact_exp(-x) : 1.0 - x;
        layer->passes[i] = grid->taken[i] ? 0.0f : (float)passes;
        layer->catches[i] = grid->taken[i] ? 0.0f : (some ? (float)((1.0 - passes) / x) : 1.0f);
    }
    return true;
}

void leaf_layer_clear(LeafLayer *layer)
{
    free(layer->passes);
    free(layer->catches);
    *layer = (LeafLayer){0};
}

// The plan of one sweep: layers along `axis`, each of rows along v, one below the other along u.
typedef struct Sweep {
    const LeafLayer *layer;
    int layers, rows, columns;
    int64_t layer_stride, row_stride, column_stride; // in cells of the grid
    int first, step;                                 // of the layers, from the sky's side
    int row_shift, column_shift;                     // to the nearer one of the cells before
    float row_share, column_share;                   // of the farther ones
    float weight;
    Vec3 toward;
} Sweep;

static Sweep plan_sweep(const ShadeGrid *grid, const LeafLayer *layer, const SkyPart *part)
{
    const int64_t stride[3] = {1, (int64_t)grid->size[0] * grid->size[2], grid->size[0]};
    static const int row_axis[3] = {1, 2, 1}, column_axis[3] = {2, 0, 0};
    int axis = steepest_axis(part->toward), u = row_axis[axis], v = column_axis[axis];
    float steep = vec3_axis(part->toward, axis);
    float a = vec3_axis(part->toward, u) / fabsf(steep);
    float b = vec3_axis(part->toward, v) / fabsf(steep);
    Sweep sweep = {.layer = layer,
                   .layers = grid->size[axis],
                   .rows = grid->size[u],
                   .columns = grid->size[v],
                   .layer_stride = stride[axis],
                   .row_stride = stride[u],
                   .column_stride = stride[v],
                   .first = steep > 0.0f ? grid->size[axis] - 1 : 0,
                   .step = steep > 0.0f ? -1 : 1,
                   .row_shift = a < 0.0f ? -1 : 0,
                   .column_shift = b < 0.0f ? -1 : 0,
                   .weight = part->weight,
                   .toward = part->toward};
    sweep.row_share = a - (float)sweep.row_shift;
    sweep.column_share = b - (float)sweep.column_shift;
    return sweep;
}

// One row of a layer. before: what left the layer before, at the cell's shifted place, and the row
// after it; after: what leaves this row. Both have a border of 1.
static void sweep_row(const Sweep *s, int64_t cell, const float *before, int64_t width,
                      float *after, float *const sum[4])
{
    float r = s->row_share, c = s->column_share;
    float near = (1.0f - r) * (1.0f - c), side = (1.0f - r) * c, below = r * (1.0f - c),
          far = r * c;
    const float *passes = s->layer->passes + cell, *catches = s->layer->catches + cell;
    float *light = sum[0] + cell, *x = sum[1] + cell, *y = sum[2] + cell, *z = sum[3] + cell;
    Vec3 toward = vec3_scale(s->toward, s->weight);
    int64_t stride = s->column_stride;
    for (int64_t i = 0; i < s->columns; i++) {
        float enters = near * before[i] + side * before[i + 1] + below * before[i + width] +
                       far * before[i + width + 1];
        int64_t at = i * stride;
        after[i] = enters * passes[at];
        light[at] += s->weight * enters * catches[at];
        x[at] += toward.x * enters;
        y[at] += toward.y * enters;
        z[at] += toward.z * enters;
    }
}

bool shade_sweep(const ShadeGrid *grid, const LeafLayer *layer, const SkyPart *part, float *sum[4],
                 Error *e)
{
    Sweep s = plan_sweep(grid, layer, part);
    int64_t width = s.columns + 2, cells = width * (s.rows + 2);
    float *before = memory_alloc(2 * cells, sizeof *before, e);
    if (!before) {
        return false;
    }
    float *const both = before;
    float *after = before + cells;
    for (int64_t i = 0; i < 2 * cells; i++) {
        both[i] = 1.0f;
    }
    for (int k = 0, number = s.first; k < s.layers; k++, number += s.step) {
        for (int row = 0; row < s.rows; row++) {
            int64_t cell = number * s.layer_stride + row * s.row_stride;
            const float *from = before + (row + 1 + s.row_shift) * width + 1 + s.column_shift;
            sweep_row(&s, cell, from, width, after + (row + 1) * width + 1, sum);
        }
        float *swap = before;
        before = after;
        after = swap;
    }
    free(both);
    return true;
}
