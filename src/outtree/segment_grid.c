#include "outtree/segment_grid.h"

#include "base/exact_math.h"
#include "base/memory.h"

#include <stdlib.h>

typedef struct Capsule {
    Vec3 a, b;
    float radius;
} Capsule;

// A capsule in a cell, with its bounding sphere, which rejects most.
typedef struct Entry {
    Vec3 middle;
    float bound; // m: from the centre to the capsule's ends
    int32_t capsule;
} Entry;

struct SegmentGrid {
    Capsule *capsule;
    int64_t capsule_count;
    Vec3 origin;
    float cell;
    int32_t cells[3];
    int64_t *first; // per cell, its first index in `entry`; one extra entry ends the last
    Entry *entry;   // sorted by cell
};

typedef struct CellRange {
    int32_t low[3], high[3];
} CellRange;

float segment_distance(Vec3 a0, Vec3 a1, Vec3 b0, Vec3 b1)
{
    Vec3 u = vec3_sub(a1, a0), v = vec3_sub(b1, b0), w = vec3_sub(a0, b0);
    float a = vec3_dot(u, u), e = vec3_dot(v, v), f = vec3_dot(v, w);
    float s = 0.0f, t = 0.0f;
    if (a <= 0.0f && e <= 0.0f) {
        return vec3_length(w);
    }
    if (a <= 0.0f) {
        t = clampf(f / e, 0.0f, 1.0f);
    } else {
        float c = vec3_dot(u, w);
        if (e <= 0.0f) {
            s = clampf(-c / a, 0.0f, 1.0f);
        } else {
            float b = vec3_dot(u, v), denominator = a * e - b * b;
            s = denominator > 0.0f ? clampf((b * f - c * e) / denominator, 0.0f, 1.0f) : 0.0f;
            t = (b * s + f) / e;
            if (t < 0.0f) {
                t = 0.0f;
                s = clampf(-c / a, 0.0f, 1.0f);
            } else if (t > 1.0f) {
                t = 1.0f;
                s = clampf((b - c) / a, 0.0f, 1.0f);
            }
        }
    }
    return vec3_length(vec3_sub(vec3_madd(w, s, u), vec3_scale(v, t)));
}

static int32_t cell_of(const SegmentGrid *grid, float x, int axis)
{
    float at = x / grid->cell;
    float last = (float)(grid->cells[axis] - 1);
    return (int32_t)(at > 0.0f ? (at < last ? at : last) : 0.0f);
}

static CellRange range_of(const SegmentGrid *grid, Vec3 a, Vec3 b, float reach)
{
    Vec3 low = vec3_sub(vec3_sub(vec3_min(a, b), vec3_splat(reach)), grid->origin);
    Vec3 high = vec3_sub(vec3_add(vec3_max(a, b), vec3_splat(reach)), grid->origin);
    return (CellRange){
        {cell_of(grid, low.x, 0), cell_of(grid, low.y, 1), cell_of(grid, low.z, 2)},
        {cell_of(grid, high.x, 0), cell_of(grid, high.y, 1), cell_of(grid, high.z, 2)}};
}

static int64_t cell_index(const SegmentGrid *grid, int32_t x, int32_t y, int32_t z)
{
    return ((int64_t)x * grid->cells[1] + y) * grid->cells[2] + z;
}

// About one segment per cell if they were spread evenly over the box; at most 2^24 cells.
static void choose_cells(SegmentGrid *grid, Aabb box)
{
    enum { MAX_CELLS = 1 << 24 };
    Vec3 size = vec3_sub(box.high, box.low);
    float largest = size.x > size.y ? size.x : size.y;
    largest = largest > size.z ? largest : size.z;
    double count = (double)grid->capsule_count;
    count = count > MAX_CELLS ? MAX_CELLS : count;
    double volume = (double)size.x * (double)size.y * (double)size.z;
    float cell = (float)exact_exp(exact_log(volume / (count > 1.0 ? count : 1.0) + 1e-300) / 3.0);
    float least = largest / 512.0f; // limits the number of cells of a flat box
    grid->cell = cell > least ? cell : (least > 0.0f ? least : 1.0f);
    grid->origin = box.low;
    grid->cells[0] = (int32_t)(size.x / grid->cell) + 1;
    grid->cells[1] = (int32_t)(size.y / grid->cell) + 1;
    grid->cells[2] = (int32_t)(size.z / grid->cell) + 1;
}

// Counts the capsules of each cell into first[cell + 1], or (fill) stores them.
static void visit_cells(SegmentGrid *grid, bool fill)
{
    for (int64_t i = 0; i < grid->capsule_count; i++) {
        const Capsule *c = &grid->capsule[i];
        CellRange r = range_of(grid, c->a, c->b, c->radius);
        Entry entry = {vec3_lerp(c->a, c->b, 0.5f), 0.5f * vec3_distance(c->a, c->b) + c->radius,
                       (int32_t)i};
        for (int32_t x = r.low[0]; x <= r.high[0]; x++) {
            for (int32_t y = r.low[1]; y <= r.high[1]; y++) {
                for (int32_t z = r.low[2]; z <= r.high[2]; z++) {
                    int64_t *first = &grid->first[cell_index(grid, x, y, z)];
                    if (fill) {
                        grid->entry[first[0]++] = entry;
                    } else {
                        first[1]++;
                    }
                }
            }
        }
    }
}

static bool sort_into_cells(SegmentGrid *grid, Error *e)
{
    int64_t cells = (int64_t)grid->cells[0] * grid->cells[1] * grid->cells[2];
    grid->first = memory_alloc_zero(cells + 1, sizeof *grid->first, e);
    if (!grid->first) {
        return false;
    }
    visit_cells(grid, false);
    for (int64_t i = 0; i < cells; i++) {
        grid->first[i + 1] += grid->first[i];
    }
    grid->entry = memory_alloc(grid->first[cells], sizeof *grid->entry, e);
    if (!grid->entry) {
        return false;
    }
    visit_cells(grid, true);
    for (int64_t i = cells; i > 0; i--) { // filling moved each start to the next cell's
        grid->first[i] = grid->first[i - 1];
    }
    grid->first[0] = 0;
    return true;
}

SegmentGrid *segment_grid_new(const OutTree *tree, Error *e)
{
    SegmentGrid *grid = memory_alloc_zero(1, sizeof *grid, e);
    if (grid) {
        grid->capsule = memory_alloc(tree->count, sizeof *grid->capsule, e);
    }
    if (!grid || !grid->capsule) {
        segment_grid_free(grid);
        return NULL;
    }
    Aabb box = aabb_empty();
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->parent[i] >= 0) {
            float r = tree->radius[i];
            Vec3 a = tree->position[tree->parent[i]], b = tree->position[i];
            grid->capsule[grid->capsule_count++] = (Capsule){a, b, r};
            box = aabb_add(aabb_add(box, a), b);
        }
    }
    if (grid->capsule_count > 0) {
        choose_cells(grid, box);
        if (!sort_into_cells(grid, e)) {
            segment_grid_free(grid);
            return NULL;
        }
    }
    return grid;
}

void segment_grid_free(SegmentGrid *grid)
{
    if (grid) {
        free(grid->capsule);
        free(grid->first);
        free(grid->entry);
        free(grid);
    }
}

static bool is_far(const Entry *entry, Vec3 middle, float reach)
{
    Vec3 d = vec3_sub(entry->middle, middle);
    float most = 1.0001f * (entry->bound + reach); // slightly more, for rounding
    return vec3_dot(d, d) > most * most;
}

// Every capsule is in all cells that its box overlaps, so the cells within `reach` of a-b contain
// all whose surface comes that near.
bool segment_grid_touches(const SegmentGrid *grid, Vec3 a, Vec3 b, float reach, float least_radius)
{
    if (grid->capsule_count == 0) {
        return false;
    }
    Vec3 middle = vec3_lerp(a, b, 0.5f);
    float bound = 0.5f * vec3_distance(a, b) + reach;
    CellRange r = range_of(grid, a, b, reach);
    for (int32_t x = r.low[0]; x <= r.high[0]; x++) {
        for (int32_t y = r.low[1]; y <= r.high[1]; y++) {
            for (int32_t z = r.low[2]; z <= r.high[2]; z++) {
                int64_t cell = cell_index(grid, x, y, z);
                for (int64_t k = grid->first[cell]; k < grid->first[cell + 1]; k++) {
                    if (is_far(&grid->entry[k], middle, bound)) {
                        continue;
                    }
                    const Capsule *c = &grid->capsule[grid->entry[k].capsule];
                    if (c->radius >= least_radius &&
                        segment_distance(a, b, c->a, c->b) < reach + c->radius) {
                        return true;
                    }
                }
            }
        }
    }
    return false;
}

static float gap_in_cell(const SegmentGrid *grid, int64_t cell, Vec3 a, Vec3 b, float radius,
                         float limit)
{
    Vec3 middle = vec3_lerp(a, b, 0.5f);
    float half = 0.5f * vec3_distance(a, b) + radius;
    for (int64_t k = grid->first[cell]; k < grid->first[cell + 1]; k++) {
        if (is_far(&grid->entry[k], middle, half + (limit > 0.0f ? limit : 0.0f))) {
            continue;
        }
        const Capsule *c = &grid->capsule[grid->entry[k].capsule];
        float gap = segment_distance(a, b, c->a, c->b) - radius - c->radius;
        limit = gap < limit ? gap : limit;
    }
    return limit;
}

float segment_grid_gap(const SegmentGrid *grid, Vec3 a, Vec3 b, float radius, float limit)
{
    if (grid->capsule_count == 0) {
        return limit;
    }
    CellRange r = range_of(grid, a, b, radius + (limit > 0.0f ? limit : 0.0f));
    for (int32_t x = r.low[0]; x <= r.high[0]; x++) {
        for (int32_t y = r.low[1]; y <= r.high[1]; y++) {
            for (int32_t z = r.low[2]; z <= r.high[2]; z++) {
                limit = gap_in_cell(grid, cell_index(grid, x, y, z), a, b, radius, limit);
            }
        }
    }
    return limit;
}
