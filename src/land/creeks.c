#include "land/creeks.h"

#include "base/lowest_queue.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// The tree of ways from all samples of the marsh to the water.
typedef struct CreekTree {
    const CreekPlain *plain;
    float *far;      // cost of the way to the water
    int32_t *parent; // next sample of the way; -1 = none
    int32_t *order;  // samples by their cost, the nearest first
    int64_t found;
    float *area;    // samples whose ways pass, itself included
    int32_t *main;  // of the samples that drain into it, that with most area; -1 = none
    Vec2 *at, *old; // places, smoothed
} CreekTree;

static int64_t plain_count(const CreekPlain *p)
{
    return (int64_t)p->columns * p->rows;
}

// ---- ways

static bool reach_neighbours(CreekTree *t, LowestQueue *queue, int32_t i, Error *e)
{
    const CreekPlain *p = t->plain;
    int column = i % p->columns, row = i / p->columns;
    for (int k = 0; k < 9; k++) {
        int c = column + k % 3 - 1, r = row + k / 3 - 1;
        if (k == 4 || c < 0 || r < 0 || c >= p->columns || r >= p->rows) {
            continue;
        }
        int32_t n = (int32_t)((int64_t)r * p->columns + c);
        float step = k % 2 == 0 ? 1.41421356f : 1.0f;
        float far = t->far[i] + step * 0.5f * (p->cost[i] + p->cost[n]);
        if (p->ground[n] == CREEK_MARSH && far < t->far[n]) {
            t->far[n] = far;
            t->parent[n] = i;
            if (!lowest_queue_push(queue, far, n, e)) {
                return false;
            }
        }
    }
    return true;
}

// Dijkstra's ways of least cost.
static bool find_ways(CreekTree *t, Error *e)
{
    LowestQueue queue = {0};
    int64_t count = plain_count(t->plain);
    bool done = true;
    for (int64_t i = 0; i < count; i++) {
        bool water = t->plain->ground[i] == CREEK_WATER;
        t->far[i] = water ? 0.0f : INFINITY;
        t->parent[i] = -1;
    }
    for (int64_t i = 0; done && i < count; i++) {
        done = t->plain->ground[i] != CREEK_WATER || reach_neighbours(t, &queue, (int32_t)i, e);
    }
    while (done && queue.count > 0) {
        QueueItem item = lowest_queue_pop(&queue);
        if (item.height <= t->far[item.index]) {
            t->order[t->found++] = item.index;
            t->far[item.index] = item.height;
            done = reach_neighbours(t, &queue, item.index, e);
        }
    }
    free(queue.item);
    return done;
}

// ---- areas

static bool is_creek(const CreekTree *t, int32_t i)
{
    return t->parent[i] >= 0 && t->area[i] >= t->plain->least;
}

static void find_areas(CreekTree *t)
{
    for (int64_t i = 0; i < plain_count(t->plain); i++) {
        t->area[i] = t->parent[i] >= 0 ? 1.0f : 0.0f;
        t->main[i] = -1;
    }
    for (int64_t k = t->found - 1; k >= 0; k--) {
        int32_t i = t->order[k], below = t->parent[i];
        t->area[below] += t->area[i];
        if (is_creek(t, i) && (t->main[below] < 0 || t->area[i] > t->area[t->main[below]])) {
            t->main[below] = i;
        }
    }
}

// Evens out the corners of the grid.
static void smooth(CreekTree *t)
{
    enum { TIMES = 5 };
    int64_t count = plain_count(t->plain);
    for (int64_t i = 0; i < count; i++) {
        int64_t row = i / t->plain->columns;
        t->at[i] = (Vec2){(float)(i % t->plain->columns), (float)row};
    }
    for (int n = 0; n < TIMES; n++) {
        memcpy(t->old, t->at, (size_t)count * sizeof *t->at);
        for (int64_t k = 0; k < t->found; k++) {
            int32_t i = t->order[k];
            if (is_creek(t, i) && t->main[i] >= 0) {
                Vec2 down = t->old[t->parent[i]], up = t->old[t->main[i]];
                t->at[i].x = 0.5f * t->old[i].x + 0.25f * (down.x + up.x);
                t->at[i].y = 0.5f * t->old[i].y + 0.25f * (down.y + up.y);
            }
        }
    }
}

// ---- reaches

// By the power 3/8 of the area.
static float half_width(const CreekPlain *p, float area)
{
    float fourth = sqrtf(sqrtf(area / p->least));
    return 0.5f * fminf(p->width * fourth * sqrtf(fourth), p->most);
}

static bool find_reaches(const CreekTree *t, Creeks *creeks, Error *e)
{
    for (int64_t k = 0; k < t->found; k++) {
        creeks->count += is_creek(t, t->order[k]);
    }
    creeks->reach = memory_alloc(creeks->count > 0 ? creeks->count : 1, sizeof *creeks->reach, e);
    CreekReach *reach = creeks->reach;
    for (int64_t k = 0; reach && k < t->found; k++) {
        int32_t i = t->order[k], below = t->parent[i];
        if (!is_creek(t, i)) {
            continue;
        }
        float half = half_width(t->plain, t->area[i]);
        bool through = t->main[below] == i && is_creek(t, below);
        bool head = t->main[i] < 0;
        *reach++ = (CreekReach){.from = t->at[i],
                                .to = t->at[below],
                                .half_from = head ? 0.3f * half : half,
                                .half_to = through ? half_width(t->plain, t->area[below]) : half};
    }
    return creeks->reach;
}

// ---- blocks

typedef struct BlockRange {
    int left, right, top, bottom;
} BlockRange;

static int block_of(float at, int blocks)
{
    int block = (int)(at / CREEK_BLOCK);
    return at <= 0.0f ? 0 : block >= blocks ? blocks - 1 : block;
}

static BlockRange blocks_of(const Creeks *c, const CreekReach *r)
{
    float aside = CREEK_REACH * fmaxf(r->half_from, r->half_to);
    return (BlockRange){block_of(fminf(r->from.x, r->to.x) - aside, c->columns),
                        block_of(fmaxf(r->from.x, r->to.x) + aside, c->columns),
                        block_of(fminf(r->from.y, r->to.y) - aside, c->rows),
                        block_of(fmaxf(r->from.y, r->to.y) + aside, c->rows)};
}

// Counts the reaches of each block, or enters them before the ends that the counts tell.
static void visit_blocks(Creeks *c, bool enter)
{
    for (int64_t k = c->count - 1; k >= 0; k--) {
        BlockRange b = blocks_of(c, &c->reach[k]);
        for (int row = b.top; row <= b.bottom; row++) {
            for (int column = b.left; column <= b.right; column++) {
                int32_t *first = &c->first[(int64_t)row * c->columns + column];
                *first += enter ? -1 : 1;
                if (enter) {
                    c->list[*first] = (int32_t)k;
                }
            }
        }
    }
}

static bool find_blocks(const CreekPlain *p, Creeks *c, Error *e)
{
    c->columns = (p->columns + CREEK_BLOCK - 1) / CREEK_BLOCK;
    c->rows = (p->rows + CREEK_BLOCK - 1) / CREEK_BLOCK;
    int64_t blocks = (int64_t)c->columns * c->rows;
    c->first = memory_alloc_zero(blocks + 1, sizeof *c->first, e);
    if (!c->first) {
        return false;
    }
    visit_blocks(c, false);
    for (int64_t b = 1; b <= blocks; b++) {
        c->first[b] += c->first[b - 1];
    }
    int32_t total = c->first[blocks];
    c->list = memory_alloc(total > 0 ? total : 1, sizeof *c->list, e);
    if (c->list) {
        visit_blocks(c, true);
    }
    return c->list;
}

// ----

static void free_tree(CreekTree *t)
{
    free(t->far);
    free(t->parent);
    free(t->order);
    free(t->area);
    free(t->main);
    free(t->at);
    free(t->old);
}

void creeks_free(Creeks *creeks)
{
    if (creeks) {
        free(creeks->reach);
        free(creeks->first);
        free(creeks->list);
        free(creeks);
    }
}

Creeks *creeks_grow(const CreekPlain *plain, Error *e)
{
    int64_t count = plain_count(plain);
    CreekTree t = {.plain = plain,
                   .far = memory_alloc(count, sizeof *t.far, e),
                   .parent = memory_alloc(count, sizeof *t.parent, e),
                   .order = memory_alloc(count, sizeof *t.order, e),
                   .area = memory_alloc(count, sizeof *t.area, e),
                   .main = memory_alloc(count, sizeof *t.main, e),
                   .at = memory_alloc(count, sizeof *t.at, e),
                   .old = memory_alloc(count, sizeof *t.old, e)};
    Creeks *creeks = memory_alloc_zero(1, sizeof *creeks, e);
    bool done = t.far && t.parent && t.order && t.area && t.main && t.at && t.old && creeks &&
                find_ways(&t, e);
    if (done) {
        find_areas(&t);
        smooth(&t);
        done = find_reaches(&t, creeks, e) && find_blocks(plain, creeks, e);
    }
    free_tree(&t);
    if (!done) {
        creeks_free(creeks);
        return NULL;
    }
    return creeks;
}

// The distance in half-widths; *half: of the nearest place on the reach.
static float beside_reach(const CreekReach *r, Vec2 at, float *half)
{
    float x = r->to.x - r->from.x, z = r->to.y - r->from.y, squared = x * x + z * z;
    float along = (at.x - r->from.x) * x + (at.y - r->from.y) * z;
    float t = squared > 0.0f ? clampf(along / squared, 0.0f, 1.0f) : 0.0f;
    float dx = at.x - r->from.x - t * x, dz = at.y - r->from.y - t * z;
    *half = lerpf(r->half_from, r->half_to, t);
    return sqrtf(dx * dx + dz * dz) / *half;
}

float creeks_beside(const Creeks *creeks, Vec2 at, float *half)
{
    int column = block_of(at.x, creeks->columns), row = block_of(at.y, creeks->rows);
    int64_t block = (int64_t)row * creeks->columns + column;
    float least = INFINITY;
    *half = 0.0f;
    for (int32_t k = creeks->first[block]; k < creeks->first[block + 1]; k++) {
        float own, side = beside_reach(&creeks->reach[creeks->list[k]], at, &own);
        if (side < least && side <= CREEK_REACH) {
            least = side;
            *half = own;
        }
    }
    return least;
}
