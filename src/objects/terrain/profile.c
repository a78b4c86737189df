// Heights of rivers. From the outlet up a river rises as streams in a steady state do, slope =
// S0 min(1, (A / A0)^-concavity) (Flint 1974), times the uplift. All rivers are raised together,
// lowest nodes first. A river that would cross the slope of a lower one is captured and runs down
// that slope instead, as in nature when divides move.
#include "objects/terrain/internal.h"

#include "base/exact_math.h"
#include "base/lowest_queue.h"
#include "base/memory.h"
#include "objects/terrain/cells.h"

#include <stdlib.h>
#include <string.h>

Trough terrain_trough(const Terrain *terrain, int64_t i, float gradient)
{
    const OutTree *tree = terrain->tree;
    Vec3 b = tree->position[i], a = tree->parent[i] >= 0 ? tree->position[tree->parent[i]] : b;
    float dx = b.x - a.x, dz = b.z - a.z, length = sqrtf(dx * dx + dz * dz);
    float own = gradient * terrain->uplift[i];
    Trough t = {.x = a.x,
                .z = a.z,
                .dx = 1.0f,
                .h0 = a.y,
                .gradient = own,
                .width = terrain_valley(terrain->params, terrain->area[i]),
                .node = (int32_t)i};
    if (length > 0.0f) {
        t.dx = dx / length;
        t.dz = dz / length;
        t.length = length;
        t.slope = (b.y - a.y) / length;
        t.gradient = own > 1.05f * t.slope ? own : 1.05f * t.slope;
    }
    return t;
}

// Bounds of the troughs in one cell, for skipping it.
typedef struct TroughCell {
    int32_t first; // -1 = none; next in Ascent.next
    float low, gradient, reach;
} TroughCell;

typedef struct Ascent {
    Terrain *terrain;
    LowestQueue queue;
    TerrainCells cells;
    TroughCell *cell; // of each
    Trough *trough;
    int32_t *next;
    int32_t *child, *sibling; // first child, next sibling
    int32_t *settled;         // nodes in the order in which they got their heights
    int64_t settled_count;
    uint8_t *drowned; // nodes held down by a slope that is not their river's
    int64_t captures;
    float least_gradient, largest_reach;
} Ascent;

static void link_children(Ascent *a)
{
    const OutTree *tree = a->terrain->tree;
    for (int64_t i = tree->count - 1; i >= 0; i--) {
        int32_t parent = tree->parent[i];
        a->sibling[i] = -1;
        if (parent >= 0) {
            a->sibling[i] = a->child[parent];
            a->child[parent] = (int32_t)i;
        }
    }
}

static void settle(Ascent *a, int32_t i)
{
    Trough t = terrain_trough(a->terrain, i, 1.0f);
    TroughCell *cell = &a->cell[terrain_cell_index(&a->cells, a->terrain->tree->position[i])];
    float reach = t.length + t.width;
    a->trough[i] = t;
    a->next[i] = cell->first;
    cell->low = cell->first < 0 || t.h0 < cell->low ? t.h0 : cell->low;
    cell->gradient = cell->first < 0 || t.gradient < cell->gradient ? t.gradient : cell->gradient;
    cell->reach = cell->first < 0 || reach > cell->reach ? reach : cell->reach;
    cell->first = i;
    a->least_gradient = t.gradient < a->least_gradient ? t.gradient : a->least_gradient;
    a->largest_reach = reach > a->largest_reach ? reach : a->largest_reach;
}

static void search_cell(const Ascent *a, int column, int row, Vec3 p, float *best, int32_t *found)
{
    const TroughCell *cell = &a->cell[(int64_t)row * a->cells.side + column];
    float side = 1.0f / a->cells.scale;
    float dx = fabsf(p.x - (((float)column + 0.5f) * side - 0.5f * a->cells.size)) - 0.5f * side;
    float dz = fabsf(p.z - (((float)row + 0.5f) * side - 0.5f * a->cells.size)) - 0.5f * side;
    dx = dx > 0.0f ? dx : 0.0f;
    dz = dz > 0.0f ? dz : 0.0f;
    float clear = sqrtf(dx * dx + dz * dz) - cell->reach;
    if (cell->first < 0 || cell->low + cell->gradient * (clear > 0.0f ? clear : 0.0f) > *best) {
        return;
    }
    for (int32_t i = cell->first; i >= 0; i = a->next[i]) {
        float h = trough_height(&a->trough[i], p.x, p.z);
        if (h < *best || (h == *best && i < *found)) {
            *best = h;
            *found = i;
        }
    }
}

// The node of the lowest settled slope at p below `best`; -1 = none.
static int32_t lowest_slope(const Ascent *a, Vec3 p, float *best)
{
    int column = terrain_cell(&a->cells, p.x), row = terrain_cell(&a->cells, p.z),
        side = a->cells.side;
    int32_t found = -1;
    for (int ring = 0; ring < side; ring++) {
        float clear = (float)(ring - 1) / a->cells.scale - a->largest_reach;
        if (clear > 0.0f && clear * a->least_gradient > *best) {
            break;
        }
        for (int r = row - ring; r <= row + ring; r++) {
            bool edge = r == row - ring || r == row + ring;
            for (int c = column - ring; c <= column + ring; c += edge || ring == 0 ? 1 : 2 * ring) {
                if (r >= 0 && c >= 0 && r < side && c < side) {
                    search_cell(a, c, r, p, best, &found);
                }
            }
        }
    }
    return found;
}

// Height of node i above its parent by the slope-area law.
static float tentative(const Ascent *a, int32_t i)
{
    const Terrain *terrain = a->terrain;
    const OutTree *tree = terrain->tree;
    const RiverParams *rivers = &terrain->params->rivers;
    float headwater = terrain->params->size * terrain->params->size / (float)rivers->count;
    float share = terrain->area[i] / headwater;
    float slope = rivers->gradient * terrain->uplift[i];
    if (share > 1.0f) {
        slope *= exact_pow(share, -rivers->concavity);
    }
    Vec3 p = tree->position[i], q = tree->position[tree->parent[i]];
    float dx = p.x - q.x, dz = p.z - q.z;
    return q.y + slope * sqrtf(dx * dx + dz * dz);
}

// Least fall of every river.
static float least_rise(const OutTree *tree, int32_t i, int32_t below)
{
    Vec3 p = tree->position[i], q = tree->position[below];
    float dx = p.x - q.x, dz = p.z - q.z;
    return q.y + 1e-5f * sqrtf(dx * dx + dz * dz) + 1e-6f * (q.y + 1.0f);
}

// The floor of a river's own valley reaches slightly upstream; this is no capture.
static bool is_ancestor(const OutTree *tree, int32_t other, int32_t i)
{
    for (int k = 0; k < 100 && i >= 0; k++, i = tree->parent[i]) {
        if (i == other) {
            return true;
        }
    }
    return false;
}

// Sets the height of node i: the tentative one, unless a slope is lower there.
static void rise(Ascent *a, int32_t i, float tentative_height)
{
    OutTree *tree = a->terrain->tree;
    int32_t parent = tree->parent[i];
    Vec3 p = tree->position[i], q = tree->position[parent];
    float length = sqrtf((p.x - q.x) * (p.x - q.x) + (p.z - q.z) * (p.z - q.z));
    // A valley needs some width before other slopes begin.
    float height = tentative_height + 0.3f * a->terrain->uplift[i] * length;
    int32_t other = lowest_slope(a, p, &height);
    bool foreign = other >= 0 && tree->parent[other] >= 0 && !is_ancestor(tree, other, parent);
    a->drowned[i] = foreign;
    height = height < tentative_height ? height : tentative_height;
    if (foreign && height < q.y) { // captured
        parent = tree->parent[i] = tree->parent[other];
        a->captures++;
    }
    float least = least_rise(tree, i, parent);
    tree->position[i].y = height > least ? height : least;
}

static bool ascend(Ascent *a, Error *e)
{
    OutTree *tree = a->terrain->tree;
    for (int64_t i = 0; i < tree->count; i++) {
        tree->position[i].y = 0.0f;
        if (tree->parent[i] < 0 && !lowest_queue_push(&a->queue, 0.0f, (int32_t)i, e)) {
            return false;
        }
    }
    while (a->queue.count > 0) {
        QueueItem item = lowest_queue_pop(&a->queue);
        int32_t i = item.index;
        if (tree->parent[i] >= 0) {
            rise(a, i, item.height);
        }
        settle(a, i);
        a->settled[a->settled_count++] = i;
        for (int32_t c = a->child[i]; c >= 0; c = a->sibling[c]) {
            if (!lowest_queue_push(&a->queue, tentative(a, c), c, e)) {
                return false;
            }
        }
    }
    return true;
}

// River ends on another river's slope are part of its hillside: marks them in drop, from the tips
// down to the first node in its own valley.
static void drop_drowned(const Ascent *a, uint8_t *drop)
{
    const OutTree *tree = a->terrain->tree;
    uint8_t *bears = drop; // 2 = a child is kept
    for (int64_t k = a->settled_count - 1; k >= 0; k--) {
        int32_t i = a->settled[k], parent = tree->parent[i];
        if (parent < 0) {
            drop[i] = 0;
            continue;
        }
        drop[i] = a->drowned[i] && bears[i] != 2;
        if (!drop[i]) {
            bears[parent] = 2;
        }
    }
}

static bool ascend_all(Terrain *terrain, uint8_t *drop, int64_t *captures, Error *e)
{
    int64_t count = terrain->tree->count;
    Ascent a = {.terrain = terrain, .least_gradient = 3e38f};
    a.cells = terrain_cells(terrain->params->size, count / 3, 512);
    int64_t cells = (int64_t)a.cells.side * a.cells.side;
    a.cell = memory_alloc(cells, sizeof *a.cell, e);
    a.trough = memory_alloc(count, sizeof *a.trough, e);
    a.next = memory_alloc(count, sizeof *a.next, e);
    a.child = memory_alloc(count, sizeof *a.child, e);
    a.sibling = memory_alloc(count, sizeof *a.sibling, e);
    a.settled = memory_alloc(count, sizeof *a.settled, e);
    a.drowned = memory_alloc_zero(count, 1, e);
    bool done = a.cell && a.trough && a.next && a.child && a.sibling && a.settled && a.drowned;
    if (done) {
        for (int64_t i = 0; i < cells; i++) {
            a.cell[i] = (TroughCell){.first = -1};
        }
        memset(a.child, 0xff, sizeof *a.child * (size_t)count);
        link_children(&a);
        done = ascend(&a, e);
    }
    if (done) {
        drop_drowned(&a, drop);
    }
    *captures = a.captures;
    free(a.queue.item);
    free(a.cell);
    free(a.trough);
    free(a.next);
    free(a.child);
    free(a.sibling);
    free(a.settled);
    free(a.drowned);
    return done;
}

// ---- order

typedef struct Rank {
    float height;
    int32_t node;
} Rank;

static int compare_ranks(const void *a, const void *b)
{
    const Rank *x = a, *y = b;
    if (x->height != y->height) {
        return x->height < y->height ? -1 : 1;
    }
    return x->node < y->node ? -1 : x->node > y->node;
}

// A copy of the tree without dropped nodes, sorted by height, which rises upstream: parents come
// before their children.
static bool sort_by_height(Terrain *terrain, const uint8_t *drop, int64_t *dropped, Error *e)
{
    OutTree *tree = terrain->tree, *sorted = out_tree_new(e);
    Rank *rank = memory_alloc(tree->count, sizeof *rank, e);
    int32_t *place = memory_alloc(tree->count, sizeof *place, e);
    float *uplift = memory_alloc(tree->count, sizeof *uplift, e);
    float *area = memory_alloc(tree->count, sizeof *area, e);
    bool done =
        sorted && rank && place && uplift && area && out_tree_reserve(sorted, tree->count, e);
    for (int64_t i = 0; done && i < tree->count; i++) {
        rank[i] = (Rank){tree->position[i].y, (int32_t)i};
    }
    if (done) {
        qsort(rank, (size_t)tree->count, sizeof *rank, compare_ranks);
    }
    *dropped = 0;
    for (int64_t k = 0; done && k < tree->count; k++) {
        int32_t i = rank[k].node, parent = tree->parent[i];
        if (drop[i] == 1) {
            ++*dropped;
            continue;
        }
        int64_t own = sorted->count;
        int32_t below = parent < 0 ? -1 : place[parent];
        place[i] = (int32_t)own;
        uplift[own] = terrain->uplift[i];
        area[own] = terrain->area[i];
        done = out_tree_add_node(sorted, tree->position[i], below, tree->birth[i],
                                 below < 0 ? tree->colony[i] : sorted->colony[below], tree->id[i],
                                 e) >= 0;
    }
    if (done) {
        memcpy(terrain->uplift, uplift, sizeof *uplift * (size_t)tree->count);
        memcpy(terrain->area, area, sizeof *area * (size_t)tree->count);
        terrain->tree = sorted;
        sorted = tree;
    }
    out_tree_free(sorted);
    free(rank);
    free(place);
    free(uplift);
    free(area);
    return done;
}

bool terrain_profile(Terrain *terrain, const Run *run, int64_t *captures, Error *e)
{
    if (run_is_cancelled(run)) {
        return run_cancel_error(e);
    }
    int64_t dropped = 0;
    uint8_t *drop = memory_alloc_zero(terrain->tree->count, 1, e);
    bool done = drop && terrain_areas(terrain, run, e) && ascend_all(terrain, drop, captures, e) &&
                sort_by_height(terrain, drop, &dropped, e);
    free(drop);
    *captures += dropped;
    return done;
}
