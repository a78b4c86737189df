#include "field/field_grid.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

enum { BLOCK = 8, CORNERS = BLOCK + 1, LEAF = CORNERS * CORNERS * CORNERS };

// A block gets no leaf if interpolating its corners errs by at most this much at every voxel.
#define TOLERANCE 0.01f

static Vec3 trilinear(const Vec3 *v, int64_t stride_x, int64_t stride_y, Vec3 t)
{
    Vec3 x00 = vec3_lerp(v[0], v[stride_x], t.x);
    Vec3 x10 = vec3_lerp(v[stride_y], v[stride_y + stride_x], t.x);
    Vec3 x01 = vec3_lerp(v[1], v[stride_x + 1], t.x);
    Vec3 x11 = vec3_lerp(v[stride_y + 1], v[stride_y + stride_x + 1], t.x);
    return vec3_lerp(vec3_lerp(x00, x10, t.y), vec3_lerp(x01, x11, t.y), t.z);
}

static int64_t corner_index(const FieldGrid *grid, int x, int y, int z)
{
    return ((int64_t)x * (grid->blocks[1] + 1) + y) * (grid->blocks[2] + 1) + z;
}

static Vec3 interpolate_corners(const FieldGrid *grid, const int block[3], Vec3 t)
{
    int64_t stride_y = grid->blocks[2] + 1, stride_x = stride_y * (grid->blocks[1] + 1);
    return trilinear(grid->corner + corner_index(grid, block[0], block[1], block[2]), stride_x,
                     stride_y, t);
}

static Vec3 voxel_position(const FieldGrid *grid, int x, int y, int z)
{
    return vec3_madd(grid->low, grid->voxel, vec3((float)x, (float)y, (float)z));
}

// Samples a block's voxels; returns whether its corners represent them within the tolerance.
static bool sample_leaf(const FieldGrid *grid, FieldFunction *f, const void *context,
                        const int block[3], Vec3 *value)
{
    float worst = 0.0f;
    for (int i = 0; i < LEAF; i++) {
        int x = i / (CORNERS * CORNERS), y = i / CORNERS % CORNERS, z = i % CORNERS;
        value[i] = f(context, voxel_position(grid, block[0] * BLOCK + x, block[1] * BLOCK + y,
                                             block[2] * BLOCK + z));
        Vec3 t = vec3_scale(vec3((float)x, (float)y, (float)z), 1.0f / BLOCK);
        float miss = vec3_distance(value[i], interpolate_corners(grid, block, t));
        worst = miss > worst ? miss : worst;
    }
    return worst <= TOLERANCE;
}

static void block_of(const FieldGrid *grid, int64_t b, int block[3])
{
    block[2] = (int)(b % grid->blocks[2]);
    block[1] = (int)(b / grid->blocks[2] % grid->blocks[1]);
    block[0] = (int)(b / grid->blocks[2] / grid->blocks[1]);
}

static bool sample_corners(FieldGrid *grid, FieldFunction *f, const void *context, const Run *run,
                           Error *e)
{
#pragma omp parallel for schedule(static) num_threads(run->threads)
    for (int x = 0; x <= grid->blocks[0]; x++) {
        for (int y = 0; y <= grid->blocks[1] && !run_is_cancelled(run); y++) {
            for (int z = 0; z <= grid->blocks[2]; z++) {
                grid->corner[corner_index(grid, x, y, z)] =
                    f(context, voxel_position(grid, x * BLOCK, y * BLOCK, z * BLOCK));
            }
        }
    }
    return !run_is_cancelled(run) || run_cancel_error(e);
}

// Three passes: which blocks need a leaf, the leaves' numbers, their values. So the layout does not
// depend on the number of threads.
static bool sample_leaves(FieldGrid *grid, FieldFunction *f, const void *context, const Run *run,
                          Error *e)
{
    int64_t blocks = (int64_t)grid->blocks[0] * grid->blocks[1] * grid->blocks[2];
#pragma omp parallel for schedule(dynamic, 4) num_threads(run->threads)
    for (int64_t b = 0; b < blocks; b++) {
        int block[3];
        Vec3 value[LEAF];
        if (run_is_cancelled(run)) {
            continue;
        }
        block_of(grid, b, block);
        grid->leaf[b] = sample_leaf(grid, f, context, block, value) ? -1 : 0;
    }
    if (run_is_cancelled(run)) {
        return run_cancel_error(e);
    }
    for (int64_t b = 0; b < blocks; b++) {
        grid->leaf[b] = grid->leaf[b] < 0 ? -1 : (int32_t)grid->leaf_count++;
    }
    if (!memory_check((double)grid->leaf_count * LEAF * sizeof *grid->value, e,
                      "the %lld blocks of a field's grid", (long long)grid->leaf_count)) {
        return false;
    }
    grid->value = memory_alloc(grid->leaf_count, LEAF * sizeof *grid->value, e);
    if (!grid->value) {
        return false;
    }
#pragma omp parallel for schedule(dynamic, 4) num_threads(run->threads)
    for (int64_t b = 0; b < blocks; b++) {
        if (grid->leaf[b] >= 0 && !run_is_cancelled(run)) {
            int block[3];
            block_of(grid, b, block);
            sample_leaf(grid, f, context, block, grid->value + (int64_t)grid->leaf[b] * LEAF);
        }
    }
    return !run_is_cancelled(run) || run_cancel_error(e);
}

bool field_grid_init(FieldGrid *grid, FieldFunction *f, const void *context, Aabb bounds,
                     int resolution, const Run *run, Error *e)
{
    *grid = (FieldGrid){.low = bounds.low};
    if (resolution < 1 || resolution > 2048) {
        return error_set(e, ERROR_INPUT, "field resolution %d; it must be 1 to 2048", resolution);
    }
    Vec3 extent = vec3_sub(bounds.high, bounds.low);
    float longest = extent.x > extent.y ? extent.x : extent.y;
    longest = longest > extent.z ? longest : extent.z;
    if (!(longest >= 0.0f && isfinite(longest))) {
        return error_set(e, ERROR_INPUT, "a grid field needs attractors to lie around");
    }
    grid->voxel = longest > 0.0f ? longest / (float)resolution : 1.0f;
    const float along[3] = {extent.x, extent.y, extent.z};
    int64_t corners = 1, blocks = 1;
    for (int axis = 0; axis < 3; axis++) {
        grid->blocks[axis] = (int)(along[axis] / (grid->voxel * BLOCK)) + 1;
        corners *= grid->blocks[axis] + 1;
        blocks *= grid->blocks[axis];
    }
    grid->corner = memory_alloc(corners, sizeof *grid->corner, e);
    grid->leaf = memory_alloc(blocks, sizeof *grid->leaf, e);
    if (!grid->corner || !grid->leaf) {
        return false;
    }
    return sample_corners(grid, f, context, run, e) && sample_leaves(grid, f, context, run, e);
}

void field_grid_free(FieldGrid *grid)
{
    free(grid->corner);
    free(grid->leaf);
    free(grid->value);
    *grid = (FieldGrid){0};
}

// Splits t (in cells) into a cell index in 0..count-1 and the fraction inside the cell.
static int split(float *t, int count)
{
    float x = clampf(*t, 0.0f, (float)count);
    int cell = (int)x < count ? (int)x : count - 1;
    *t = x - (float)cell;
    return cell;
}

Vec3 field_grid_at(const FieldGrid *grid, Vec3 p)
{
    Vec3 t = vec3_scale(vec3_sub(p, grid->low), 1.0f / (grid->voxel * BLOCK));
    int block[3] = {split(&t.x, grid->blocks[0]), split(&t.y, grid->blocks[1]),
                    split(&t.z, grid->blocks[2])};
    int64_t b = ((int64_t)block[0] * grid->blocks[1] + block[1]) * grid->blocks[2] + block[2];
    if (grid->leaf[b] < 0) {
        return interpolate_corners(grid, block, t);
    }
    t = vec3_scale(t, BLOCK);
    int x = split(&t.x, BLOCK), y = split(&t.y, BLOCK), z = split(&t.z, BLOCK);
    const Vec3 *v = grid->value + (int64_t)grid->leaf[b] * LEAF;
    return trilinear(v + (x * CORNERS + y) * CORNERS + z, CORNERS * CORNERS, CORNERS, t);
}
