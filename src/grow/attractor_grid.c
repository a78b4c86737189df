#include "grow/attractor_grid.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

// Uninitialised table for random access: backed by huge pages if large, which saves TLB misses.
// Release with free().
static void *alloc_table(int64_t count, size_t size, Error *e)
{
    const size_t page = (size_t)1 << 21;
    size_t bytes = (size_t)count * size; // counts here are below 2^33, sizes below 2^8
    size_t align = bytes < 4 * page ? 64 : page;
    bytes = (bytes + align) / align * align;
    void *table = aligned_alloc(align, bytes);
    if (!table) {
        error_set(e, ERROR_MEMORY, "out of memory: %.1f MB more were needed", (double)bytes * 1e-6);
    } else if (align == page) {
        madvise(table, bytes, MADV_HUGEPAGE); // a hint only
    }
    return table;
}

int attractor_grid_cell_along(const AttractorGrid *grid, int axis, float offset)
{
    float c = offset / grid->cell;
    int last = grid->size[axis] - 1;
    return c <= 0.0f ? 0 : (c >= (float)last ? last : (int)c);
}

static int64_t cell_of(const AttractorGrid *grid, Vec3 p)
{
    int64_t x = attractor_grid_cell_along(grid, 0, p.x - grid->low.x);
    int64_t y = attractor_grid_cell_along(grid, 1, p.y - grid->low.y);
    return (x * grid->size[1] + y) * grid->size[2] +
           attractor_grid_cell_along(grid, 2, p.z - grid->low.z);
}

static bool bounds_of(const PointSet *points, Aabb *box, const Run *run, Error *e)
{
    *box = aabb_empty();
    for (int64_t i = 0; i < points->count; i++) {
        if (!run_goes_on(run, i, e)) {
            return false;
        }
        if (!vec3_finite(points->position[i])) {
            return error_set(e, ERROR_INPUT, "attractor %lld is not a finite position",
                             (long long)i);
        }
        *box = aabb_add(*box, points->position[i]);
    }
    return true;
}

static double cells_along(double extent, double cell)
{
    return (double)(int64_t)(extent / cell) + 1.0;
}

// About eight attractors per cell if they are evenly spread, or three cells per influence radius if
// that is coarser, but never many more cells than attractors.
static void choose_cells(AttractorGrid *grid, Aabb box, const PointSet *points)
{
    double extent[3] = {(double)box.high.x - (double)box.low.x,
                        (double)box.high.y - (double)box.low.y,
                        (double)box.high.z - (double)box.low.z};
    double largest = extent[0] > extent[1] ? extent[0] : extent[1];
    largest = largest > extent[2] ? largest : extent[2];
    double spacing = points_spacing(points);
    double fine = (points->dimension == 2 ? 2.8 : 2.0) * spacing, coarse = 2.0 * fine;
    double cell = (double)grid->reach / 3.0;
    cell = cell < fine || spacing == 0.0 ? fine : (cell > coarse ? coarse : cell);
    cell = cell > largest * 1e-4 ? cell : largest * 1e-4;
    cell = cell > 1e-30 ? cell : 1.0;
    double count = (double)points->count, limit = (spacing > 0.0 ? 2.0 : 0.2) * count + 64.0;
    limit = limit < 1e9 ? limit : 1e9;
    while (cells_along(extent[0], cell) * cells_along(extent[1], cell) *
               cells_along(extent[2], cell) >
           limit) {
        cell *= 1.1;
    }
    float magnitude = 0.0f;
    const float corner[6] = {box.low.x, box.low.y, box.low.z, box.high.x, box.high.y, box.high.z};
    for (int i = 0; i < 6; i++) {
        magnitude = fabsf(corner[i]) > magnitude ? fabsf(corner[i]) : magnitude;
    }
    grid->low = box.low;
    grid->cell = (float)cell;
    grid->slack = 4e-6f * magnitude;
    for (int axis = 0; axis < 3; axis++) {
        grid->size[axis] = (int)cells_along(extent[axis], cell);
    }
    grid->axis = grid->size[0] >= grid->size[1] ? 0 : 1;
    grid->cell_count = (int64_t)grid->size[0] * grid->size[1] * grid->size[2];
}

typedef struct CellRange {
    int64_t begin, end;
} CellRange;

// Range of cells that one of `parts` threads fills; it looks at all points for those in its range.
static CellRange cells_of_part(const AttractorGrid *grid, int part, int parts)
{
    return (CellRange){grid->cell_count * part / parts, grid->cell_count * (part + 1) / parts};
}

// Counts the points of every cell into cells[].count; cell: the cell of every point.
static void count_cells(AttractorGrid *grid, const PointSet *points, int threads, int32_t *cell)
{
    memset(grid->cells, 0, (size_t)grid->cell_count * sizeof *grid->cells);
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int64_t i = 0; i < points->count; i++) {
        cell[i] = (int32_t)cell_of(grid, points->position[i]);
    }
#pragma omp parallel for schedule(static, 1) num_threads(threads)
    for (int part = 0; part < threads; part++) {
        CellRange range = cells_of_part(grid, part, threads);
        for (int64_t i = 0; i < points->count; i++) {
            if (cell[i] >= range.begin && cell[i] < range.end) {
                grid->cells[cell[i]].count++;
            }
        }
    }
}

// Assigns every cell its empty blocks; returns their number.
static int64_t place_blocks(AttractorGrid *grid)
{
    int32_t blocks = 0; // at most one a point
    for (int64_t c = 0; c < grid->cell_count; c++) {
        AttractorCell *cell = &grid->cells[c];
        grid->furthest[c] = cell->count > 0 ? grid->reach2 : -1.0f;
        cell->first_block = blocks;
        blocks += (cell->count + LANES - 1) / LANES;
        cell->count = 0;
    }
    for (int i = 0; i < LANES; i++) {
        grid->furthest[grid->cell_count + i] = -1.0f; // padding: reading a row's last cells runs
                                                      // past its end
    }
    return blocks;
}

static void place_point(AttractorGrid *grid, AttractorCell *cell, Vec3 p, int32_t source)
{
    int32_t place = cell->count++;
    AttractorBlock *block = &grid->block[cell->first_block + place / LANES];
    int lane = place % LANES;
    if (lane == 0) {
        *block = (AttractorBlock){0};
        block->best -= 1.0f;
        block->nearest -= 1;
    }
    block->x[lane] = p.x;
    block->y[lane] = p.y;
    block->z[lane] = p.z;
    block->best[lane] = grid->reach2;
    block->source[lane] = source;
}

// Sorts the points into their cells, in index order.
static bool fill_cells(AttractorGrid *grid, const PointSet *points, const Run *run, Error *e)
{
    int32_t *cell = memory_alloc(points->count, sizeof *cell, e);
    if (!cell) {
        return false;
    }
    int threads = run->threads > 1 ? run->threads : 1;
    count_cells(grid, points, threads, cell);
    int64_t blocks = place_blocks(grid);
    grid->block = alloc_table(blocks, sizeof *grid->block, e);
    if (!grid->block) {
        free(cell);
        return false;
    }
#pragma omp parallel for schedule(static, 1) num_threads(threads)
    for (int part = 0; part < threads; part++) {
        CellRange range = cells_of_part(grid, part, threads);
        for (int64_t i = 0; i < points->count && run_goes_on(run, i, NULL); i++) {
            if (cell[i] >= range.begin && cell[i] < range.end) {
                place_point(grid, &grid->cells[cell[i]], points->position[i], (int32_t)i);
            }
        }
    }
    free(cell);
    return !run_is_cancelled(run) || run_cancel_error(e);
}

// Gives every slice an empty list with room for its cells; false if there is no memory for them.
static bool begin_active(AttractorGrid *grid)
{
    int slices = grid->size[grid->axis];
    for (int s = 0; s < slices && grid->active && grid->active_table; s++) {
        grid->active[s].cell = grid->active_table + grid->cell_count / slices * s;
        grid->active[s].count = grid->active[s].empty = 0;
    }
    return grid->active && grid->active_table;
}

bool attractor_grid_init(AttractorGrid *grid, const PointSet *points, float reach, float kill,
                         const Run *run, Error *e)
{
    *grid = (AttractorGrid){.reach = reach, .reach2 = reach * reach, .kill2 = kill * kill};
    Aabb box;
    if (!bounds_of(points, &box, run, e)) {
        return false;
    }
    grid->alive = points->count;
    choose_cells(grid, box, points);
    int64_t cells = grid->cell_count;
    grid->cells = alloc_table(cells, sizeof *grid->cells, e);
    grid->state = memory_alloc_zero(cells, sizeof *grid->state, e);
    grid->furthest = alloc_table(cells + LANES, sizeof *grid->furthest, e);
    grid->touched = memory_alloc(cells, sizeof *grid->touched, e);
    grid->active_table = memory_alloc(cells, sizeof *grid->active_table, e);
    grid->active = memory_alloc(grid->size[grid->axis], sizeof *grid->active, e);
    int longest = grid->size[0] > grid->size[1] ? grid->size[0] : grid->size[1];
    grid->work = memory_alloc(longest + 1, sizeof *grid->work, e);
    int64_t gaps = (int64_t)grid->size[0] + grid->size[1] + grid->size[2] + 3 * LANES;
    grid->gap2 = memory_alloc(ATTRACTOR_MAX_SLABS * gaps, sizeof *grid->gap2, e);
    return grid->work && grid->gap2 && grid->cells && grid->state && grid->furthest &&
           grid->touched && begin_active(grid) && fill_cells(grid, points, run, e);
}

void attractor_grid_free(AttractorGrid *grid)
{
    free(grid->cells);
    free(grid->state);
    free(grid->furthest);
    free(grid->touched);
    free(grid->work);
    free(grid->gap2);
    free(grid->active_table);
    free(grid->active);
    free(grid->block);
    *grid = (AttractorGrid){0};
}
