#include "grow/attractor_grid.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

enum { CELL_TOUCHED = 1, CELL_ACTIVE = 2 };
enum { SLABS_PER_THREAD = 4, MAX_SLABS = 256 };

// Shrinks distances to cells so that rounding can never make one look further than a point in it.
#define CAUTION 0.999999f

static int cell_along(const AttractorGrid *grid, int axis, float offset)
{
    float c = offset / grid->cell;
    int last = grid->size[axis] - 1;
    return c <= 0.0f ? 0 : (c >= (float)last ? last : (int)c);
}

static int64_t cell_of(const AttractorGrid *grid, Vec3 p)
{
    int64_t x = cell_along(grid, 0, p.x - grid->low.x);
    int64_t y = cell_along(grid, 1, p.y - grid->low.y);
    return (x * grid->size[1] + y) * grid->size[2] + cell_along(grid, 2, p.z - grid->low.z);
}

static bool bounds_of(const PointSet *points, Aabb *box, Error *e)
{
    *box = aabb_empty();
    for (int64_t i = 0; i < points->count; i++) {
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

// About eight attractors a cell where they are evenly spread, three cells to the reach where that
// is coarser, and never many more cells than attractors.
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
    grid->cell_count = (int64_t)grid->size[0] * grid->size[1] * grid->size[2];
}

// Sorts the points into their cells, in order of their index.
static bool fill_cells(AttractorGrid *grid, const PointSet *points, Error *e)
{
    int32_t *cell = memory_alloc(points->count, sizeof *cell, e);
    if (!cell) {
        return false;
    }
    for (int64_t i = 0; i < points->count; i++) {
        cell[i] = (int32_t)cell_of(grid, points->position[i]);
        grid->count[cell[i]]++;
    }
    int64_t blocks = 0;
    for (int64_t c = 0; c < grid->cell_count; c++) {
        grid->first_block[c] = blocks;
        grid->furthest[c] = grid->count[c] > 0 ? grid->reach2 : -1.0f;
        blocks += (grid->count[c] + BLOCK_LANES - 1) / BLOCK_LANES;
        grid->count[c] = 0;
    }
    grid->block = aligned_alloc(64, (size_t)(blocks + 1) * sizeof(AttractorBlock));
    grid->source = memory_alloc(blocks * BLOCK_LANES, sizeof *grid->source, e);
    if (!grid->block || !grid->source) {
        free(cell);
        return error_set(e, ERROR_MEMORY, "out of memory: %.1f MB more were needed",
                         (double)blocks * sizeof(AttractorBlock) * 1e-6);
    }
    for (int64_t b = 0; b < blocks; b++) {
        for (int lane = 0; lane < BLOCK_LANES; lane++) {
            AttractorBlock *block = &grid->block[b];
            block->x[lane] = block->y[lane] = block->z[lane] = 0.0f;
            block->best[lane] = -1.0f;
            block->nearest[lane] = block->previous[lane] = -1;
        }
    }
    for (int64_t i = 0; i < points->count; i++) {
        int32_t place = grid->count[cell[i]]++;
        int64_t b = grid->first_block[cell[i]] + place / BLOCK_LANES;
        int lane = place % BLOCK_LANES;
        grid->block[b].x[lane] = points->position[i].x;
        grid->block[b].y[lane] = points->position[i].y;
        grid->block[b].z[lane] = points->position[i].z;
        grid->block[b].best[lane] = grid->reach2;
        grid->source[b * BLOCK_LANES + lane] = (int32_t)i;
    }
    free(cell);
    return true;
}

bool attractor_grid_init(AttractorGrid *grid, const PointSet *points, float reach, float kill,
                         Error *e)
{
    *grid = (AttractorGrid){.reach = reach, .reach2 = reach * reach, .kill2 = kill * kill};
    Aabb box;
    if (!bounds_of(points, &box, e)) {
        return false;
    }
    grid->alive = points->count;
    choose_cells(grid, box, points);
    int64_t cells = grid->cell_count;
    grid->first_block = memory_alloc(cells, sizeof *grid->first_block, e);
    grid->count = memory_alloc_zero(cells, sizeof *grid->count, e);
    grid->furthest = memory_alloc_zero(cells + BLOCK_LANES, sizeof *grid->furthest, e);
    grid->state = memory_alloc_zero(cells, sizeof *grid->state, e);
    grid->touched = memory_alloc(cells, sizeof *grid->touched, e);
    grid->active = memory_alloc(cells, sizeof *grid->active, e);
    int longest = grid->size[0] > grid->size[1] ? grid->size[0] : grid->size[1];
    grid->work = memory_alloc(longest + 1, sizeof *grid->work, e);
    grid->gap2 =
        memory_alloc((int64_t)MAX_SLABS * (grid->size[2] + BLOCK_LANES), sizeof *grid->gap2, e);
    return grid->work && grid->gap2 && grid->first_block && grid->count && grid->furthest &&
           grid->state && grid->touched && grid->active && fill_cells(grid, points, e);
}

void attractor_grid_free(AttractorGrid *grid)
{
    free(grid->first_block);
    free(grid->count);
    free(grid->furthest);
    free(grid->state);
    free(grid->touched);
    free(grid->work);
    free(grid->gap2);
    free(grid->active);
    free(grid->block);
    free(grid->source);
    *grid = (AttractorGrid){0};
}

// Offers node k at p to the attractors of a cell.
static void offer_to_cell(AttractorGrid *grid, int64_t cell, Vec3 p, int32_t k, int32_t *touched,
                          int64_t *touched_count)
{
    AttractorBlock *block = grid->block + grid->first_block[cell];
    int blocks = (grid->count[cell] + BLOCK_LANES - 1) / BLOCK_LANES;
    float furthest[BLOCK_LANES] = {0};
    int any[BLOCK_LANES] = {0};
    for (int b = 0; b < blocks; b++) {
        AttractorBlock *a = &block[b];
#pragma omp simd
        for (int i = 0; i < BLOCK_LANES; i++) {
            float dx = a->x[i] - p.x, dy = a->y[i] - p.y, dz = a->z[i] - p.z;
            float d = dx * dx + dy * dy + dz * dz;
            float best = a->best[i];
            int closer = d < best;
            best = closer ? d : best;
            a->best[i] = best;
            a->nearest[i] = closer ? k : a->nearest[i];
            furthest[i] = best > furthest[i] ? best : furthest[i];
            any[i] |= closer;
        }
    }
    float most = 0.0f;
    int changed = 0;
#pragma omp simd reduction(max : most) reduction(| : changed)
    for (int i = 0; i < BLOCK_LANES; i++) {
        most = furthest[i] > most ? furthest[i] : most;
        changed |= any[i];
    }
    if (changed) {
        grid->furthest[cell] = most;
        if (!(grid->state[cell] & CELL_TOUCHED)) {
            grid->state[cell] |= CELL_TOUCHED;
            touched[(*touched_count)++] = (int32_t)cell;
        }
    }
}

// Squared distances (never too large) from the coordinate p to cells begin..end-1 of an axis.
static void gaps_along(const AttractorGrid *grid, float low, float p, int begin, int end,
                       float *gap2)
{
    for (int c = begin; c < end; c++) {
        float a = low + (float)c * grid->cell - p, b = -a - grid->cell;
        float gap = (a > b ? a : b) - grid->slack;
        gap = gap > 0.0f ? gap * CAUTION : 0.0f;
        gap2[c - begin] = gap * gap;
    }
}

static unsigned cells_to_visit(const float *furthest, const float *gap2, float rest)
{
    unsigned mask = 0;
#pragma omp simd reduction(| : mask)
    for (int i = 0; i < BLOCK_LANES; i++) {
        mask |= rest + gap2[i] < furthest[i] ? 1u << i : 0u;
    }
    return mask;
}

// The cells one thread owns during a search: slices begin..end-1 along axis 0 or 1.
typedef struct Slab {
    int axis, begin, end;
    int32_t *touched; // room for all cells of the slab
    int64_t touched_count;
    float *gap2; // scratch: a row of cells, rounded up to whole blocks
} Slab;

static void offer_node(AttractorGrid *grid, Slab *slab, Vec3 p, int32_t k)
{
    const float at[3] = {p.x, p.y, p.z};
    const float low[3] = {grid->low.x, grid->low.y, grid->low.z};
    float reach = grid->reach + grid->slack;
    int begin[3], end[3];
    for (int axis = 0; axis < 3; axis++) {
        float offset = at[axis] - low[axis];
        float width = (float)grid->size[axis] * grid->cell + grid->slack;
        if (offset + reach < 0.0f || offset - reach > width) {
            return;
        }
        begin[axis] = cell_along(grid, axis, offset - reach);
        end[axis] = cell_along(grid, axis, offset + reach) + 1;
    }
    int axis = slab->axis;
    begin[axis] = begin[axis] > slab->begin ? begin[axis] : slab->begin;
    end[axis] = end[axis] < slab->end ? end[axis] : slab->end;
    if (begin[axis] >= end[axis]) {
        return;
    }
    int row = (end[2] - begin[2] + BLOCK_LANES - 1) / BLOCK_LANES * BLOCK_LANES;
    gaps_along(grid, low[2], at[2], begin[2], begin[2] + row, slab->gap2);
    for (int x = begin[0]; x < end[0]; x++) {
        float gap_x;
        gaps_along(grid, low[0], at[0], x, x + 1, &gap_x);
        for (int y = begin[1]; y < end[1]; y++) {
            float gap_y;
            gaps_along(grid, low[1], at[1], y, y + 1, &gap_y);
            int64_t cell = ((int64_t)x * grid->size[1] + y) * grid->size[2] + begin[2];
            for (int z = 0; z < row; z += BLOCK_LANES) {
                int left = end[2] - begin[2] - z;
                unsigned mask =
                    cells_to_visit(grid->furthest + cell + z, slab->gap2 + z, gap_x + gap_y);
                mask &= left < BLOCK_LANES ? (1u << left) - 1u : ~0u;
                for (; mask; mask &= mask - 1) {
                    offer_to_cell(grid, cell + z + __builtin_ctz(mask), p, k, slab->touched,
                                  &slab->touched_count);
                }
            }
        }
    }
}

static void set_bit(const NodeBits *bits, int32_t node)
{
    if (node >= 0) {
        uint64_t *word = &bits->word[node >> 6], bit = 1ull << (node & 63);
        if (!(__atomic_load_n(word, __ATOMIC_RELAXED) & bit)) {
            __atomic_fetch_or(word, bit, __ATOMIC_RELAXED);
        }
    }
}

static void move_lane(AttractorGrid *grid, int64_t to, int64_t from)
{
    AttractorBlock *t = &grid->block[to / BLOCK_LANES];
    AttractorBlock *f = &grid->block[from / BLOCK_LANES];
    int i = (int)(to % BLOCK_LANES), j = (int)(from % BLOCK_LANES);
    t->x[i] = f->x[j];
    t->y[i] = f->y[j];
    t->z[i] = f->z[j];
    t->best[i] = f->best[j];
    t->nearest[i] = f->nearest[j];
    t->previous[i] = f->previous[j];
    grid->source[to] = grid->source[from];
    f->best[j] = -1.0f;
    f->nearest[j] = f->previous[j] = -1;
}

// After a search: notes whose attractors changed, and removes those within the kill radius.
// Returns how many were removed.
static int64_t settle_cell(AttractorGrid *grid, int32_t cell, const NodeBits *changed)
{
    int64_t first = grid->first_block[cell] * BLOCK_LANES;
    int32_t count = grid->count[cell];
    float furthest = -1.0f;
    for (int32_t i = 0; i < count;) {
        AttractorBlock *a = &grid->block[(first + i) / BLOCK_LANES];
        int lane = (int)((first + i) % BLOCK_LANES);
        if (a->best[lane] < grid->kill2) {
            set_bit(changed, a->previous[lane]);
            move_lane(grid, first + i, first + --count);
            continue;
        }
        if (a->nearest[lane] != a->previous[lane]) {
            set_bit(changed, a->previous[lane]);
            set_bit(changed, a->nearest[lane]);
            a->previous[lane] = a->nearest[lane];
        }
        furthest = a->best[lane] > furthest ? a->best[lane] : furthest;
        i++;
    }
    int64_t removed = grid->count[cell] - count;
    grid->count[cell] = count;
    grid->furthest[cell] = furthest;
    grid->state[cell] &= (uint8_t)~CELL_TOUCHED;
    if (!(grid->state[cell] & CELL_ACTIVE) && count > 0) {
        grid->state[cell] |= CELL_ACTIVE;
        int64_t place = __atomic_fetch_add(&grid->active_count, 1, __ATOMIC_RELAXED);
        grid->active[place] = cell;
    }
    return removed;
}

// Splits the grid into at most `wanted` slabs of about equal work; returns how many.
static int plan_slabs(const AttractorGrid *grid, const OutTree *tree, int64_t first, int wanted,
                      int axis, int64_t *work, int *end)
{
    int slices = grid->size[axis];
    memset(work, 0, (size_t)(slices + 1) * sizeof *work);
    float low = axis == 0 ? grid->low.x : grid->low.y;
    for (int64_t k = first; k < tree->count; k++) {
        float at = axis == 0 ? tree->position[k].x : tree->position[k].y;
        work[cell_along(grid, axis, at - low - grid->reach)]++;
        work[cell_along(grid, axis, at - low + grid->reach) + 1]--;
    }
    int64_t total = 0, load = 0, sum = 0;
    for (int s = 0; s < slices; s++) {
        load += work[s];
        total += work[s] = load;
    }
    int slabs = 0;
    for (int s = 0; s < slices; s++) {
        sum += work[s];
        if (s == slices - 1 || (slabs < wanted - 1 && sum * wanted >= total * (slabs + 1))) {
            end[slabs++] = s + 1;
        }
    }
    return slabs;
}

static int64_t update_slab(AttractorGrid *grid, Slab *slab, const OutTree *tree, int64_t first,
                           const NodeBits *changed)
{
    for (int64_t k = first; k < tree->count; k++) {
        offer_node(grid, slab, tree->position[k], (int32_t)k);
    }
    int64_t removed = 0;
    for (int64_t i = 0; i < slab->touched_count; i++) {
        removed += settle_cell(grid, slab->touched[i], changed);
    }
    return removed;
}

void attractor_grid_update(AttractorGrid *grid, const OutTree *tree, int64_t first, int threads,
                           const NodeBits *changed)
{
    int axis = grid->size[0] >= grid->size[1] ? 0 : 1;
    int wanted = threads > 1 ? threads * SLABS_PER_THREAD : 1;
    wanted = wanted > MAX_SLABS ? MAX_SLABS : wanted;
    int end[MAX_SLABS];
    int slabs = plan_slabs(grid, tree, first, wanted, axis, grid->work, end);
    int64_t removed = 0, slice = grid->cell_count / grid->size[axis];
    int row = grid->size[2] + BLOCK_LANES;
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads) reduction(+ : removed) if (slabs > 1)
    for (int s = 0; s < slabs; s++) {
        int begin = s > 0 ? end[s - 1] : 0;
        Slab slab = {.axis = axis,
                     .begin = begin,
                     .end = end[s],
                     .touched = grid->touched + begin * slice,
                     .gap2 = grid->gap2 + (int64_t)s * row};
        removed += update_slab(grid, &slab, tree, first, changed);
    }
    grid->alive -= removed;
}
