#include "grow/light/shade_grid.h"

#include "base/memory.h"
#include "grow/light/shade_sweep.h"
#include "grow/light/sky_parts.h"

#include <stdlib.h>

// The eight cells nearest to a point and their weights, which add up to 1.
typedef struct Corners {
    int64_t cell[8];
    float weight[8];
} Corners;

static int cells_along(float length, float cell)
{
    float cells = length / cell;
    return cells < 4e6f ? (int)cells + 1 : 4000000;
}

ShadeGrid *shade_grid_new(Aabb box, float cell, int64_t most, Error *e)
{
    ShadeGrid *grid = memory_alloc_zero(1, sizeof *grid, e);
    if (!grid) {
        return NULL;
    }
    Vec3 extent = vec3_sub(box.high, box.low);
    for (;; cell *= 1.15f) {
        grid->size[0] = cells_along(extent.x, cell) + 1;
        grid->size[1] = cells_along(extent.y, cell) + 1;
        grid->size[2] = cells_along(extent.z, cell) + 1;
        if ((double)grid->size[0] * grid->size[1] * grid->size[2] <= (double)most ||
            vec3_largest(extent) < cell) {
            break;
        }
    }
    grid->cell = cell;
    grid->low = box.low;
    grid->count = (int64_t)grid->size[0] * grid->size[1] * grid->size[2];
    grid->leaf = memory_alloc_zero(grid->count, sizeof *grid->leaf, e);
    grid->taken = grid->leaf ? memory_alloc_zero(grid->count, sizeof *grid->taken, e) : NULL;
    grid->light = grid->taken ? memory_alloc_zero(grid->count, sizeof *grid->light, e) : NULL;
    bool good = grid->light;
    for (int i = 0; i < 3 && good; i++) {
        grid->bright[i] = memory_alloc_zero(grid->count, sizeof *grid->bright[i], e);
        good = grid->bright[i];
    }
    if (!good) {
        shade_grid_free(grid);
        return NULL;
    }
    return grid;
}

void shade_grid_free(ShadeGrid *grid)
{
    if (grid) {
        free(grid->leaf);
        free(grid->taken);
        free(grid->light);
        for (int i = 0; i < 3; i++) {
            free(grid->bright[i]);
        }
        free(grid);
    }
}

// The lower one of the two cells whose middles are on both sides of x, and the share of the upper.
static int lower_cell(float x, int cells, float *upper)
{
    float at = clampf(x - 0.5f, 0.0f, (float)(cells - 1));
    int low = (int)at;
    low = low < cells - 2 ? low : cells - 2;
    low = low > 0 ? low : 0;
    *upper = cells > 1 ? at - (float)low : 0.0f;
    return low;
}

static Corners find_corners(const ShadeGrid *grid, Vec3 p)
{
    Vec3 at = vec3_scale(vec3_sub(p, grid->low), 1.0f / grid->cell), up;
    int x = lower_cell(at.x, grid->size[0], &up.x);
    int y = lower_cell(at.y, grid->size[1], &up.y);
    int z = lower_cell(at.z, grid->size[2], &up.z);
    int64_t row = grid->size[0], layer = row * grid->size[2];
    int64_t base = y * layer + z * row + x;
    Corners corners;
    for (int i = 0; i < 8; i++) {
        int dx = i & 1, dy = i >> 1 & 1, dz = i >> 2;
        float weight =
            (dx ? up.x : 1.0f - up.x) * (dy ? up.y : 1.0f - up.y) * (dz ? up.z : 1.0f - up.z);
        int64_t cell = base + dy * layer + dz * row + dx;
        corners.cell[i] = weight > 0.0f ? cell : base; // a side with one cell has no upper
        corners.weight[i] = weight;
    }
    return corners;
}

void shade_grid_add_leaves(ShadeGrid *grid, Vec3 p, float area)
{
    Corners corners = find_corners(grid, p);
    for (int i = 0; i < 8; i++) {
        grid->leaf[corners.cell[i]] += corners.weight[i] * area;
    }
}

// Units of counted leaves in the area of a cell's face.
#define COUNT_UNITS 16777216.0f

void shade_grid_count_leaves(const ShadeGrid *grid, Vec3 p, float area, int64_t *sum)
{
    Corners corners = find_corners(grid, p);
    float units = COUNT_UNITS * area / (grid->cell * grid->cell);
    for (int i = 0; i < 8; i++) {
        int64_t some = (int64_t)(corners.weight[i] * units + 0.5f);
#pragma omp atomic
        sum[corners.cell[i]] += some;
    }
}

void shade_grid_set_leaves(ShadeGrid *grid, const int64_t *sum)
{
    float unit = grid->cell * grid->cell / COUNT_UNITS;
    for (int64_t i = 0; i < grid->count; i++) {
        grid->leaf[i] = unit * (float)sum[i];
    }
}

static float interpolate(const float *value, const Corners *corners)
{
    float sum = 0.0f;
    for (int i = 0; i < 8; i++) {
        sum += corners->weight[i] * value[corners->cell[i]];
    }
    return sum;
}

float shade_grid_light(const ShadeGrid *grid, Vec3 p)
{
    Corners corners = find_corners(grid, p);
    return interpolate(grid->light, &corners);
}

Vec3 shade_grid_brightest(const ShadeGrid *grid, Vec3 p)
{
    Corners corners = find_corners(grid, p);
    return vec3(interpolate(grid->bright[0], &corners), interpolate(grid->bright[1], &corners),
                interpolate(grid->bright[2], &corners));
}

double shade_grid_incoming(const ShadeGrid *grid)
{
    double side[3], sum = 0.0;
    for (int i = 0; i < 3; i++) {
        side[i] = (double)grid->size[i] * (double)grid->cell;
    }
    for (int ring = 0; ring < SKY_RINGS; ring++) {
        SkyPart part[SKY_RING_PARTS];
        int parts = sky_ring(ring, part);
        for (int i = 0; i < parts; i++) {
            Vec3 d = part[i].toward;
            sum += (double)part[i].weight * ((double)fabsf(d.x) * side[1] * side[2] +
                                             (double)fabsf(d.y) * side[0] * side[2] +
                                             (double)fabsf(d.z) * side[0] * side[1]);
        }
    }
    return sum;
}

// A group of parts of the sky with sums of its own, so that threads do not meet. The groups do not
// depend on the number of threads, and their sums are added in order.
typedef struct Group {
    int ring, first, parts;
    float *sum[4]; // light, bright
} Group;

enum { GROUPS = 7, GROUP_PARTS = 4 };

static int plan_groups(Group group[GROUPS])
{
    int count = 0;
    for (int ring = 0; ring < SKY_RINGS; ring++) {
        SkyPart part[SKY_RING_PARTS];
        int parts = sky_ring(ring, part);
        for (int first = 0; first < parts; first += GROUP_PARTS) {
            int left = parts - first;
            group[count++] = (Group){ring, first, left < GROUP_PARTS ? left : GROUP_PARTS, {NULL}};
        }
    }
    return count;
}

static bool sweep_group(const ShadeGrid *grid, const LeafLayer layers[SKY_RINGS], Group *group,
                        Error *e)
{
    SkyPart part[SKY_RING_PARTS];
    sky_ring(group->ring, part);
    group->sum[0] = memory_alloc_zero(4 * grid->count, sizeof(float), e);
    if (!group->sum[0]) {
        return false;
    }
    for (int k = 1; k < 4; k++) {
        group->sum[k] = group->sum[0] + k * grid->count;
    }
    for (int i = 0; i < group->parts; i++) {
        if (!shade_sweep(grid, &layers[group->ring], &part[group->first + i], group->sum, e)) {
            return false;
        }
    }
    return true;
}

static void add_groups(ShadeGrid *grid, const Group *group, int groups, int threads)
{
    float *into[4] = {grid->light, grid->bright[0], grid->bright[1], grid->bright[2]};
#pragma omp parallel for num_threads(threads) schedule(static)
    for (int64_t i = 0; i < grid->count; i++) {
        for (int k = 0; k < 4; k++) {
            float sum = 0.0f;
            for (int g = 0; g < groups; g++) {
                sum += group[g].sum[k][i];
            }
            into[k][i] = sum;
        }
    }
}

bool shade_grid_solve(ShadeGrid *grid, int threads, Error *e)
{
    Group group[GROUPS];
    LeafLayer layers[SKY_RINGS] = {{0}};
    Error failed[GROUPS] = {{0}};
    int groups = plan_groups(group);
    threads = grid->count < 4000 ? 1 : threads; // a team would cost more than it saves
    bool done = true;
    for (int ring = 0; done && ring < SKY_RINGS; ring++) {
        done = leaf_layer_init(&layers[ring], grid, ring, threads, e);
    }
    if (done) {
#pragma omp parallel for num_threads(threads) schedule(dynamic)
        for (int g = 0; g < groups; g++) {
            sweep_group(grid, layers, &group[g], &failed[g]);
        }
    }
    for (int g = 0; done && g < groups; g++) {
        done = failed[g].code == ERROR_NONE;
        if (!done && e) {
            *e = failed[g];
        }
    }
    if (done) {
        add_groups(grid, group, groups, threads);
    }
    for (int g = 0; g < groups; g++) {
        free(group[g].sum[0]);
    }
    for (int ring = 0; ring < SKY_RINGS; ring++) {
        leaf_layer_clear(&layers[ring]);
    }
    return done;
}
