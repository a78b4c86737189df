// Nearest-node search: offers new nodes to the cells they can improve, then settles the cells.
#include "grow/attractor_grid.h"

#include <string.h>

enum { CELL_TOUCHED = 1, CELL_ACTIVE = 2 };
enum { WORD_ROWS = 64 / LANES, MAX_ROWS = 8 * WORD_ROWS }; // rows of eight cells
enum { MIN_SHARED = 64 }; // least number of new nodes worth sharing among threads

// Shrinks distances to cells, so that rounding never makes a cell look farther than a point in it.
#define CAUTION 0.999999f

// The cells that one thread owns during a search: slices begin..end-1 along the grid's axis.
typedef struct Slab {
    AttractorGrid *grid;
    const NodeBits *changed;
    int begin, end;
    int32_t first;    // nodes from this one on are new
    int32_t *touched; // room for all cells of the slab
    int64_t touched_count;
    float *gap2[3]; // scratch: along each axis, squared distances from a node to the cells in reach
    int row_count;
    int32_t row[MAX_ROWS];                // the first of eight cells along z
    uint64_t visit[MAX_ROWS / WORD_ROWS]; // a bit for each of these rows' cells: must be visited
    int32_t cell[MAX_ROWS * LANES];
} Slab;

static void set_bit(const NodeBits *bits, int32_t node)
{
    uint64_t *word = &bits->word[node >> 6], bit = 1ull << (node & 63);
    if (!(__atomic_load_n(word, __ATOMIC_RELAXED) & bit)) {
        __atomic_fetch_or(word, bit, __ATOMIC_RELAXED);
    }
}

// Sets the bits of the nodes in these lanes; most lanes of a block hold the same node.
static void set_bits(const NodeBits *bits, const IntLanes *nodes, unsigned lanes)
{
    while (lanes) {
        int32_t node = (*nodes)[__builtin_ctz(lanes)];
        set_bit(bits, node);
        IntLanes same = *nodes == node;
        lanes &= ~lanes_bits(&same);
    }
}

// Offers node k at p to the attractors of a cell; each keeps the nearer of k and its nearest node.
static void offer_to_cell(Slab *slab, int32_t c, Vec3 p, int32_t k)
{
    AttractorGrid *grid = slab->grid;
    AttractorBlock *block = grid->block + grid->cells[c].first_block;
    int blocks = (grid->cells[c].count + LANES - 1) / LANES;
    FloatLanes furthest = (FloatLanes){0} - 1.0f;
    unsigned any = 0;
    for (int b = 0; b < blocks; b++) {
        AttractorBlock *a = &block[b];
        FloatLanes dx = a->x - p.x, dy = a->y - p.y, dz = a->z - p.z;
        FloatLanes distance2 = dx * dx + dy * dy + dz * dz;
        IntLanes closer = distance2 < a->best;
        unsigned lanes = lanes_bits(&closer);
        if (lanes) {
            IntLanes loses = closer & (a->nearest >= 0) & (a->nearest < slab->first);
            set_bits(slab->changed, &a->nearest, lanes_bits(&loses)); // nodes of earlier steps
            a->best = (FloatLanes)((closer & (IntLanes)distance2) | (~closer & (IntLanes)a->best));
            a->nearest = (closer & k) | (~closer & a->nearest);
            any = lanes;
        }
        lanes_raise(&furthest, &a->best);
    }
    if (any) {
        grid->furthest[c] = lanes_largest(&furthest);
        if (!(grid->state[c] & CELL_TOUCHED)) {
            grid->state[c] |= CELL_TOUCHED;
            slab->touched[slab->touched_count++] = c;
        }
    }
}

// Squared distances (never overestimated) from the coordinate p to the cells begin..end-1 along an
// axis, then infinity for a block.
static void find_gaps(const AttractorGrid *grid, float low, float p, int begin, int end,
                      float *gap2)
{
    for (int i = 0; i < end - begin; i++) {
        float a = low + (float)(begin + i) * grid->cell - p, b = -a - grid->cell;
        float gap = (a > b ? a : b) - grid->slack;
        gap = gap > 0.0f ? gap * CAUTION : 0.0f;
        gap2[i] = gap * gap;
    }
    for (int i = 0; i < LANES; i++) {
        gap2[end - begin + i] = INFINITY;
    }
}

// Which of eight cells of a row hold an attractor that a node may be nearer to than its best.
static unsigned cells_to_visit(const float *furthest, const float *gap2, float rest)
{
    FloatLanes far, gap; // loaded this way because they are not aligned
    memcpy(&far, furthest, sizeof far);
    memcpy(&gap, gap2, sizeof gap);
    IntLanes may = rest + gap < far;
    return lanes_bits(&may);
}

// Offers the node to the cells to visit of the rows listed. It takes the bits of many rows at once,
// because the processor cannot predict how many bits a single row has.
static void visit_rows(Slab *slab, Vec3 p, int32_t k)
{
    const AttractorGrid *grid = slab->grid;
    int count = 0;
    for (int i = 0; i * WORD_ROWS < slab->row_count; i++) {
        for (uint64_t bits = slab->visit[i]; bits; bits &= bits - 1) {
            int bit = __builtin_ctzll(bits);
            int32_t cell = slab->row[i * WORD_ROWS + bit / LANES] + bit % LANES;
            attractor_grid_prefetch(grid, cell);
            slab->cell[count++] = cell;
        }
        slab->visit[i] = 0;
    }
    slab->row_count = 0;
    for (int i = 0; i < count; i++) {
        offer_to_cell(slab, slab->cell[i], p, k);
    }
}

// Lists a row of up to eight cells with those to visit.
static void list_row(Slab *slab, int32_t cell, unsigned visit)
{
    int row = slab->row_count++;
    slab->row[row] = cell;
    slab->visit[row / WORD_ROWS] |= (uint64_t)visit << row % WORD_ROWS * LANES;
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

static void offer_node(Slab *slab, Vec3 p, int32_t k)
{
    const AttractorGrid *grid = slab->grid;
    const float at[3] = {p.x, p.y, p.z}, low[3] = {grid->low.x, grid->low.y, grid->low.z};
    int begin[3], end[3];
    if (!range_of(grid, slab, at, begin, end)) {
        return;
    }
    for (int axis = 0; axis < 3; axis++) {
        find_gaps(grid, low[axis], at[axis], begin[axis], end[axis], slab->gap2[axis]);
    }
    for (int x = begin[0]; x < end[0]; x++) {
        for (int y = begin[1]; y < end[1]; y++) {
            float gap2 = slab->gap2[0][x - begin[0]] + slab->gap2[1][y - begin[1]];
            int64_t row = ((int64_t)x * grid->size[1] + y) * grid->size[2];
            for (int z = begin[2]; z < end[2] && gap2 < grid->reach2; z += LANES) {
                const float *gap2_z = slab->gap2[2] + z - begin[2];
                list_row(slab, (int32_t)row + z,
                         cells_to_visit(grid->furthest + row + z, gap2_z, gap2));
                if (slab->row_count == MAX_ROWS) {
                    visit_rows(slab, p, k);
                }
            }
        }
    }
    visit_rows(slab, p, k);
}

// Removes an attractor of a cell; the cell's last one takes its lane.
static void remove_lane(AttractorGrid *grid, AttractorBlock *block, int32_t lane, int32_t last)
{
    AttractorBlock *t = &block[lane / LANES], *f = &block[last / LANES];
    int i = lane % LANES, j = last % LANES;
    if (grid->removed) {
        grid->removed[t->source[i]] = grid->now;
    }
    t->x[i] = f->x[j];
    t->y[i] = f->y[j];
    t->z[i] = f->z[j];
    t->best[i] = f->best[j];
    t->nearest[i] = f->nearest[j];
    t->source[i] = f->source[j];
    f->best[j] = -1.0f;
    f->nearest[j] = -1;
}

// Keeps the list of active cells after a search of this one.
static void list_cell(AttractorGrid *grid, int32_t cell)
{
    int32_t row = cell / grid->size[2];
    ActiveCells *active =
        &grid->active[grid->axis == 0 ? row / grid->size[1] : row % grid->size[1]];
    uint8_t *state = &grid->state[cell];
    bool empty = grid->cells[cell].count == 0;
    if (!(*state & CELL_ACTIVE) && !empty) {
        *state |= CELL_ACTIVE;
        active->cell[active->count++] = cell;
    } else if ((*state & CELL_ACTIVE) && empty) {
        active->empty++;
    }
}

// After a search: removes the attractors within the kill radius and marks the new nodes that gained
// one of the others. Returns how many were removed.
static int64_t settle_cell(const Slab *slab, int32_t cell)
{
    AttractorGrid *grid = slab->grid;
    AttractorBlock *block = grid->block + grid->cells[cell].first_block;
    int32_t before = grid->cells[cell].count, count = before;
    FloatLanes furthest = (FloatLanes){0} - 1.0f;
    for (int32_t begin = 0; begin < count; begin += LANES) {
        AttractorBlock *a = &block[begin / LANES];
        for (;;) {
            IntLanes killed = (a->best < grid->kill2) & (a->best >= 0.0f);
            unsigned lanes = lanes_bits(&killed);
            if (!lanes) {
                break;
            }
            remove_lane(grid, block, begin + __builtin_ctz(lanes), --count);
        }
        IntLanes is_new = a->nearest >= slab->first;
        set_bits(slab->changed, &a->nearest, lanes_bits(&is_new));
        lanes_raise(&furthest, &a->best);
    }
    grid->cells[cell].count = count;
    grid->furthest[cell] = lanes_largest(&furthest);
    grid->state[cell] &= (uint8_t)~CELL_TOUCHED;
    list_cell(grid, cell);
    return before - count;
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

static void place_gaps(Slab *slab, int number)
{
    const AttractorGrid *grid = slab->grid;
    const int *size = grid->size;
    int64_t room = (int64_t)size[0] + size[1] + size[2] + 3 * LANES;
    slab->gap2[0] = grid->gap2 + number * room;
    slab->gap2[1] = slab->gap2[0] + size[0] + LANES;
    slab->gap2[2] = slab->gap2[1] + size[1] + LANES;
}

// Removes emptied cells from a list of active ones once there are many.
static void drop_empty_cells(const AttractorGrid *grid, ActiveCells *active)
{
    if (active->empty < active->count / 4) {
        return;
    }
    int32_t kept = 0;
    for (int32_t i = 0; i < active->count; i++) {
        if (grid->cells[active->cell[i]].count > 0) {
            active->cell[kept++] = active->cell[i];
        }
    }
    active->count = kept;
    active->empty = 0;
}

static int64_t update_slab(Slab *slab, const NewNodes *nodes, const Run *run)
{
    const OutTree *tree = nodes->tree;
    for (int64_t k = nodes->first; k < tree->count && run_goes_on(run, k, NULL); k++) {
        offer_node(slab, tree->position[k], (int32_t)k);
    }
    for (int64_t k = 0; k < nodes->rival_count && run_goes_on(run, k, NULL); k++) {
        offer_node(slab, nodes->rival[k], NEAREST_RIVAL);
    }
    int64_t removed = 0;
    for (int64_t i = 0; i < slab->touched_count && run_goes_on(run, i, NULL); i++) {
        if (i + ATTRACTOR_AHEAD < slab->touched_count) {
            attractor_grid_prefetch(slab->grid, slab->touched[i + ATTRACTOR_AHEAD]);
        }
        removed += settle_cell(slab, slab->touched[i]);
    }
    for (int s = slab->begin; s < slab->end; s++) {
        drop_empty_cells(slab->grid, &slab->grid->active[s]);
    }
    return removed;
}

void attractor_grid_update(AttractorGrid *grid, const NewNodes *nodes, const Run *run, int threads,
                           const NodeBits *changed)
{
    int64_t count = nodes->tree->count - nodes->first + nodes->rival_count;
    bool shared = threads > 1 && count >= MIN_SHARED;
    plan_slabs(grid, nodes, shared ? threads : 1);
    int slabs = grid->slab_count;
    int64_t removed = 0, slice = grid->cell_count / grid->size[grid->axis];
#pragma omp parallel for schedule(static, 1) num_threads(slabs) reduction(+ : removed) if (slabs > 1)
    for (int s = 0; s < slabs; s++) {
        Slab slab = {.grid = grid,
                     .changed = changed,
                     .begin = s > 0 ? grid->slab_end[s - 1] : 0,
                     .end = grid->slab_end[s],
                     .first = (int32_t)nodes->first};
        slab.touched = grid->touched + slab.begin * slice;
        place_gaps(&slab, s);
        removed += update_slab(&slab, nodes, run);
    }
    grid->alive -= removed;
    grid->active_count = 0;
    for (int s = 0; s < grid->size[grid->axis]; s++) {
        grid->active_count += grid->active[s].count;
    }
}
