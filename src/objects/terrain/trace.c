#include "objects/terrain/trace.h"

#include "base/lowest_queue.h"
#include "base/memory.h"
#include "base/random.h"
#include "objects/terrain/trace_tidy.h"
#include "outtree/chains.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_SIDE = 4096 };

// Clockwise from above.
static const int AROUND[8][2] = {{0, -1}, {1, -1}, {1, 0},  {1, 1},
                                 {0, 1},  {-1, 1}, {-1, 0}, {-1, -1}};

typedef struct Drawing {
    int width, height;
    uint8_t *paint; // of each pixel: 1 = painted
    uint8_t *line;  // 1 = on a middle line
    int32_t *pixel; // the painted ones, later those on middle lines
    int64_t count;
    float *away;     // of each pixel: px along the lines from the root
    int32_t *before; // the next pixel toward the root; -1 at a root
    int32_t *node;   // in the tree; -1 = not reached yet
    OutTree *tree;
} Drawing;

static bool is_set(const Drawing *d, const uint8_t *map, int x, int y)
{
    return x >= 0 && y >= 0 && x < d->width && y < d->height && map[(int64_t)y * d->width + x];
}

// ---- paint

static bool find_paint(Drawing *d, const Image *grey, bool invert, Error *e)
{
    if (grey->width > MOST_SIDE || grey->height > MOST_SIDE) {
        error_set(e, ERROR_INPUT,
                  "the picture has %d x %d pixels; lines are traced in pictures of at most "
                  "%d x %d",
                  grey->width, grey->height, MOST_SIDE, MOST_SIDE);
        return false;
    }
    d->width = grey->width;
    d->height = grey->height;
    int64_t all = (int64_t)d->width * d->height;
    d->paint = memory_alloc_zero(all, 1, e);
    if (!d->paint) {
        return false;
    }
    for (int64_t i = 0; i < all; i++) {
        d->paint[i] = (grey->pixel[i] > 0.5f) != invert;
        d->count += d->paint[i];
    }
    if (d->count == 0 || 2 * d->count > all) {
        error_set(e, ERROR_INPUT,
                  "the picture's lines cover %s of it; paint bright ones on dark, or dark ones on "
                  "bright with invert",
                  d->count == 0 ? "nothing" : "more than half");
        return false;
    }
    d->line = memory_alloc(all, 1, e);
    d->pixel = memory_alloc(d->count, sizeof *d->pixel, e);
    if (!d->line || !d->pixel) {
        return false;
    }
    memcpy(d->line, d->paint, (size_t)all);
    for (int64_t i = 0, k = 0; i < all; i++) {
        if (d->paint[i]) {
            d->pixel[k++] = (int32_t)i;
        }
    }
    return true;
}

// ---- middle lines

// May the pixel go in this half (0 or 1) of a pass? It must be on the edge, no tip, and not what
// holds two parts together.
static bool may_go(const Drawing *d, int x, int y, int half)
{
    bool p[8];
    int neighbours = 0, starts = 0;
    for (int k = 0; k < 8; k++) {
        p[k] = is_set(d, d->line, x + AROUND[k][0], y + AROUND[k][1]);
        neighbours += p[k];
    }
    for (int k = 0; k < 8; k++) {
        starts += !p[k] && p[(k + 1) % 8];
    }
    bool edge = half == 0 ? !(p[0] && p[2] && p[4]) && !(p[2] && p[4] && p[6])
                          : !(p[0] && p[2] && p[6]) && !(p[0] && p[4] && p[6]);
    return neighbours >= 2 && neighbours <= 6 && starts == 1 && edge;
}

// Removes the pixels marked 2. Returns their number.
static int64_t remove_marked(Drawing *d)
{
    int64_t kept = 0, before = d->count;
    for (int64_t k = 0; k < before; k++) {
        int32_t i = d->pixel[k];
        if (d->line[i] == 2) {
            d->line[i] = 0;
        } else {
            d->pixel[kept++] = i;
        }
    }
    d->count = kept;
    return before - kept;
}

static bool thin(Drawing *d, const Run *run, Error *e)
{
    for (int64_t removed = 1; removed > 0;) {
        if (run_is_cancelled(run)) {
            return run_cancel_error(e);
        }
        removed = 0;
        for (int half = 0; half < 2; half++) {
            for (int64_t k = 0; k < d->count; k++) {
                int32_t i = d->pixel[k];
                d->line[i] = may_go(d, i % d->width, i / d->width, half) ? 2 : 1;
            }
            removed += remove_marked(d);
        }
    }
    return true;
}

// px from the pixel's middle to the edge of the paint: half a pixel before the nearest pixel
// without. What is beside the picture does not count.
static float half_width(const Drawing *d, int32_t pixel)
{
    int x = pixel % d->width, y = pixel / d->width;
    int64_t best = INT64_MAX;
    int most = d->width > d->height ? d->width : d->height;
    for (int ring = 1; ring < most && (int64_t)ring * ring < best; ring++) {
        for (int dy = -ring; dy <= ring; dy++) {
            int step = dy == -ring || dy == ring ? 1 : 2 * ring;
            for (int dx = -ring; dx <= ring; dx += step) {
                bool inside = x + dx >= 0 && y + dy >= 0 && x + dx < d->width && y + dy < d->height;
                int64_t squared = (int64_t)dx * dx + (int64_t)dy * dy;
                if (inside && squared < best && !is_set(d, d->paint, x + dx, y + dy)) {
                    best = squared;
                }
            }
        }
    }
    return sqrtf((float)best) - 0.5f;
}

// ---- the tree

static float rim_distance(const Drawing *d, int32_t pixel)
{
    int x = pixel % d->width, y = pixel / d->width;
    int across = x < d->width - 1 - x ? x : d->width - 1 - x;
    int down = y < d->height - 1 - y ? y : d->height - 1 - y;
    return (float)(across < down ? across : down);
}

// The best root of all pixels connected with `first`. list: room for all pixels.
static int32_t find_root(Drawing *d, int32_t first, TraceRoot root, int32_t *list)
{
    int64_t count = 1;
    float most = -3e38f;
    int32_t best = first;
    list[0] = first;
    d->before[first] = -1; // seen
    for (int64_t k = 0; k < count; k++) {
        int32_t i = list[k];
        float worth = root == TRACE_RIM ? -rim_distance(d, i) : half_width(d, i);
        best = worth > most || (worth == most && i < best) ? i : best;
        most = worth > most ? worth : most;
        for (int j = 0; j < 8; j++) {
            int x = i % d->width + AROUND[j][0], y = i / d->width + AROUND[j][1];
            int32_t to = y * d->width + x;
            if (is_set(d, d->line, x, y) && d->before[to] == -2) {
                d->before[to] = -1;
                list[count++] = to;
            }
        }
    }
    return best;
}

static bool add_pixel(Drawing *d, int32_t i, int32_t colony, uint64_t seed, Error *e)
{
    OutTree *tree = d->tree;
    int64_t parent = d->before[i] < 0 ? -1 : d->node[d->before[i]];
    int column = i % d->width, row = i / d->width;
    Vec3 at = {(float)column + 0.5f, 0.0f, (float)row + 0.5f};
    d->node[i] =
        (int32_t)out_tree_add_node(tree, at, parent, parent < 0 ? 0 : tree->birth[parent] + 1,
                                   colony, random_key(seed, (uint64_t)i), e);
    if (d->node[i] >= 0) {
        tree->radius[d->node[i]] = half_width(d, i);
    }
    return d->node[i] >= 0;
}

// Adds all pixels connected with the root, by their shortest paths to it (Dijkstra 1959).
static bool add_drawing(Drawing *d, int32_t root, int32_t colony, uint64_t seed, Error *e)
{
    LowestQueue queue = {0};
    d->away[root] = 0.0f;
    d->before[root] = -1;
    bool done = lowest_queue_push(&queue, 0.0f, root, e);
    while (done && queue.count > 0) {
        QueueItem item = lowest_queue_pop(&queue);
        int32_t i = item.index;
        if (d->node[i] >= 0) {
            continue;
        }
        done = add_pixel(d, i, colony, seed, e);
        for (int k = 0; done && k < 8; k++) {
            int x = i % d->width + AROUND[k][0], y = i / d->width + AROUND[k][1];
            int32_t to = y * d->width + x;
            float away = item.height + (k % 2 ? 1.4142135f : 1.0f);
            if (is_set(d, d->line, x, y) && d->node[to] < 0 && away < d->away[to]) {
                d->away[to] = away;
                d->before[to] = i;
                done = lowest_queue_push(&queue, away, to, e);
            }
        }
    }
    free(queue.item);
    return done;
}

static bool add_drawings(Drawing *d, TraceRoot root, uint64_t seed, Error *e)
{
    int64_t all = (int64_t)d->width * d->height;
    d->tree = out_tree_new(e);
    d->away = memory_alloc(all, sizeof *d->away, e);
    d->before = memory_alloc(all, sizeof *d->before, e);
    d->node = memory_alloc(all, sizeof *d->node, e);
    int32_t *list = memory_alloc(d->count, sizeof *list, e);
    bool done = d->tree && d->away && d->before && d->node && list;
    for (int64_t k = 0; done && k < d->count; k++) {
        d->away[d->pixel[k]] = 3e38f;
        d->before[d->pixel[k]] = -2;
        d->node[d->pixel[k]] = -1;
    }
    int32_t colony = 0;
    for (int64_t k = 0; done && k < d->count; k++) {
        if (d->node[d->pixel[k]] < 0) {
            int32_t from = find_root(d, d->pixel[k], root, list);
            done = add_drawing(d, from, colony++, seed, e);
        }
    }
    free(list);
    return done;
}

OutTree *trace_lines(const Image *grey, bool invert, TraceRoot root, uint64_t seed, const Run *run,
                     Error *e)
{
    const float spacing = 3.0f; // px between nodes
    Drawing d = {0};
    OutTree *traced = NULL;
    if (find_paint(&d, grey, invert, e) && thin(&d, run, e) && add_drawings(&d, root, seed, e) &&
        trace_tidy(d.tree, e)) {
        traced = out_tree_resample(d.tree, spacing, e);
    }
    out_tree_free(d.tree);
    free(d.paint);
    free(d.line);
    free(d.pixel);
    free(d.away);
    free(d.before);
    free(d.node);
    return traced;
}
