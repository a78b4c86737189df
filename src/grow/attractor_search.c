// Nearest-node search: offers new nodes to the cells they can improve, then settles the cells.
#include "grow/attractor_grid.h"

#include <string.h>

enum { CELL_TOUCHED = 1, CELL_ACTIVE = 2 };
enum { MAX_VISITS = 64 };
enum { MIN_SHARED = 64 }; // least number of new nodes worth sharing among threads

// Shrinks distances to cells, so that rounding never makes a cell look farther than a point in it.
#define CAUTION 0.999999f

// The cells that one thread owns during a search: slices begin..end-1 along the grid's axis.
typedef struct Slab {
    int begin, end;
    int32_t *touched; // room for all cells of the slab
    int64_t touched_count;
    float *gap2; // scratch: a row of cells, rounded up to whole blocks
    int32_t visit[MAX_VISITS];
} Slab;

// Offers node k at p to the attractors of a cell; each keeps the nearer of k and its nearest node.
static void offer_to_cell(AttractorGrid *grid, Slab *slab, int32_t c, Vec3 p, int32_t k)
{
    AttractorCell *cell = &grid->cells[c];
    AttractorBlock *block = grid->block + cell->first_block;
    int blocks = (cell->count + BLOCK_LANES - 1) / BLOCK_LANES;
    float furthest = 0.0f;
    int any = 0;
    for (int b = 0; b < blocks; b++) {
        AttractorBlock *a = &block[b];
#pragma omp simd reduction(max : furthest) reduction(| : any)
        for (int i = 0; i < BLOCK_LANES; i++) {
            float dx = a->x[i] - p.x, dy = a->y[i] - p.y, dz = a->z[i] - p.z;
            float d = dx * dx + dy * dy + dz * dz;
            float best = a->best[i];
            int closer = d < best;
            best = closer ? d : best;
            a->best[i] = best;
            a->nearest[i] = closer ? k : a->nearest[i];
            furthest = best > furthest ? best : furthest;
            any |= closer;
        }
    }
    if (any) {
        grid->furthest[c] = furthest;
        if (!(cell->state & CELL_TOUCHED)) {
            cell->state |= CELL_TOUCHED;
            slab->touched[slab->touched_count++] = c;
        }
    }
}

// Squared distance (never overestimated) from the coordinate p to a cell along an axis.
static float gap2_to(const AttractorGrid *grid, float low, float p, int cell)
{
    float a = low + (float)cell * grid->cell - p, b = -a - grid->cell;
    float gap = (a > b ? a : b) - grid->slack;
    gap = gap > 0.0f ? gap * CAUTION : 0.0f;
    return gap * gap;
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

// Offers the node to the listed cells while their attractors are prefetched.
static void visit_cells(AttractorGrid *grid, Slab *slab, int count, Vec3 p, int32_t k)
{
    for (int i = 0; i < count; i++) {
        const AttractorCell *cell = &grid->cells[slab->visit[i]];
        __builtin_prefetch(&grid->block[cell->first_block], 1);
        __builtin_prefetch(&grid->block[cell->first_block].best, 1);
        __builtin_prefetch(&grid->block[cell->first_block].nearest[7], 1);
    }
    for (int i = 0; i < count; i++) {
        offer_to_cell(grid, slab, slab->visit[i], p, k);
    }
}

// Range of cells along each axis that the node at p can reach in the slab; false if empty.
static bool range_of(const AttractorGrid *grid, const Slab *slab, const float at[3], int begin[3],
                     int end[3])
{
    const float low[3] = {grid->low.x, grid->low.y, grid->low.z};
    float reach = grid->reach + grid->slack;
    for (int axis = 0; axis < 3; axis++) {
        float offset = at[axis] - low[axis];
        float width = (float)grid->size[axis] * grid->cell + grid->slack;
        if (offset + reach < 0.0f || offset - reach > width) {
            return false;
        }
        begin[axis] = attractor_grid_cell_along(grid, axis, offset - reach);
        end[axis] = attractor_grid_cell_along(grid, axis, offset + reach) + 1;
    }
    int axis = grid->axis;
    begin[axis] = begin[axis] > slab->begin ? begin[axis] : slab->begin;
    end[axis] = end[axis] < slab->end ? end[axis] : slab->end;
    return begin[axis] < end[axis];
}

// Lists the cells of a row that the node may improve, and visits them. gap2: squared distances of
// the row's cells.
static void offer_to_row(AttractorGrid *grid, Slab *slab, int64_t cell, int count, float rest,
                         Vec3 p, int32_t k, int *listed)
{
    for (int z = 0; z < count; z += BLOCK_LANES) {
        unsigned mask = cells_to_visit(grid->furthest + cell + z, slab->gap2 + z, rest);
        mask &= count - z < BLOCK_LANES ? (1u << (count - z)) - 1u : ~0u;
        for (; mask; mask &= mask - 1) {
            slab->visit[(*listed)++] = (int32_t)(cell + z + __builtin_ctz(mask));
        }
        if (*listed > MAX_VISITS - BLOCK_LANES) {
            visit_cells(grid, slab, *listed, p, k);
            *listed = 0;
        }
    }
}

static void offer_node(AttractorGrid *grid, Slab *slab, Vec3 p, int32_t k)
{
    const float at[3] = {p.x, p.y, p.z};
    int begin[3], end[3], listed = 0;
    if (!range_of(grid, slab, at, begin, end)) {
        return;
    }
    int count = end[2] - begin[2];
    int padded = (count + BLOCK_LANES - 1) / BLOCK_LANES * BLOCK_LANES;
    for (int z = 0; z < padded; z++) {
        slab->gap2[z] = gap2_to(grid, grid->low.z, p.z, begin[2] + z);
    }
    for (int x = begin[0]; x < end[0]; x++) {
        float gap_x = gap2_to(grid, grid->low.x, p.x, x);
        for (int y = begin[1]; y < end[1]; y++) {
            float gap = gap_x + gap2_to(grid, grid->low.y, p.y, y);
            if (gap < grid->reach2) {
                int64_t cell = ((int64_t)x * grid->size[1] + y) * grid->size[2] + begin[2];
                offer_to_row(grid, slab, cell, count, gap, p, k, &listed);
            }
        }
    }
    visit_cells(grid, slab, listed, p, k);
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

// After a search: records whose attractors changed and removes those within the kill radius.
// Returns how many were removed.
static int64_t settle_cell(AttractorGrid *grid, int32_t cell, const NodeBits *changed)
{
    int64_t first = grid->cells[cell].first_block * BLOCK_LANES;
    int32_t count = grid->cells[cell].count;
    float furthest = -1.0f;
    for (int32_t i = 0; i < count;) {
        AttractorBlock *a = &grid->block[(first + i) / BLOCK_LANES];
        int lane = (int)((first + i) % BLOCK_LANES);
        if (a->best[lane] < grid->kill2) {
            set_bit(changed, a->previous[lane]);
            if (grid->removed) {
                grid->removed[grid->source[first + i]] = grid->now;
            }
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
    int64_t removed = grid->cells[cell].count - count;
    grid->cells[cell].count = count;
    grid->furthest[cell] = furthest;
    grid->cells[cell].state &= ~CELL_TOUCHED;
    AttractorCell *c = &grid->cells[cell];
    if (!(c->state & CELL_ACTIVE) && count > 0) {
        c->state |= CELL_ACTIVE;
        int64_t place = __atomic_fetch_add(&grid->active_count, 1, __ATOMIC_RELAXED);
        int32_t row = cell / grid->size[2];
        int32_t slice = grid->axis == 0 ? row / grid->size[1] : row % grid->size[1];
        grid->active[place] = (ActiveCell){cell, slice};
    } else if ((c->state & CELL_ACTIVE) && count == 0) {
        __atomic_fetch_add(&grid->idle_count, 1, __ATOMIC_RELAXED);
    }
    return removed;
}

// Splits the grid into at most `wanted` slabs of about equal work. Slabs change little from step to
// step, so a thread finds most of its cells in its own cache.
static void plan_slabs(AttractorGrid *grid, const NewNodes *nodes, int wanted)
{
    const OutTree *tree = nodes->tree;
    int axis = grid->axis, slices = grid->size[axis];
    int64_t *work = grid->work;
    memset(work, 0, (size_t)(slices + 1) * sizeof *work);
    float low = axis == 0 ? grid->low.x : grid->low.y;
    for (int64_t k = nodes->first; k < tree->count && wanted > 1; k++) {
        float at = axis == 0 ? tree->position[k].x : tree->position[k].y;
        work[attractor_grid_cell_along(grid, axis, at - low - grid->reach)]++;
        work[attractor_grid_cell_along(grid, axis, at - low + grid->reach) + 1]--;
    }
    int64_t total = 0, load = 0, sum = 0;
    for (int s = 0; s < slices; s++) {
        load += work[s];
        total += work[s] = load;
    }
    grid->slab_count = 0;
    for (int s = 0; s < slices; s++) {
        sum += work[s];
        bool enough = sum * wanted >= total * (grid->slab_count + 1);
        if (s == slices - 1 || (grid->slab_count < wanted - 1 && enough)) {
            grid->slab_end[grid->slab_count++] = s + 1;
        }
    }
}

static int64_t update_slab(AttractorGrid *grid, Slab *slab, const NewNodes *nodes, const Run *run,
                           const NodeBits *changed)
{
    const OutTree *tree = nodes->tree;
    for (int64_t k = nodes->first; k < tree->count && run_goes_on(run, k, NULL); k++) {
        offer_node(grid, slab, tree->position[k], (int32_t)k);
    }
    for (int64_t k = 0; k < nodes->rival_count && run_goes_on(run, k, NULL); k++) {
        offer_node(grid, slab, nodes->rival[k], NEAREST_RIVAL);
    }
    int64_t removed = 0;
    for (int64_t i = 0; i < slab->touched_count && run_goes_on(run, i, NULL); i++) {
        removed += settle_cell(grid, slab->touched[i], changed);
    }
    return removed;
}

// Removes emptied cells from the active list once there are many.
static void drop_idle_cells(AttractorGrid *grid)
{
    if (grid->idle_count * 4 < grid->active_count) {
        return;
    }
    int64_t kept = 0;
    for (int64_t i = 0; i < grid->active_count; i++) {
        if (grid->cells[grid->active[i].cell].count > 0) {
            grid->active[kept++] = grid->active[i];
        }
    }
    grid->active_count = kept;
    grid->idle_count = 0;
}

void attractor_grid_update(AttractorGrid *grid, const NewNodes *nodes, const Run *run, int threads,
                           const NodeBits *changed)
{
    int64_t count = nodes->tree->count - nodes->first + nodes->rival_count;
    bool shared = threads > 1 && count >= MIN_SHARED;
    plan_slabs(grid, nodes, shared ? threads : 1);
    int slabs = grid->slab_count, row = grid->size[2] + BLOCK_LANES;
    int64_t removed = 0, slice = grid->cell_count / grid->size[grid->axis];
#pragma omp parallel for schedule(static, 1) num_threads(slabs) reduction(+ : removed) if (slabs > 1)
    for (int s = 0; s < slabs; s++) {
        Slab slab = {.begin = s > 0 ? grid->slab_end[s - 1] : 0, .end = grid->slab_end[s]};
        slab.touched = grid->touched + slab.begin * slice;
        slab.gap2 = grid->gap2 + (int64_t)s * row;
        removed += update_slab(grid, &slab, nodes, run, changed);
    }
    grid->alive -= removed;
    drop_idle_cells(grid);
}
