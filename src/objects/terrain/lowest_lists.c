#include "objects/terrain/lowest_lists.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

enum { TASK_LEVELS = 3, TASKS = 64, MOST_LEVELS = 9 };

typedef struct Leaf {
    int32_t *list; // of the task that filled it
    int64_t start;
    int32_t count;
} Leaf;

typedef struct TaskItems {
    int32_t *item;
    int64_t count, capacity;
} TaskItems;

struct LowestLists {
    float size, margin;
    int levels;
    Leaf *leaf; // side * side, row by row
    TaskItems task[TASKS];
};

typedef struct Search {
    LowestLists *lists;
    LowestBounds *bounds;
    const void *functions;
    float most;
} Search;

static int side_of(const LowestLists *lists)
{
    return 1 << lists->levels;
}

// A square of the subdivision: candidates are functions that can be lowest somewhere in it.
typedef struct Square {
    int column, row, level; // of 2^level per side
} Square;

static void square_center(const LowestLists *lists, Square s, float *x, float *z, float *r)
{
    float side = lists->size / (float)(1 << s.level);
    *x = ((float)s.column + 0.5f) * side - 0.5f * lists->size;
    *z = ((float)s.row + 0.5f) * side - 0.5f * lists->size;
    *r = 0.70710684f * side * 1.0001f + 1.4142137f * lists->margin;
}

// Writes those of `count` candidates that can be lowest within the square to kept.
static int64_t prune(const Search *search, Square square, const int32_t *candidate, int64_t count,
                     int32_t *kept, float *low)
{
    float x, z, r, bound = search->most;
    square_center(search->lists, square, &x, &z, &r);
    for (int64_t i = 0; i < count; i++) {
        float high;
        search->bounds(search->functions, candidate[i], x, z, r, &low[i], &high);
        bound = high < bound ? high : bound;
    }
    bound += 1e-5f * (bound < 0.0f ? -bound : bound) + 1e-5f; // for rounding errors
    int64_t some = 0;
    for (int64_t i = 0; i < count; i++) {
        if (low[i] <= bound) {
            kept[some++] = candidate[i];
        }
    }
    return some;
}

static bool store_leaf(LowestLists *lists, int task, Square square, const int32_t *kept,
                       int64_t count, Error *e)
{
    TaskItems *items = &lists->task[task];
    if (!memory_reserve(&items->item, &items->capacity, items->count + count, sizeof(int32_t), e)) {
        return false;
    }
    if (count > 0) {
        memcpy(items->item + items->count, kept, sizeof *kept * (size_t)count);
    }
    int64_t place = (int64_t)square.row * side_of(lists) + square.column;
    lists->leaf[place] = (Leaf){.start = items->count, .count = (int32_t)count};
    items->count += count;
    return true;
}

static bool descend(const Search *search, int task, Square square, const int32_t *candidate,
                    int64_t count, Error *e)
{
    int32_t *kept = memory_alloc(count, sizeof *kept, e);
    float *low = memory_alloc(count, sizeof *low, e);
    bool done = kept && low;
    if (done) {
        count = prune(search, square, candidate, count, kept, low);
    }
    free(low);
    if (done && square.level == search->lists->levels) {
        done = store_leaf(search->lists, task, square, kept, count, e);
    } else {
        for (int k = 0; done && k < 4; k++) {
            Square quarter = {2 * square.column + (k & 1), 2 * square.row + (k >> 1),
                              square.level + 1};
            done = descend(search, task, quarter, kept, count, e);
        }
    }
    free(kept);
    return done;
}

static bool fill_leaves(const Search *search, const int32_t *all, int64_t count, const Run *run,
                        Error *e)
{
    bool done = true;
#pragma omp parallel for schedule(dynamic, 1) num_threads(run->threads)
    for (int task = 0; task < TASKS; task++) {
        Error mine = {0};
        Square square = {task % 8, task / 8, TASK_LEVELS};
        bool good = !run_is_cancelled(run) && descend(search, task, square, all, count, &mine);
        if (!good) {
#pragma omp critical(lowest_lists)
            {
                if (done && e) {
                    *e = mine;
                }
                done = false;
            }
        }
    }
    return done || (run_is_cancelled(run) ? run_cancel_error(e) : false);
}

// The task that filled a leaf: its square of level TASK_LEVELS.
static void link_leaves(LowestLists *lists)
{
    int side = side_of(lists), shift = lists->levels - TASK_LEVELS;
    for (int row = 0; row < side; row++) {
        for (int column = 0; column < side; column++) {
            Leaf *leaf = &lists->leaf[(int64_t)row * side + column];
            leaf->list = lists->task[(row >> shift) * 8 + (column >> shift)].item;
            if (leaf->count > 0) {
                leaf->list += leaf->start;
            }
        }
    }
}

LowestLists *lowest_lists_new(LowestBounds *bounds, const void *functions, int64_t count,
                              float most, float size, float margin, const Run *run, Error *e)
{
    LowestLists *lists = memory_alloc_zero(1, sizeof *lists, e);
    if (!lists) {
        return NULL;
    }
    lists->size = size;
    lists->margin = margin;
    lists->levels = TASK_LEVELS;
    while (lists->levels < MOST_LEVELS && ((int64_t)1 << 2 * lists->levels) < 4 * count) {
        lists->levels++;
    }
    int64_t leaves = (int64_t)1 << 2 * lists->levels;
    lists->leaf = memory_alloc_zero(leaves, sizeof *lists->leaf, e);
    int32_t *all = memory_alloc(count, sizeof *all, e);
    bool done = lists->leaf && all;
    for (int64_t i = 0; done && i < count; i++) {
        all[i] = (int32_t)i;
    }
    Search search = {lists, bounds, functions, most};
    done = done && fill_leaves(&search, all, count, run, e);
    free(all);
    if (!done) {
        lowest_lists_free(lists);
        return NULL;
    }
    link_leaves(lists);
    return lists;
}

void lowest_lists_free(LowestLists *lists)
{
    if (lists) {
        for (int i = 0; i < TASKS; i++) {
            free(lists->task[i].item);
        }
        free(lists->leaf);
        free(lists);
    }
}

const int32_t *lowest_lists_at(const LowestLists *lists, float x, float z, int32_t *count)
{
    int side = side_of(lists);
    float scale = (float)side / lists->size;
    float u = clampf((x + 0.5f * lists->size) * scale, 0.0f, (float)side - 0.5f);
    float v = clampf((z + 0.5f * lists->size) * scale, 0.0f, (float)side - 0.5f);
    const Leaf *leaf = &lists->leaf[(int64_t)v * side + (int64_t)u];
    *count = leaf->count;
    return leaf->list;
}
