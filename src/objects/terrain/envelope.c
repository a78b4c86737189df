#include "objects/terrain/envelope.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

enum { TASK_LEVELS = 3, TASKS = 64, MOST_LEVELS = 9 };

typedef struct Leaf {
    int32_t *list; // of the task that filled it
    int64_t start;
    int32_t count;
} Leaf;

typedef struct LeafLists {
    int32_t *item;
    int64_t count, capacity;
} LeafLists;

struct TroughEnvelope {
    Trough *trough;
    int64_t trough_count;
    float size, margin;
    int levels;
    Leaf *leaf; // side * side, row by row
    LeafLists lists[TASKS];
};

float trough_height(const Trough *t, float x, float z)
{
    float px = x - t->x, pz = z - t->z;
    float along = px * t->dx + pz * t->dz, across = px * t->dz - pz * t->dx;
    float y2 = across * across + t->width * t->width;
    float steep = t->gradient * t->gradient - t->slope * t->slope;
    float foot = along - t->slope * sqrtf(y2 / steep);
    foot = foot < 0.0f ? 0.0f : foot > t->length ? t->length : foot;
    float ahead = along - foot;
    return t->h0 + t->slope * foot + t->gradient * sqrtf(ahead * ahead + y2) -
           t->width * sqrtf(steep);
}

static int side_of(const TroughEnvelope *envelope)
{
    return 1 << envelope->levels;
}

// A square of the subdivision: candidates are troughs that can be lowest somewhere in it.
typedef struct Square {
    int column, row, level; // of 2^level per side
} Square;

static void square_center(const TroughEnvelope *envelope, Square s, float *x, float *z, float *r)
{
    float side = envelope->size / (float)(1 << s.level);
    *x = ((float)s.column + 0.5f) * side - 0.5f * envelope->size;
    *z = ((float)s.row + 0.5f) * side - 0.5f * envelope->size;
    *r = 0.70710684f * side * 1.0001f + 1.4142137f * envelope->margin;
}

// Writes those of `count` candidates that can be lowest within the square to kept.
static int64_t prune(const TroughEnvelope *envelope, Square square, const int32_t *candidate,
                     int64_t count, int32_t *kept, float *low)
{
    float x, z, r, bound = 3e38f;
    square_center(envelope, square, &x, &z, &r);
    for (int64_t i = 0; i < count; i++) {
        const Trough *t = &envelope->trough[candidate[i]];
        float h = trough_height(t, x, z), reach = t->gradient * r;
        low[i] = h - reach;
        bound = h + reach < bound ? h + reach : bound;
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

static bool store_leaf(TroughEnvelope *envelope, int task, Square square, const int32_t *kept,
                       int64_t count, Error *e)
{
    LeafLists *lists = &envelope->lists[task];
    if (!memory_reserve(&lists->item, &lists->capacity, lists->count + count, sizeof(int32_t), e)) {
        return false;
    }
    memcpy(lists->item + lists->count, kept, sizeof *kept * (size_t)count);
    int64_t place = (int64_t)square.row * side_of(envelope) + square.column;
    envelope->leaf[place] = (Leaf){.start = lists->count, .count = (int32_t)count};
    lists->count += count;
    return true;
}

static bool descend(TroughEnvelope *envelope, int task, Square square, const int32_t *candidate,
                    int64_t count, Error *e)
{
    int32_t *kept = memory_alloc(count, sizeof *kept, e);
    float *low = memory_alloc(count, sizeof *low, e);
    bool done = kept && low;
    if (done) {
        count = prune(envelope, square, candidate, count, kept, low);
    }
    free(low);
    if (done && square.level == envelope->levels) {
        done = store_leaf(envelope, task, square, kept, count, e);
    } else {
        for (int k = 0; done && k < 4; k++) {
            Square quarter = {2 * square.column + (k & 1), 2 * square.row + (k >> 1),
                              square.level + 1};
            done = descend(envelope, task, quarter, kept, count, e);
        }
    }
    free(kept);
    return done;
}

static bool fill_leaves(TroughEnvelope *envelope, const int32_t *all, const Run *run, Error *e)
{
    bool done = true;
#pragma omp parallel for schedule(dynamic, 1) num_threads(run->threads)
    for (int task = 0; task < TASKS; task++) {
        Error mine = {0};
        Square square = {task % 8, task / 8, TASK_LEVELS};
        bool good = !run_is_cancelled(run) &&
                    descend(envelope, task, square, all, envelope->trough_count, &mine);
        if (!good) {
#pragma omp critical(trough_envelope)
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
static void link_leaves(TroughEnvelope *envelope)
{
    int side = side_of(envelope), shift = envelope->levels - TASK_LEVELS;
    for (int row = 0; row < side; row++) {
        for (int column = 0; column < side; column++) {
            Leaf *leaf = &envelope->leaf[(int64_t)row * side + column];
            leaf->list = envelope->lists[(row >> shift) * 8 + (column >> shift)].item + leaf->start;
        }
    }
}

TroughEnvelope *trough_envelope_new(const Trough *trough, int64_t count, float size, float margin,
                                    const Run *run, Error *e)
{
    TroughEnvelope *envelope = memory_alloc_zero(1, sizeof *envelope, e);
    if (!envelope) {
        return NULL;
    }
    envelope->trough_count = count;
    envelope->size = size;
    envelope->margin = margin;
    envelope->levels = TASK_LEVELS;
    while (envelope->levels < MOST_LEVELS && (1 << 2 * envelope->levels) < 4 * count) {
        envelope->levels++;
    }
    int64_t leaves = (int64_t)1 << 2 * envelope->levels;
    envelope->trough = memory_alloc(count, sizeof *trough, e);
    envelope->leaf = memory_alloc_zero(leaves, sizeof *envelope->leaf, e);
    int32_t *all = memory_alloc(count, sizeof *all, e);
    bool done = envelope->trough && envelope->leaf && all;
    if (done) {
        memcpy(envelope->trough, trough, sizeof *trough * (size_t)count);
        for (int64_t i = 0; i < count; i++) {
            all[i] = (int32_t)i;
        }
        done = fill_leaves(envelope, all, run, e);
    }
    free(all);
    if (!done) {
        trough_envelope_free(envelope);
        return NULL;
    }
    link_leaves(envelope);
    return envelope;
}

void trough_envelope_free(TroughEnvelope *envelope)
{
    if (envelope) {
        for (int i = 0; i < TASKS; i++) {
            free(envelope->lists[i].item);
        }
        free(envelope->trough);
        free(envelope->leaf);
        free(envelope);
    }
}

float trough_envelope_at(const TroughEnvelope *envelope, float x, float z, int32_t *lowest)
{
    int side = side_of(envelope);
    float scale = (float)side / envelope->size;
    float u = clampf((x + 0.5f * envelope->size) * scale, 0.0f, (float)side - 0.5f);
    float v = clampf((z + 0.5f * envelope->size) * scale, 0.0f, (float)side - 0.5f);
    const Leaf *leaf = &envelope->leaf[(int64_t)v * side + (int64_t)u];
    float best = 3e38f;
    for (int32_t i = 0; i < leaf->count; i++) {
        float h = trough_height(&envelope->trough[leaf->list[i]], x, z);
        if (h < best) {
            best = h;
            *lowest = leaf->list[i];
        }
    }
    return best;
}
